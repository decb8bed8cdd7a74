#include "meshes/hexahedra/grid_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "meshes/design/reference_shapes.h"

namespace menger::meshes {
namespace {

TEST(GradedEdges, AreEqualWhereTheyMayNotGrow) {
  EXPECT_EQ(graded_edges(0.016, 0.002, 1.5, 0.002), std::vector<double>(8, 0.002));
  EXPECT_EQ(graded_edges(0.016, 0.002, 1.0, 0.01), std::vector<double>(8, 0.002));
  EXPECT_EQ(graded_edges(1.0, 0.3, 1.0, 0.3), std::vector<double>(4, 0.25)) << "no edge may be longer than 0.3";
  EXPECT_EQ(graded_edges(1.0, 0.5, 2.0, 0.125), std::vector<double>(8, 0.125)) << "the largest edge holds at the ends, too";
}

TEST(GradedEdges, GrowFromBothEndsWithinTheirBounds) {
  for (const double span : {0.9, 1.0, 7.3, 40.0}) {
    const std::vector<double> edges = graded_edges(span, 0.1, 1.3, 1.5);
    EXPECT_NEAR(std::accumulate(edges.begin(), edges.end(), 0.0), span, 1e-14 * span);
    EXPECT_LE(edges.front(), 0.1);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      EXPECT_DOUBLE_EQ(edges[i], edges[edges.size() - 1 - i]);
      EXPECT_LE(edges[i], 1.5);
      if (i > 0 && 2 * i < edges.size()) {
        EXPECT_GE(edges[i], edges[i - 1] * (1.0 - 1e-14));
        EXPECT_LE(edges[i], edges[i - 1] * 1.3 * (1.0 + 1e-14));
      }
    }
  }
}

TEST(GradedEdges, AreAsFewAsPossible) {
  // 1 + 2 + 4 + 2 + 1 fills 10; one fewer, 1 + 2 + 2 + 1, does not.
  EXPECT_EQ(graded_edges(10.0, 1.0, 2.0, 8.0), (std::vector<double>{1.0, 2.0, 4.0, 2.0, 1.0}));
  EXPECT_EQ(graded_edges(6.0, 1.0, 2.0, 8.0), (std::vector<double>{1.0, 2.0, 2.0, 1.0}));
}

TEST(GradedEdges, ManyOfThemTakeOnePass) {
  // A hundred thousand edges that hardly grow: rebuilding the list for each would take minutes.
  const std::vector<double> edges = graded_edges(1.0, 1e-5, 1.0 + 1e-9, 2e-5);
  EXPECT_NEAR(static_cast<double>(edges.size()), 1e5, 10.0);
  EXPECT_NEAR(std::accumulate(edges.begin(), edges.end(), 0.0), 1.0, 1e-11);
}

TEST(GridLines, FollowTheWallsOnly) {
  HollowBodyOptions options;
  options.wall_thickness_m = 2.0;
  options.largest_element_m = 100.0;
  options.growth = 100.0;
  const auto lines = grid_lines(ModularBody(bar(2), 1, ChamberLayout::single), 10.0, options, {});
  const auto has = [&](std::size_t axis, double line) { return std::count(lines[axis].begin(), lines[axis].end(), line) == 1; };
  for (const double line : {0.0, 2.0, 18.0, 20.0}) EXPECT_TRUE(has(0, line)) << line;
  for (const double line : {0.0, 2.0, 8.0, 10.0}) EXPECT_TRUE(has(1, line) && has(2, line)) << line;
  // No wall lies between the two cells, so the span of 16 is cut like any other: into three.
  EXPECT_EQ(lines[0].size(), 6U);
  EXPECT_FALSE(has(0, 10.0));
}

TEST(GridLines, WallsBetweenPhasesHaveTheAskedNumberOfElements) {
  HollowBodyOptions options;
  options.wall_thickness_m = 2.0;
  options.chambers = ChamberLayout::per_phase;
  for (const int n : {1, 2, 3}) {
    options.elements_through_wall = n;
    const auto lines =
        grid_lines(ModularBody(Polycube::from_digits(2, 1, 1, "12"), 1, ChamberLayout::per_phase), 10.0, options, {});
    const auto between = [&](double low, double high) {
      return std::count_if(lines[0].begin(), lines[0].end(),
                           [&](double line) { return line > low - 1e-9 && line < high + 1e-9; });
    };
    EXPECT_EQ(between(0.0, 2.0), n + 1);
    EXPECT_EQ(between(9.0, 11.0), n + 1) << "the wall between the phases lies in the middle of the plane";
    EXPECT_EQ(between(18.0, 20.0), n + 1);
  }
}

// The 6 mm between the walls of a cell in three parts; the 16 mm between those of two cells in the fewest that are no longer.
TEST(GridLines, CutSpansIntoEqualElements) {
  HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.elements_per_span = 3;
  const ModularBody body(Polycube::from_digits(2, 1, 1, "11"), 1, ChamberLayout::single);
  const std::array<GridLines, 3> lines = grid_lines(body, 10e-3, options, {});
  const GridLines across{0.0, 2e-3, 4e-3, 6e-3, 8e-3, 10e-3};
  ASSERT_EQ(lines[1].size(), across.size());
  for (std::size_t n = 0; n < across.size(); ++n) EXPECT_NEAR(lines[1][n], across[n], 1e-15);
  ASSERT_EQ(lines[0].size(), 11U);
  for (std::size_t n = 0; n < 11; ++n) EXPECT_NEAR(lines[0][n], 2e-3 * static_cast<double>(n), 1e-15);
}

}  // namespace
}  // namespace menger::meshes
