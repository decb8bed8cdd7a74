#include "meshes/design/connectivity.h"

#include <gtest/gtest.h>

#include "meshes/design/reference_shapes.h"

namespace menger::meshes {
namespace {

TEST(Connectivity, JoinsCellsThroughFacesOnly) {
  EXPECT_EQ(count_components(Polycube::from_digits(2, 2, 1, "1001")), 2U) << "cells that share an edge";
  EXPECT_EQ(count_components(Polycube::from_digits(2, 2, 2, "10000001")), 2U) << "cells that share a corner";
  EXPECT_EQ(count_components(Polycube::from_digits(2, 1, 1, "12")), 1U) << "cells of different materials that share a face";
}

TEST(Connectivity, SeesEachOfTheSixDirections) {
  EXPECT_TRUE(is_connected(bar(3)));
  EXPECT_TRUE(is_connected(Polycube::from_digits(1, 3, 1, "111")));
  EXPECT_TRUE(is_connected(Polycube::from_digits(1, 1, 3, "111")));
  // rings that close only when every direction is walked: in the plane xy, then in the plane xz
  EXPECT_TRUE(is_connected(Polycube::from_digits(3, 3, 1, "111101111")));
  EXPECT_TRUE(is_connected(Polycube::from_digits(3, 1, 3, "111101111")));
  // a hook whose tip is reached only by going back along x, and one only by going back down along z
  EXPECT_TRUE(is_connected(Polycube::from_digits(3, 3, 1, "100111000")));
  EXPECT_TRUE(is_connected(Polycube::from_digits(3, 3, 1, "001111000")));
  EXPECT_TRUE(is_connected(Polycube::from_digits(3, 1, 3, "101101111")));
}

TEST(Connectivity, CallsAnEmptyBodyUnconnected) {
  const Polycube body(3, 3, 3);
  EXPECT_EQ(count_components(body), 0U);
  EXPECT_FALSE(is_connected(body));
  EXPECT_EQ(largest_component(body), body);
}

TEST(Connectivity, KeepsTheLargestComponentWithItsMaterials) {
  const Polycube body = Polycube::from_digits(5, 1, 1, "10212");
  EXPECT_EQ(largest_component(body).digits(), "00212");
}

TEST(Connectivity, KeepsTheFirstOfEquallyLargeComponents) {
  EXPECT_EQ(largest_component(Polycube::from_digits(5, 1, 1, "12021")).digits(), "12000");
  // the component that starts first in grid order wins although the other ends first
  EXPECT_EQ(largest_component(Polycube::from_digits(3, 1, 2, "101101")).digits(), "100100");
}

TEST(Connectivity, HandlesABodyOfLevelThreeSize) { EXPECT_EQ(count_components(full_cube(81)), 1U); }

}  // namespace
}  // namespace menger::meshes
