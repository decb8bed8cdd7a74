#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "meshes/design/polycube.h"
#include "voxel/laws/lattice.h"

namespace menger::voxel {

/// A body of at least two copies of one block on a grid of blocks. A block has up to 3 x 3 x 3 cells. The aggregate of a design
/// with a grid of 3 x 3 x 3 cells is such a body from level 2 on.
///
/// All copies have the same cells; their materials may differ. Two neighbouring copies are joined wherever a cell of one touches
/// a cell of the other face to face.
struct BlockBody {
  meshes::Polycube block;              ///< cells of a block
  std::size_t count = 0;               ///< number of blocks, >= 2
  std::vector<std::int32_t> block_of;  ///< per voxel of the body: its block
  std::vector<std::int32_t> place;     ///< per voxel of the body: its position among the voxels of its block
  std::vector<std::int32_t> voxel;     ///< voxel at place p of block b: voxel[b * places + p]
  /// Per axis: lower and upper block, sorted by lower.
  std::array<std::vector<std::pair<std::int32_t, std::int32_t>>, 3> neighbours;
  /// Per axis: places where two neighbours are joined, in the lower and in the upper block.
  std::array<std::vector<std::pair<std::int32_t, std::int32_t>>, 3> faces;

  [[nodiscard]] std::size_t places() const { return voxel.size() / count; }
};

/// Divides a body into blocks. Returns nothing if there are fewer than two blocks or if they differ.
std::optional<BlockBody> blocks_of(const Lattice& lattice);

}  // namespace menger::voxel
