#include "voxel/calibration/calibration_damping.h"

#include <cmath>
#include <numbers>

namespace menger::voxel {

double bond_damping_ratio(const SurrogateParameters& parameters, const materials::LossData& loss) {
  const double edge_m = parameters.voxel_edge_m();
  const double inside = 1.0 - 2.0 * parameters.wall_thickness_m / parameters.cell_edge_m;
  const double mass_kg = parameters.density_kg_m3 * edge_m * edge_m * edge_m * (1.0 - inside * inside);
  const double axial_N_per_m = parameters.axial_Pa.back() * edge_m;
  const double omega = 2.0 * std::numbers::pi * loss.frequency_Hz;
  return loss.tan_delta * std::sqrt(axial_N_per_m / mass_kg) / omega;
}

}  // namespace menger::voxel
