#include "voxel/time_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace menger::voxel {

double voxel_mass_kg(const VoxelMaterial& material, double cell_edge_m) {
  return material.density_kg_m3 * cell_edge_m * cell_edge_m * cell_edge_m;
}

double beam_modulus_Pa(const VoxelMaterial& a, const VoxelMaterial& b) {
  return 2.0 * a.youngs_modulus_Pa * b.youngs_modulus_Pa / (a.youngs_modulus_Pa + b.youngs_modulus_Pa);
}

double recommended_time_step_s(const Lattice& lattice, double cell_edge_m, const Physics& physics) {
  const auto material_of = [&](std::int32_t voxel) -> const VoxelMaterial& {
    return physics.materials[static_cast<std::size_t>(lattice.material[static_cast<std::size_t>(voxel)] - 1)];
  };
  double largest = 0.0;
  for (const AxisBeams& beams : lattice.beams) {
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const VoxelMaterial& a = material_of(beams.lower[i]);
      const VoxelMaterial& b = material_of(beams.upper[i]);
      const double lighter = std::min(voxel_mass_kg(a, cell_edge_m), voxel_mass_kg(b, cell_edge_m));
      largest = std::max(largest, beam_modulus_Pa(a, b) * cell_edge_m / lighter);
    }
  }
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const bool alone =
        std::all_of(lattice.neighbours[i].begin(), lattice.neighbours[i].end(), [](std::int32_t other) { return other < 0; });
    if (!alone) continue;
    const VoxelMaterial& material = material_of(static_cast<std::int32_t>(i));
    largest = std::max(largest, material.youngs_modulus_Pa * cell_edge_m / voxel_mass_kg(material, cell_edge_m));
  }
  return 1.0 / (2.0 * std::numbers::pi * std::sqrt(largest));
}

}  // namespace menger::voxel
