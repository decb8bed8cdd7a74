#include "meshes/load_cases/body_feet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/load_cases/load_case.h"

namespace menger::meshes {
namespace {

using Places = std::vector<std::array<double, 3>>;

/// Ends of a box that begins at the origin, turned about z and moved along x.
EndPoints ends_of(const std::array<double, 3>& size, double angle_rad, double shift_m) {
  EndPoints ends{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      std::array<double, 3> at{0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};
      at[axis] = side == 1 ? size[axis] : 0.0;
      ends[axis][side] = {std::cos(angle_rad) * at[0] - std::sin(angle_rad) * at[1] + shift_m,
                          std::sin(angle_rad) * at[0] + std::cos(angle_rad) * at[1], at[2]};
    }
  }
  return ends;
}

TEST(BodyFeet, AreThePartsOfTheLowestLayer) {
  // Two cells that touch, one that touches them only at an edge, and a roof over all.
  const auto cells = occupied_cells({3, 2, 2}, "110001111111");
  const std::vector<std::vector<std::size_t>> feet{{0, 1}, {2}};
  EXPECT_EQ(feet_of(cells), feet);
  EXPECT_EQ(feet_of(occupied_cells({1, 1, 3}, "011")).size(), 1U) << "the lowest cells, wherever the grid begins";
}

TEST(BodyFeet, MoveOutwardsFromTheMiddleOfAll) {
  const EndPoints box = ends_of({0.03, 0.02, 0.01}, 0.0, 0.0);
  const Places at_rest{{0.005, 0.01, 0.0}, {0.025, 0.01, 0.0}, {0.015, 0.01, 0.0}};
  Places spread = at_rest;
  spread[0][0] -= 2e-3;
  spread[0][1] += 1e-3;  // across
  spread[1][0] += 2e-3;
  spread[2][1] -= 1e-3;
  const std::vector<double> outwards = feet_outwards_m(at_rest, spread, box, box);
  EXPECT_NEAR(outwards[0], 2e-3, 1e-15);
  EXPECT_NEAR(outwards[1], 2e-3, 1e-15);
  EXPECT_EQ(outwards[2], 0.0) << "a foot in the middle has no direction";
}

TEST(BodyFeet, DoNotMoveWithTheWholeBody) {
  constexpr double angle = 0.7;
  const EndPoints box = ends_of({0.03, 0.02, 0.01}, 0.0, 0.0);
  const Places at_rest{{0.005, 0.005, 0.0}, {0.025, 0.012, 0.0}};
  Places moved;
  for (const auto& [x, y, z] : at_rest)
    moved.push_back({std::cos(angle) * x - std::sin(angle) * y + 0.3, std::sin(angle) * x + std::cos(angle) * y, z});
  for (const double outwards : feet_outwards_m(at_rest, moved, box, ends_of({0.03, 0.02, 0.01}, angle, 0.3)))
    EXPECT_NEAR(outwards, 0.0, 1e-12);
}

TEST(BodyFeet, AreColumnsOfAnInflationOnSeveralFeet) {
  LoadCase table{.name = "table", .kind = LoadCaseKind::inflation, .cells = {3, 1, 2}, .digits = "101111"};
  const std::vector<std::string> columns = response_columns(table);
  ASSERT_EQ(columns.size(), response_columns(LoadCaseKind::inflation).size() + 2);
  EXPECT_EQ(columns.back(), "foot_2_out_m");
  table.level = 2;
  EXPECT_EQ(response_columns(table), response_columns(LoadCaseKind::inflation)) << "modules are not told apart";
  table.level = 1;
  table.kind = LoadCaseKind::stretch;
  EXPECT_EQ(response_columns(table), response_columns(LoadCaseKind::stretch));
  const LoadCase bar{.name = "bar", .kind = LoadCaseKind::inflation, .cells = {3, 1, 1}, .digits = "111"};
  EXPECT_EQ(response_columns(bar), response_columns(LoadCaseKind::inflation)) << "one foot";
}

}  // namespace
}  // namespace menger::meshes
