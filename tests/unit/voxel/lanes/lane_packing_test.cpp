#include "voxel/lanes/lane_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "meshes/design/reference_shapes.h"

namespace menger::voxel {
namespace {

using Shares = std::vector<std::size_t>;

TEST(LanePacking, GivesEveryWorkerAsManyRegistersOfEqualFilling) {
  EXPECT_EQ(register_shares(32, 8, 3), (Shares{6, 6, 5, 5, 5, 5}));
  EXPECT_EQ(register_shares(33, 8, 8), (Shares{5, 4, 4, 4, 4, 4, 4, 4}));
  EXPECT_EQ(register_shares(16, 8, 2), (Shares{8, 8}));
  EXPECT_EQ(register_shares(3, 8, 8), (Shares{1, 1, 1})) << "fewer robots than workers";
  EXPECT_EQ(register_shares(0, 8, 2), Shares{});
  for (const std::size_t lanes : {1U, 2U, 4U, 16U}) {
    for (std::size_t robots = 1; robots <= 70; ++robots) {
      for (const std::size_t workers : {1U, 2U, 5U}) {
        const Shares shares = register_shares(robots, lanes, workers);
        const auto [least, most] = std::ranges::minmax(shares);
        EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), std::size_t{0}), robots);
        EXPECT_LE(most, lanes);
        EXPECT_LE(most - least, 1U);
        EXPECT_TRUE(shares.size() % workers == 0 || shares.size() == robots) << robots << " " << lanes << " " << workers;
      }
    }
  }
}

TEST(LanePacking, TakesWhatSharesCells) {
  // bodies on a grid of 2 x 2: a pair twice, its first cell, and one that lies elsewhere
  const std::vector<std::vector<bool>> cells{
      {true, true, false, false}, {false, false, true, false}, {true, true, false, false}, {true, false, false, false}};
  Shares left{0, 1, 2, 3};
  EXPECT_EQ(take_similar(cells, left, 3), (Shares{0, 2, 3})) << "the largest, its copy, its part";
  EXPECT_EQ(left, Shares{1});
}

TEST(LanePacking, PaysForCopiesThatFillARegisterAndNotForFewOrUnlikeBodies) {
  const meshes::Polycube sponge = meshes::menger_sponge();
  const std::array<int, 3> grid{sponge.nx(), sponge.ny(), sponge.nz()};
  const std::vector<bool> body = cells_of(grid, sponge.occupied());
  const auto copies = [&](std::size_t count) { return std::vector<std::vector<bool>>(count, body); };
  EXPECT_FALSE(lanes_pay(copies(1), grid, 8));
  EXPECT_TRUE(lanes_pay(copies(8), grid, 8));
  // 24 beams and 20 voxels: alone 3 registers of beams and of voxels each by 1.8 and 0.8, together 0.65 (24 + 0.4 20) = 20.8
  EXPECT_FALSE(lanes_pay(copies(2), grid, 8)) << "15.6 alone";
  std::vector<std::vector<bool>> single_cells(4, std::vector<bool>(27, false));
  for (std::size_t n = 0; n < 4; ++n) single_cells[n][8 * n] = true;
  EXPECT_FALSE(lanes_pay(std::vector<std::vector<bool>>{body, single_cells[1]}, grid, 8)) << "nothing in common";
}

}  // namespace
}  // namespace menger::voxel
