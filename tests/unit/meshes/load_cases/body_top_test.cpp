#include "meshes/load_cases/body_top.h"

#include <gtest/gtest.h>

#include <string>

#include "meshes/load_cases/load_case.h"

namespace menger::meshes {
namespace {

using Points = std::vector<std::array<double, 3>>;

Points points_of(const std::array<int, 3>& grid, const std::string& digits) {
  return top_of(occupied_cells(grid, digits)).points;
}

TEST(BodyTop, IsItsMiddleWhereACellReachesIt) {
  EXPECT_EQ(points_of({3, 1, 1}, "111"), (Points{{1.5, 0.5, 1.0}}));
  EXPECT_EQ(points_of({2, 2, 2}, "11111111"), (Points{{1.0, 1.0, 2.0}})) << "four cells meet there";
  EXPECT_EQ(points_of({2, 2, 1}, "1110"), (Points{{1.0, 1.0, 1.0}})) << "an elbow";
}

TEST(BodyTop, IsBesideAMiddleThatIsOpen) {
  EXPECT_EQ(points_of({3, 3, 1}, "111101111")),
            (Points{{1.5, 1.0, 1.0}, {1.0, 1.5, 1.0}, {2.0, 1.5, 1.0}, {1.5, 2.0, 1.0}}))
      << "a ring";
  EXPECT_EQ(points_of({3, 3, 1}, "111100100"), (Points{{1.5, 1.0, 1.0}, {1.0, 1.5, 1.0}})) << "an L";
}

TEST(BodyTop, IsOpenWhereNoCellReachesTheMiddle) {
  EXPECT_FALSE(top_of(occupied_cells({3, 1, 1}, "111")).is_open);
  EXPECT_FALSE(top_of(occupied_cells({2, 2, 1}, "1110")).is_open);
  EXPECT_TRUE(top_of(occupied_cells({3, 3, 1}, "111101111")).is_open);
  EXPECT_TRUE(top_of(occupied_cells({3, 3, 2}, "111111111100000000")).is_open);
}

TEST(BodyTop, NamesTheCellsNearestToTheMiddle) {
  EXPECT_EQ(top_of(occupied_cells({3, 1, 1}, "111")).cells, (std::vector<std::size_t>{1}));
  EXPECT_EQ(top_of(occupied_cells({3, 3, 1}, "111101111")).cells, (std::vector<std::size_t>{1, 3, 4, 6})) << "a ring";
}

TEST(BodyTop, SaysOnWhichSidesOfItsCellsItLies) {
  using Sides = std::vector<std::array<int, 2>>;
  EXPECT_EQ(top_of(occupied_cells({3, 1, 1}, "111")).towards, (Sides{{0, 0}}));
  EXPECT_EQ(top_of(occupied_cells({2, 1, 1}, "11")).towards, (Sides{{1, 0}, {-1, 0}}));
  EXPECT_EQ(top_of(occupied_cells({2, 2, 1}, "1110")).towards, (Sides{{1, 1}, {-1, 1}, {1, -1}}));
}

TEST(BodyTop, LooksAtTheTopLayerAlone) {
  // A full lower layer, and a top of one cell in a corner.
  EXPECT_EQ(points_of({3, 3, 2}, "111111111100000000"), (Points{{1.0, 1.0, 2.0}}));
}

TEST(BodyTop, DoesNotCountEmptyCellsAroundTheBody) {
  EXPECT_EQ(points_of({5, 3, 2}, "000000111000000000000000000000"), (Points{{2.5, 1.5, 1.0}}));
}

}  // namespace
}  // namespace menger::meshes
