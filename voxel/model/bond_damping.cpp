#include "voxel/model/bond_damping.h"

#include <numbers>

namespace menger::voxel {

double effective_bond_ratio(const Physics& physics) {
  const double ratio = physics.damping_ratios.bond;
  if (physics.integration.bond_damping == BondDamping::explicit_step) return ratio;
  // The step is at most that of a body without lateral coupling.
  const double phase = physics.integration.time_step_fraction / (2.0 * std::numbers::pi);
  return ratio / (1.0 + 12.0 * ratio * phase);
}

}  // namespace menger::voxel
