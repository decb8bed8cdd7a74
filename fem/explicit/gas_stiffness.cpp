#include "fem/explicit/gas_stiffness.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace menger::fem {

double gas_stiffness_per_s2(const ExplicitChambers& chambers, const ExplicitBody& body, std::span<const double> displacements_m,
                            const PneumaticSupply& supply, const PneumaticState& state) {
  std::vector<double> positions = body.reference_positions_m();
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] += displacements_m[n];
  positions.push_back(0.0);  // kernels read one number more
  AlignedNumbers forces(chambers.number_count());
  const FourfoldSlots& slots = chambers.slots();
  double largest = 0.0;
  for (std::size_t j = 0; j < supply.plenum_count(); ++j) {
    if (!supply.has_line(j)) continue;
    std::vector<double> unit(supply.plenum_count(), 0.0);
    unit[j] = 1.0;
    chambers.set_face_forces(positions, unit, {0, chambers.batch_count()}, forces);
    chambers.set_cap_forces(positions, unit, forces);
    double sum = 0.0;
    for (std::size_t node = 0; node < body.node_count(); ++node) {
      const auto gradient = slots.sum(forces.data(), node);
      for (const double component : gradient) sum += component * component / body.masses_kg()[node];
    }
    largest = std::max(largest, supply.stiffness_Pa_per_m3(state, j) * sum);
  }
  return largest;
}

}  // namespace menger::fem
