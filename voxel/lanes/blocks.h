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

/// A body made of copies of one block of 3 x 3 x 3 cells, which stand on a grid of blocks: a fractal from its second level on.
///
/// Copies have the same cells; of materials nothing is said. Two copies beside each other are joined wherever their faces meet.
struct BlockBody {
  meshes::Polycube block;              ///< cells of a block
  std::size_t count = 0;               ///< of blocks, >= 2
  std::vector<std::int32_t> block_of;  ///< per voxel of the body
  std::vector<std::int32_t> place;     ///< per voxel: its position among those of its block
  std::vector<std::int32_t> voxel;     ///< of block b and place p: voxel[b * places + p]
  std::array<std::vector<std::pair<std::int32_t, std::int32_t>>, 3> neighbours;  ///< per axis: lower and upper block, by lower
  std::array<std::vector<std::pair<std::int32_t, std::int32_t>>, 3> faces;  ///< per axis: places that two neighbours join, in the
                                                                            ///< lower and in the upper block

  [[nodiscard]] std::size_t places() const { return voxel.size() / count; }
};

/// The blocks of a body, if it has at least two and they are alike.
std::optional<BlockBody> blocks_of(const Lattice& lattice);

}  // namespace menger::voxel
