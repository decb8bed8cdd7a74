#include "voxel/scale_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/number_text.h"
#include "voxel/voxel_classes.h"

namespace menger::voxel {

namespace {

constexpr double largest_step_count = 1e15;  ///< beyond this t = k h loses its last digits

/// Whether a number and its square are normal numbers of the type, so that the sweeps can compute with it.
bool is_usable(double value, NumberType number) {
  if (number == NumberType::float32)
    return std::isnormal(static_cast<float>(value)) && std::isnormal(static_cast<float>(value * value));
  return std::isnormal(value) && std::isnormal(value * value);
}

}  // namespace

std::string unusable_scales(const Physics& physics, double cell_edge_m, double duration_s) {
  const NumberType number = physics.integration.number;
  const ClassTables tables = class_tables(physics, cell_edge_m);
  const std::string scale =
      " at cell_edge_m = " + io::number_text(cell_edge_m) + " is beyond the range of " + std::string(to_string(number));
  double stiffest = 0.0;
  for (const BeamCoefficients<double>& beam : tables.beam) stiffest = std::max(stiffest, beam.shear);
  double lightest = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < physics.materials.size(); ++m) {
    const VoxelMaterial& material = physics.materials[m];
    if (!is_usable(tables.mass_kg[m], number) || !is_usable(tables.inertia_kg_m2[m], NumberType::float64) ||
        !std::isnormal(static_cast<float>(tables.inertia_kg_m2[m]))) {
      return "the mass of a voxel with density_kg_m3 = " + io::number_text(material.density_kg_m3) + scale;
    }
    lightest = std::min(lightest, tables.mass_kg[m]);
  }
  for (const BeamCoefficients<double>& beam : tables.beam) {
    if (is_usable(beam.shear, number) && is_usable(beam.turn, NumberType::float64)) continue;
    return "the stiffness of a beam between voxels with youngs_modulus_Pa = " +
           io::number_text(physics.materials[0].youngs_modulus_Pa) + " and " +
           io::number_text(physics.materials[1].youngs_modulus_Pa) + scale;
  }
  const double smallest_step_s =
      physics.integration.time_step_fraction / (2.0 * std::numbers::pi * std::sqrt(stiffest / lightest));
  if (!is_usable(smallest_step_s, number) || !is_usable(physics.integration.time_step_fraction, number)) {
    return "time_step_fraction = " + io::number_text(physics.integration.time_step_fraction) + " gives a step of " +
           io::number_text(smallest_step_s) + " s, beyond the range of " + std::string(to_string(number));
  }
  const double speed_m_s =
      physics.limits.speed_fraction * std::sqrt(physics.materials[0].youngs_modulus_Pa / physics.materials[0].density_kg_m3);
  if (!is_usable(speed_m_s * smallest_step_s, number)) {
    return "speed_fraction = " + io::number_text(physics.limits.speed_fraction) + " gives a limit beyond the range of " +
           std::string(to_string(number));
  }
  if (!(duration_s / smallest_step_s <= largest_step_count)) {
    return "duration_s = " + io::number_text(duration_s) + " needs " + io::number_text(duration_s / smallest_step_s) +
           " steps of " + io::number_text(smallest_step_s) + " s: more than can be counted";
  }
  return "";
}

}  // namespace menger::voxel
