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
  largest *= 1.0 + 2.0 * effective_coupling(physics);
  return 1.0 / (2.0 * std::numbers::pi * std::sqrt(largest));
}

double recommended_time_step_s(const Lattice& lattice, const BodyClasses& classes, double coupling) {
  double largest = 0.0;
  double damping = 0.0;  // ratio of beams, each end's to its own mass
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const AxisBeams& beams = lattice.beams[axis];
    for (std::size_t i = 0; i < beams.lower.size(); ++i) {
      const auto lower = static_cast<std::size_t>(beams.lower[i]);
      const auto upper = static_cast<std::size_t>(beams.upper[i]);
      const BeamCoefficients<double>& beam = classes.beam[classes.beam_class[axis][i]];
      const double mass = std::min(classes.mass_kg[lower], classes.mass_kg[upper]);
      const double inertia = std::min(classes.inertia_kg_m2[lower], classes.inertia_kg_m2[upper]);
      const double stretch = (1.0 + 2.0 * coupling) * beam.axial_root * beam.axial_root;
      // Shear takes from the turn of one end against both, but not from the curvature between them.
      const double turn = beam.turn + beam.turn_difference;
      largest = std::max({largest, stretch / mass, beam.shear / mass, turn / inertia, beam.twist / inertia});
      damping = std::max({damping, beam.damping_lower / std::sqrt(classes.mass_kg[lower]),
                          beam.damping_upper / std::sqrt(classes.mass_kg[upper])});
    }
  }
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    const double ground = classes.voxel[classes.voxel_class[i]].floor.stiffness;
    largest = std::max(largest, 0.5 * ground / classes.mass_kg[i]);
  }
  // The damping is explicit: from twice the paper's on it limits the step in proportion.
  constexpr double undamped = 2.0;
  return 1.0 / (2.0 * std::numbers::pi * std::sqrt(largest) * std::max(1.0, damping / undamped));
}

}  // namespace menger::voxel
