#include "voxel/engine/divergence.h"

#include "io/text/number_text.h"

namespace menger::voxel {

std::string divergence_text(const Divergence& divergence) {
  const meshes::CellIndex& cell = divergence.cell;
  std::string text = "voxel " + std::to_string(divergence.voxel) + " (cell " + std::to_string(cell.x) + ", " +
                     std::to_string(cell.y) + ", " + std::to_string(cell.z) + "): " + divergence.quantity;
  if (divergence.value) text += " " + io::number_text(*divergence.value) + ", limit " + io::number_text(divergence.limit);
  return text + ", at " + io::number_text(divergence.time_s) + " s";
}

}  // namespace menger::voxel
