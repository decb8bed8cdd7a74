#include "voxel/engine/scale_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

#include "io/text/number_text.h"
#include "voxel/engine/time_step.h"
#include "voxel/engine/voxel_classes.h"
#include "voxel/model/surrogate_beams.h"

namespace menger::voxel {

namespace {

constexpr double largest_step_count = 1e15;  ///< beyond this t = k h loses its last digits
constexpr double largest_growth = 100.0;     ///< of a wall or beam, in edges

/// Whether a number and its square are normal numbers of the type, so that the sweeps can compute with it.
bool is_usable(double value, NumberType number) {
  if (number == NumberType::float32)
    return std::isnormal(static_cast<float>(value)) && std::isnormal(static_cast<float>(value * value));
  return std::isnormal(value) && std::isnormal(value * value);
}

std::string uncountable_steps(double duration_s, double step_s) {
  if (duration_s / step_s <= largest_step_count) return "";
  return "duration_s = " + io::number_text(duration_s) + " needs " + io::number_text(duration_s / step_s) + " steps of " +
         io::number_text(step_s) + " s: too many steps to count";
}

std::string unusable_solid_scales(const Physics& physics, double cell_edge_m, double duration_s) {
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
  const double slower = slower_by_damping(physics, physics.materials[0], physics.materials[1]);
  const double smallest_step_s =
      physics.integration.time_step_fraction / (2.0 * std::numbers::pi * std::sqrt(stiffest / lightest)) / slower;
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
  return uncountable_steps(duration_s, smallest_step_s);
}

/// Returns the mass of the wall of a voxel that has a wall on one side. Such a voxel is among the lightest of a body.
double light_wall_kg(const SurrogateParameters& parameters) {
  return parameters.density_kg_m3 * parameters.wall_thickness_m * parameters.voxel_edge_m() * parameters.voxel_edge_m();
}

/// Returns the text for a parameter whose effect is beyond the range of the number type: its key, its value and the effect.
std::string beyond_range(std::string_view key, double value, std::string_view what, NumberType number) {
  return "parameters." + std::string(key) + " = " + io::number_text(value) + ": " + std::string(what) +
         " is beyond the range of " + std::string(to_string(number));
}

/// What limits the step of a calibrated body: a stiffness divided by a mass or a moment of inertia, and the parameter that it
/// comes from.
struct Stiffest {
  double rate = 0.0;  ///< 1/s^2
  std::string_view key;
  double value = 0.0;

