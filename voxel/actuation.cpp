#include "voxel/actuation.h"

#include <algorithm>

namespace menger::voxel {

std::vector<double> actuation_phases(const Lattice& lattice, const Actuation& actuation) {
  std::vector<double> phases(lattice.voxel_count(), 0.0);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (actuation.mode == ActuationMode::antiphase) {
      phases[i] = actuation.material_phase[static_cast<std::size_t>(lattice.material[i] - 1)];
    } else if (actuation.mode == ActuationMode::wave) {
      const meshes::CellIndex& cell = lattice.cells[i];
      const int position = actuation.wave_axis == 0 ? cell.x : actuation.wave_axis == 1 ? cell.y : cell.z;
      const int width = lattice.grid[static_cast<std::size_t>(actuation.wave_axis)];
      const int length = actuation.wave_over_gaps ? std::max(width - 1, 1) : width;
      phases[i] = actuation.wave_periods_per_body * static_cast<double>(position) / static_cast<double>(length);
    }
  }
  return phases;
}

}  // namespace menger::voxel
