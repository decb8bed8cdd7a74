#include "meshes/design/reference_shapes.h"

#include <gtest/gtest.h>

namespace menger::meshes {
namespace {

TEST(ReferenceShapes, BarLiesAlongX) {
  const Polycube body = bar(4);
  EXPECT_EQ(body, Polycube::from_digits(4, 1, 1, "1111"));
}

TEST(ReferenceShapes, PlaneIsHorizontal) { EXPECT_EQ(plane(3), Polycube::from_digits(3, 3, 1, "111111111")); }

TEST(ReferenceShapes, FullCubeHasNoHole) { EXPECT_EQ(full_cube(3).digits(), std::string(27, '1')); }

TEST(ReferenceShapes, MengerSpongeLacksCentreAndFaceCentres) {
  EXPECT_EQ(menger_sponge(), Polycube::from_digits(3, 3, 3, "111101111101000101111101111"));
}

}  // namespace
}  // namespace menger::meshes
