#include "voxel/lanes/blocks.h"

#include <algorithm>
#include <map>

namespace menger::voxel {

namespace {

constexpr int side = 3;

/// Position of a cell's block on the grid of blocks, x fastest.
int block_place(const meshes::CellIndex& cell, const std::array<int, 3>& grid) {
  return cell.x / side + grid[0] / side * (cell.y / side + grid[1] / side * (cell.z / side));
}

/// Position of a cell within its block.
int cell_place(const meshes::CellIndex& cell) { return cell.x % side + side * (cell.y % side + side * (cell.z % side)); }

/// Numbers the blocks in grid order and assigns every voxel its place. @return whether all blocks have the same cells
bool place_voxels(const Lattice& lattice, BlockBody& body, std::map<int, std::int32_t>& block_at) {
  for (const meshes::CellIndex& cell : lattice.cells) {
    block_at.emplace(block_place(cell, lattice.grid), 0);
    body.block.set({cell.x % side, cell.y % side, cell.z % side}, 1);
  }
  body.count = block_at.size();
  std::int32_t next = 0;
  for (auto& [place, number] : block_at) number = next++;
  // If every block has each cell that any block has, the number of voxels is blocks times cells.
  const std::size_t places = body.block.count();
  if (lattice.voxel_count() != body.count * places) return false;

  std::array<std::int32_t, std::size_t{side} * side * side> place_of{};
  std::int32_t place = 0;
  for (const meshes::CellIndex& cell : body.block.occupied()) place_of[static_cast<std::size_t>(cell_place(cell))] = place++;
  body.voxel.assign(lattice.voxel_count(), 0);
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const meshes::CellIndex& cell = lattice.cells[i];
    body.block_of.push_back(block_at[block_place(cell, lattice.grid)]);
    body.place.push_back(place_of[static_cast<std::size_t>(cell_place(cell))]);
    body.voxel[static_cast<std::size_t>(body.block_of[i]) * places + static_cast<std::size_t>(body.place[i])] =
        static_cast<std::int32_t>(i);
  }
  return true;
}

}  // namespace

std::optional<BlockBody> blocks_of(const Lattice& lattice) {
  for (const int cells : lattice.grid) {
    if (cells % side != 0) return std::nullopt;
  }
  BlockBody body;
  body.block = meshes::Polycube(side, side, side);
  std::map<int, std::int32_t> block_at;
  if (!place_voxels(lattice, body, block_at) || body.count < 2) return std::nullopt;

  const std::array<int, 3> blocks{lattice.grid[0] / side, lattice.grid[1] / side, lattice.grid[2] / side};
  const std::array<int, 3> stride{1, blocks[0], blocks[0] * blocks[1]};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const auto& [place, number] : block_at) {
      const bool is_last = place / stride[axis] % blocks[axis] == blocks[axis] - 1;
      const auto next = is_last ? block_at.end() : block_at.find(place + stride[axis]);
      if (next != block_at.end()) body.neighbours[axis].emplace_back(number, next->second);
    }
    const std::vector<meshes::CellIndex> cells = body.block.occupied();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      meshes::CellIndex facing = cells[i];
      int& along = axis == 0 ? facing.x : axis == 1 ? facing.y : facing.z;
      if (along != side - 1) continue;
      along = 0;
      const auto found = std::find(cells.begin(), cells.end(), facing);
      if (found != cells.end())
        body.faces[axis].emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(found - cells.begin()));
    }
  }
  return body;
}

}  // namespace menger::voxel
