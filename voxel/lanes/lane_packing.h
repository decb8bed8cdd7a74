#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Whether robots of a physics can be stepped in SIMD lanes: solid voxels without lateral coupling, with a drive that is a sine
/// from the start on, or none.
bool runs_in_lanes(const Physics& physics);

/// Which cells of a grid a body has. @param cells those that it has
std::vector<bool> cells_of(const std::array<int, 3>& grid, const std::vector<meshes::CellIndex>& cells);

/// How many of so many robots go into each register: no more than there are lanes, a multiple of the workers where there are
/// robots enough, and sizes that differ by one at most.
std::vector<std::size_t> register_shares(std::size_t robots, std::size_t lanes, std::size_t workers);

/// The next bodies for one register, taken out of those that are left: the largest first, then always the one that adds the
/// fewest cells to those that the register has, and of these the largest; all on one grid.
/// @param cells per body @param left positions in `cells`, not empty @return 1 to `count` positions
std::vector<std::size_t> take_similar(std::span<const std::vector<bool>> cells, std::vector<std::size_t>& left,
                                      std::size_t count);

/// Whether bodies are stepped faster in the lanes of one register than one after the other, by an estimate from measured times
/// of both ways: few bodies leave lanes empty, and different ones make every lane compute what only others have.
/// @param cells per body, of one grid @param grid its size @param lanes of the widest register
bool lanes_pay(std::span<const std::vector<bool>> cells, const std::array<int, 3>& grid, std::size_t lanes);

/// Bodies to step together, so that as many workers as possible have a share: groups of positions, each position in one of them,
/// each for one call of advance_together_to. Bodies for which lanes do not pay stand alone.
/// @param workers >= 1
std::vector<std::vector<std::size_t>> lane_groups(std::span<const meshes::Polycube* const> bodies, double cell_edge_m,
                                                  const Physics& physics, int workers);

}  // namespace menger::voxel