  void consider(double other_rate, std::string_view other_key, double other_value) {
    if (other_rate > rate) *this = {other_rate, other_key, other_value};
  }
};

Stiffest stiffest_of(const Physics& physics, double mass_kg, double inertia_kg_m2) {
  const SurrogateParameters& parameters = physics.surrogate->parameters;
  Stiffest stiffest;
  const double ground = parameters.ground_stiffness_N_per_m;
  stiffest.consider(0.5 * ground / mass_kg, "ground.stiffness_N_per_m", ground);
  if (physics.floor) {
    const double damping = 2.0 * physics.damping_ratios.collision * std::sqrt(0.5 * mass_kg * ground);
    const double step_s =
        0.5 * largest_standing_step_s({ground, damping, 0.0, 0.0}, mass_kg, inertia_kg_m2, parameters.voxel_edge_m());
    stiffest.consider(std::pow(2.0 * std::numbers::pi * step_s, -2.0), "ground.stiffness_N_per_m", ground);
  }
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    for (const bool crosses_joint : {false, true}) {
      const BeamCoefficients<double> beam =
          beam_coefficients(beam_section(parameters, c, c, crosses_joint), parameters.voxel_edge_m());
      const double stretch = (1.0 + 2.0 * parameters.lateral_coupling) * beam.axial_root * beam.axial_root;
      stiffest.consider(stretch / mass_kg, "stiffness.axial_Pa", parameters.axial_Pa[c]);
      stiffest.consider(beam.shear / mass_kg, "stiffness.bending_Pa", parameters.bending_Pa[c]);
      stiffest.consider((beam.turn + beam.turn_difference) / inertia_kg_m2, "stiffness.bending_Pa", parameters.bending_Pa[c]);
      stiffest.consider(beam.twist / inertia_kg_m2, "stiffness.torsion_Pa", parameters.torsion_Pa[c]);
    }
  }
  return stiffest;
}

std::string unusable_beams(const SurrogateParameters& parameters, std::size_t c, NumberType number) {
  const auto wrong = [&](double value) { return !is_usable(value, number); };
  for (const bool crosses_joint : {false, true}) {
    const BeamCoefficients<double> beam =
        beam_coefficients(beam_section(parameters, c, c, crosses_joint), parameters.voxel_edge_m());
    if (wrong(beam.axial))
      return beyond_range("stiffness.axial_Pa", parameters.axial_Pa[c], "the force of a stretched beam", number);
    if (wrong(beam.shear) || wrong(beam.bend) || !is_usable(beam.turn, NumberType::float64))
      return beyond_range("stiffness.bending_Pa", parameters.bending_Pa[c], "the stiffness of a bent beam", number);
    if (!is_usable(beam.twist, NumberType::float64))
      return beyond_range("stiffness.torsion_Pa", parameters.torsion_Pa[c], "the stiffness of a twisted beam", number);
    if (beam.turn_difference != 0.0 && !is_usable(beam.turn_difference, NumberType::float64)) {
      return beyond_range("stiffness.shear_compliance_per_Pa", parameters.shear_compliance_per_Pa[c],
                          "the stiffness of a sheared beam", number);
    }
  }
  return "";
}

/// Returns why a law is absurd at a pressure, or an empty text.
/// @param growth in edges
std::string absurd_growth(std::string_view key, double value, double growth, double pressure_Pa) {
  if (std::abs(growth) <= largest_growth) return "";
  return "parameters." + std::string(key) + " = " + io::number_text(value) +
         ": at pressure_Pa = " + io::number_text(pressure_Pa) + " a length changes by " + io::number_text(growth) +
         " edges, but at most this is allowed: " + io::number_text(largest_growth);
}

/// Returns why elbows turn by too much at a pressure, or an empty text. @param strain of a beam by pressure
std::string absurd_turn(double elbow_ratio, double strain, double pressure_Pa) {
  const double turn_rad = elbow_ratio * strain;
  if (std::abs(turn_rad) <= std::numbers::pi) return "";
  return "parameters.extension.elbow_ratio = " + io::number_text(elbow_ratio) +
         ": at pressure_Pa = " + io::number_text(pressure_Pa) + " an elbow turns by " + io::number_text(turn_rad) +
         " rad, more than half a circle";
}

/// Returns why the growth at the pressures of the drive is unusable, or an empty text. Whether a law has a value there is checked
/// with the body, which need not have its class.
std::string unusable_growth(const CalibratedBody& body) {
  const SurrogateParameters& parameters = body.parameters;
  for (const double pressure : body.pressure_Pa) {
    for (std::size_t c = 0; c < wall_class_count; ++c) {
      const PressureLaw& extension = parameters.extension[c];
      const PressureLaw& bulge = parameters.bulge[c];
      std::string problem;
      if (extension.has_value(pressure)) {
        const double strain = extension.value(pressure);
        problem = absurd_growth("extension.slope_per_Pa", extension.slope_per_Pa, strain, pressure);
        if (problem.empty()) problem = absurd_turn(parameters.elbow_ratio, strain, pressure);
      }
      if (problem.empty() && bulge.has_value(pressure)) {
        const double mean = bulge.value(pressure);
        const double ratio = parameters.bulge_peak_ratio[c];
        problem = absurd_growth("bulge.slope_per_Pa", bulge.slope_per_Pa, mean, pressure);
        if (problem.empty()) problem = absurd_growth("bulge.peak_ratio", ratio, ratio * mean, pressure);
        const double neck = parameters.neck_ratio;
        if (problem.empty()) problem = absurd_growth("bulge.neck_ratio", neck, neck * ratio * mean, pressure);
      }
      if (!problem.empty()) return problem;
    }
    const PressureLaw inside = parameters.extension_of(inside_plate);
    if (!inside.has_value(pressure)) continue;
    std::string problem =
        absurd_growth("extension.plate_stretch_ratio", parameters.plate_stretch_ratio, inside.value(pressure), pressure);
    if (!problem.empty()) return problem;
  }
  return "";
}

/// Checks the scales of a calibrated body, see unusable_scales. The check is to the order of magnitude, because masses depend on
/// the body.
std::string unusable_calibrated_scales(const Physics& physics, double duration_s) {
  const NumberType number = physics.integration.number;
  const SurrogateParameters& parameters = physics.surrogate->parameters;
  const double edge = parameters.voxel_edge_m();
  const double mass = light_wall_kg(parameters);
  const double inertia = mass * edge * edge / 6.0;
  if (!is_usable(mass, number) || !is_usable(inertia, NumberType::float64) || !std::isnormal(static_cast<float>(inertia)))
    return beyond_range("mass.density_kg_m3", parameters.density_kg_m3, "the mass of a voxel", number);
  if (!is_usable(parameters.ground_stiffness_N_per_m, number))
    return beyond_range("ground.stiffness_N_per_m", parameters.ground_stiffness_N_per_m, "the force of the ground", number);
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (std::string problem = unusable_beams(parameters, c, number); !problem.empty()) return problem;
  }
  if (std::string problem = unusable_growth(*physics.surrogate); !problem.empty()) return problem;
  Stiffest limit = stiffest_of(physics, mass, inertia);
  const double undamped_step_s = physics.integration.time_step_fraction / (2.0 * std::numbers::pi * std::sqrt(limit.rate));
  const double slower = std::max(1.0, 0.5 * parameters.bond_damping_ratio);  // see recommended_time_step_s
  const double step_s = undamped_step_s / slower;
  // Damping is named as the reason only where the stiffness alone would leave a usable step.
  if (slower > 1.0 && is_usable(undamped_step_s, number) && uncountable_steps(duration_s, undamped_step_s).empty())
    limit = {limit.rate, "damping.bond_ratio", parameters.bond_damping_ratio};
  const std::string demand = "parameters." + std::string(limit.key) + " = " + io::number_text(limit.value) + ": ";
  if (!is_usable(step_s, number)) {
    return demand + "time_step_fraction = " + io::number_text(physics.integration.time_step_fraction) + " gives a step of " +
           io::number_text(step_s) + " s, beyond the range of " + std::string(to_string(number));
  }
  const double speed_m_s = physics.limits.speed_fraction * edge * std::sqrt(limit.rate);
  if (!is_usable(speed_m_s * step_s, number)) {
    return "speed_fraction = " + io::number_text(physics.limits.speed_fraction) + " gives a limit beyond the range of " +
           std::string(to_string(number));
  }
  const std::string problem = uncountable_steps(duration_s, step_s);
  return problem.empty() ? problem : demand + problem;
}

}  // namespace

std::string unusable_scales(const Physics& physics, double cell_edge_m, double duration_s) {
  if (!physics.surrogate) return unusable_solid_scales(physics, cell_edge_m, duration_s);
  return unusable_calibrated_scales(physics, duration_s);
}

}  // namespace menger::voxel
