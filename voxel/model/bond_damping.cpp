#include "voxel/model/bond_damping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace menger::voxel {

double bond_rate_factor(const Physics& physics, double density_kg_m3, double other_density_kg_m3) {
  const bool takes_means = physics.beam_moments == BeamMoments::balanced || physics.integration.damping == DampingMode::velocity;
  if (!takes_means) return 1.0;
  const double ratio = std::max(density_kg_m3, other_density_kg_m3) / std::min(density_kg_m3, other_density_kg_m3);
  return std::max(1.0, 0.25 * (1.0 + std::sqrt(ratio)) * (1.0 + 1.0 / ratio));
}

double effective_bond_ratio(const Physics& physics) {
  const double ratio = physics.damping_ratios.bond;
  if (physics.integration.bond_damping == BondDamping::explicit_step) return ratio;
  const double factor = bond_rate_factor(physics, physics.materials[0].density_kg_m3, physics.materials[1].density_kg_m3);
  // The step is at most that of a body without lateral coupling.
  const double phase = physics.integration.time_step_fraction / (2.0 * std::numbers::pi);
  return ratio / (1.0 + 12.0 * factor * ratio * phase);
}

}  // namespace menger::voxel
