#include "voxel/engine/divergence.h"

#include "io/text/formatted.h"

namespace menger::voxel {

std::string divergence_text(const Divergence& divergence) {
  const meshes::CellIndex& cell = divergence.cell;
  std::string text = "voxel " + std::to_string(divergence.voxel) + " (cell " + std::to_string(cell.x) + ", " +
                     std::to_string(cell.y) + ", " + std::to_string(cell.z) + "): " + divergence.quantity;
  if (divergence.value) text += " " + io::shown(*divergence.value) + ", limit " + io::shown(divergence.limit);
  return text + ", at " + io::shown(divergence.time_s) + " s";
}

}  // namespace menger::voxel
