#include "meshes/design/polycube.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace menger::meshes {
namespace {

TEST(Polycube, CountsDigitsAlongXThenYThenZ) {
  const Polycube body = Polycube::from_digits(2, 3, 2, "100000000020");
  EXPECT_EQ(body.nx(), 2);
  EXPECT_EQ(body.ny(), 3);
  EXPECT_EQ(body.nz(), 2);
  EXPECT_EQ(body.at({0, 0, 0}), 1);
  EXPECT_EQ(body.at({0, 2, 1}), 2);
  EXPECT_EQ(body.count(), 2U);
  EXPECT_EQ(body.occupied(), (std::vector<CellIndex>{{0, 0, 0}, {0, 2, 1}}));
}

TEST(Polycube, GivesBackItsDigits) {
  const std::string digits = "012210";
  EXPECT_EQ(Polycube::from_digits(3, 2, 1, digits).digits(), digits);
}

TEST(Polycube, ListsOccupiedCellsInGridOrder) {
  const Polycube body = Polycube::from_digits(2, 2, 2, "01101001");
  EXPECT_EQ(body.occupied(), (std::vector<CellIndex>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
}

TEST(Polycube, IsEmptyOutsideItsGrid) {
  const Polycube body = Polycube::from_digits(1, 1, 1, "1");
  EXPECT_EQ(body.at_or_empty({0, 0, 0}), 1);
  EXPECT_EQ(body.at_or_empty({-1, 0, 0}), empty);
  EXPECT_EQ(body.at_or_empty({0, 1, 0}), empty);
  EXPECT_EQ(body.at_or_empty({0, 0, 1}), empty);
}

TEST(Polycube, ComparesSizeAndMaterials) {
  EXPECT_EQ(Polycube::from_digits(2, 1, 1, "12"), Polycube::from_digits(2, 1, 1, "12"));
  EXPECT_NE(Polycube::from_digits(2, 1, 1, "12"), Polycube::from_digits(2, 1, 1, "11"));
  EXPECT_NE(Polycube::from_digits(2, 1, 1, "12"), Polycube::from_digits(1, 2, 1, "12"));
}

TEST(Polycube, RefusesDigitsThatDoNotFit) {
  EXPECT_THROW(Polycube::from_digits(2, 1, 1, "1"), std::invalid_argument);
  EXPECT_THROW(Polycube::from_digits(2, 1, 1, "111"), std::invalid_argument);
  EXPECT_THROW(Polycube::from_digits(2, 1, 1, "13"), std::invalid_argument);
  EXPECT_THROW(Polycube::from_digits(2, 1, 1, "1 "), std::invalid_argument);
}

TEST(Polycube, RefusesAGridWithoutCells) {
  EXPECT_THROW(Polycube(0, 1, 1), std::invalid_argument);
  EXPECT_THROW(Polycube(1, -1, 1), std::invalid_argument);
  EXPECT_THROW(Polycube(1, 1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace menger::meshes
