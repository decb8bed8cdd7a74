#include "fem/picture/cutting_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace menger::fem {
namespace {

constexpr double edge_m = 0.012;
constexpr double wall_m = 0.0025;

/// Layers from below, each of rows along y, each of digits along x: the material of a cell, 0 where there is none.
using Layers = std::vector<std::vector<std::string>>;

/// The elements of a hollow body, 3 x 3 x 3 boxes in each cell less those of its chamber. Cells of one material share a chamber.
std::vector<ElementBox> hollow_body(const Layers& layers) {
  const auto digit = [&](int x, int y, int z) {
    if (z < 0 || z >= static_cast<int>(layers.size())) return '0';
    const auto& rows = layers[static_cast<std::size_t>(z)];
    if (y < 0 || y >= static_cast<int>(rows.size())) return '0';
    const std::string& row = rows[static_cast<std::size_t>(y)];
    return x < 0 || x >= static_cast<int>(row.size()) ? '0' : row[static_cast<std::size_t>(x)];
  };
  constexpr std::array<double, 4> planes{0.0, wall_m, edge_m - wall_m, edge_m};
  std::vector<ElementBox> boxes;
  for (int z = 0; z < static_cast<int>(layers.size()); ++z) {
    for (int y = 0; y < static_cast<int>(layers[0].size()); ++y) {
      for (int x = 0; x < static_cast<int>(layers[0][0].size()); ++x) {
        const char own = digit(x, y, z);
        if (own == '0') continue;
        for (int part = 0; part < 27; ++part) {
          const std::array<int, 3> at{part % 3 - 1, part / 3 % 3 - 1, part / 9 - 1};
          // hollow where all cells that meet at this part are of one chamber
          bool is_hollow = true;
          for (int other = 0; other < 8; ++other) {
            const std::array<int, 3> step{other % 2 * at[0], other / 2 % 2 * at[1], other / 4 * at[2]};
            is_hollow = is_hollow && digit(x + step[0], y + step[1], z + step[2]) == own;
          }
          if (is_hollow) continue;
          const std::array<int, 3> cell{x, y, z};
          ElementBox box;
          for (std::size_t i = 0; i < 3; ++i) {
            const auto first = static_cast<std::size_t>(at[i]) + 1;  // from -1, 0, 1
            box[0][i] = cell[i] * edge_m + planes.at(first);
            box[1][i] = cell[i] * edge_m + planes.at(first + 1);
          }
          boxes.push_back(box);
        }
      }
    }
  }
  return boxes;
}

TEST(CuttingPlane, OpensTheLegsOfATableInsteadOfTakingThemAway) {
  EXPECT_NEAR(cutting_depth(hollow_body({{"000", "101", "000"}, {"111", "111", "111"}})), 1.5 * edge_m, 1e-9);
}

TEST(CuttingPlane, LiesInTheMiddleOfACubeAndOfACrawler) {
  EXPECT_NEAR(cutting_depth(hollow_body({{"1"}})), 0.5 * edge_m, 1e-9);
  EXPECT_NEAR(cutting_depth(hollow_body({{"100", "100", "100"}, {"111", "111", "111"}})), 1.5 * edge_m, 1e-9);
}

TEST(CuttingPlane, LeavesTheFrontLegsOfAQuadruped) {
  const double depth = cutting_depth(hollow_body({{"101", "000", "101"}, {"111", "111", "111"}}));
  EXPECT_GT(depth, wall_m) << "chambers stay closed";
  EXPECT_LT(depth, 0.6 * edge_m + 1e-9) << "most of the front legs is taken away";
}

TEST(CuttingPlane, LeavesAnArmAtTheFront) {
  const double depth = cutting_depth(hollow_body({{"1111", "1100", "1100"}}));
  EXPECT_GT(depth, wall_m);
  EXPECT_LT(depth, 0.6 * edge_m + 1e-9);
}

TEST(CuttingPlane, KeepsOffTheWallBetweenTwoChambers) {
  const double depth = cutting_depth(hollow_body({{"111", "222"}}));
  EXPECT_GT(std::abs(depth - edge_m), wall_m) << "the middle is this wall";
  EXPECT_GT(depth, wall_m);
  EXPECT_LT(depth, 2.0 * edge_m - wall_m);
}

TEST(CuttingPlane, DoesNotNeedAChamber) { EXPECT_NEAR(cutting_depth({{Point{0.0, 0.0, 0.0}, Point{1.0, 2.0, 1.0}}}), 1.0, 1e-9); }

}  // namespace
}  // namespace menger::fem
