#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Whether robots with these physics can be stepped in SIMD lanes. That needs solid voxels without lateral coupling, and no drive
/// or one that is a sine from the start on.
bool runs_in_lanes(const Physics& physics);

/// Which cells of a grid are occupied, x fastest. @param cells the occupied ones
std::vector<bool> cells_of(const std::array<int, 3>& grid, const std::vector<meshes::CellIndex>& cells);

/// How many robots go into each register. No register gets more robots than it has lanes; the number of registers is a
/// multiple of the workers if there are enough robots. The numbers of robots differ by one at most.
std::vector<std::size_t> register_shares(std::size_t robots, std::size_t lanes, std::size_t workers);

/// Takes the next bodies for one register out of those that are left.
///
/// The first is the largest body. Each next one adds the fewest cells to those that the register already has; among equals it is
/// the largest. All bodies are on one grid.
/// @param cells per body @param left positions in `cells`, not empty @return 1 to `count` positions
std::vector<std::size_t> take_similar(std::span<const std::vector<bool>> cells, std::vector<std::size_t>& left,
                                      std::size_t count);

/// Whether bodies are stepped faster in the lanes of one register than one after the other. This is an estimate from measured
/// times of both: few bodies leave lanes empty, and with different bodies every lane also computes the cells that only others
/// have.
/// @param cells per body, all on one grid @param grid number of cells along x, y, z @param lanes of the widest register
bool lanes_pay(std::span<const std::vector<bool>> cells, const std::array<int, 3>& grid, std::size_t lanes);

/// Groups bodies that are best stepped together, so that as many workers as possible have a share. Every group is a list of
/// positions in `bodies` for one call of advance_together_to; each position is in one group. Bodies for
/// which lanes do not pay get a group each.
/// @param workers >= 1
std::vector<std::vector<std::size_t>> lane_groups(std::span<const meshes::Polycube* const> bodies, double cell_edge_m,
                                                  const Physics& physics, int workers);

}  // namespace menger::voxel
