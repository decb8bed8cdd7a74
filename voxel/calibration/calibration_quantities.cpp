#include "voxel/calibration/calibration_quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace menger::voxel {
namespace {

/// The place of a quantity in parameters. For quantities common to all classes the class is ignored.
double& place_of(SurrogateParameters& p, Quantity quantity, std::size_t wall_class) {
  switch (quantity) {
    case Quantity::modulus:
    case Quantity::axial:
      return p.axial_Pa[wall_class];
    case Quantity::bending:
    case Quantity::bending_ratio:
      return p.bending_Pa[wall_class];
    case Quantity::torsion:
    case Quantity::torsion_ratio:
      return p.torsion_Pa[wall_class];
    case Quantity::shear_ratio:
      return p.shear_compliance_per_Pa[wall_class];
    case Quantity::extension_slope:
      return p.extension[wall_class].slope_per_Pa;
    case Quantity::extension_pressure_softening:
      return p.extension[wall_class].pressure_softening_per_Pa;
    case Quantity::extension_vacuum_softening:
      return p.extension[wall_class].vacuum_softening_per_Pa;
    case Quantity::bulge_slope:
      return p.bulge[wall_class].slope_per_Pa;
    case Quantity::bulge_pressure_softening:
      return p.bulge[wall_class].pressure_softening_per_Pa;
    case Quantity::bulge_vacuum_softening:
      return p.bulge[wall_class].vacuum_softening_per_Pa;
    case Quantity::bulge_fading_share:
      return p.bulge[wall_class].fading_share;
    case Quantity::bulge_fading:
      return p.bulge[wall_class].fading_per_Pa;
    case Quantity::bulge_peak_ratio:
      return p.bulge_peak_ratio[wall_class];
    case Quantity::ground_stiffness:
      return p.ground_stiffness_N_per_m;
    case Quantity::joint_axial:
      return p.joint.axial;
    case Quantity::joint_bending:
      return p.joint.bending;
    case Quantity::joint_torsion:
      return p.joint.torsion;
    case Quantity::bulge_neck_ratio:
      return p.neck_ratio;
    case Quantity::elbow_ratio:
      return p.elbow_ratio;
    case Quantity::plate_stretch_ratio:
      return p.plate_stretch_ratio;
    case Quantity::plate_draw_in:
      return p.plate_draw_in;
    case Quantity::plate_rise:
      return p.plate_rise;
    case Quantity::plate_draw_in_rate:
      return p.plate_draw_in_per_Pa;
    case Quantity::plate_edge_share:
      return p.plate_edge_share;
    case Quantity::plate_arm_ratio:
      return p.plate_arm_ratio;
    case Quantity::wide_volume_ratio:
      return p.wide_volume_ratio;
    case Quantity::lateral_coupling:
      break;
  }
  return p.lateral_coupling;
}

/// Factor from a fitted value to the stored one: the axial stiffness for ratios to it, its inverse for ratios of compliances.
double unit_of(const SurrogateParameters& p, Quantity quantity, std::size_t wall_class) {
  if (quantity == Quantity::bending_ratio || quantity == Quantity::torsion_ratio) return p.axial_Pa[wall_class];
  return quantity == Quantity::shear_ratio ? 1.0 / p.axial_Pa[wall_class] : 1.0;
}

}  // namespace

const io::Words<Quantity>& quantity_words() {
  static const io::Words<Quantity> words{{"modulus_Pa", Quantity::modulus},
                                         {"axial_Pa", Quantity::axial},
                                         {"bending_Pa", Quantity::bending},
                                         {"torsion_Pa", Quantity::torsion},
                                         {"bending_ratio", Quantity::bending_ratio},
                                         {"torsion_ratio", Quantity::torsion_ratio},
                                         {"shear_ratio", Quantity::shear_ratio},
                                         {"extension_slope_per_Pa", Quantity::extension_slope},
                                         {"extension_pressure_softening_per_Pa", Quantity::extension_pressure_softening},
                                         {"extension_vacuum_softening_per_Pa", Quantity::extension_vacuum_softening},
                                         {"bulge_slope_per_Pa", Quantity::bulge_slope},
                                         {"bulge_pressure_softening_per_Pa", Quantity::bulge_pressure_softening},
                                         {"bulge_vacuum_softening_per_Pa", Quantity::bulge_vacuum_softening},
                                         {"bulge_fading_share", Quantity::bulge_fading_share},
                                         {"bulge_fading_per_Pa", Quantity::bulge_fading},
                                         {"bulge_peak_ratio", Quantity::bulge_peak_ratio},
                                         {"ground_stiffness_N_per_m", Quantity::ground_stiffness},
                                         {"joint_axial", Quantity::joint_axial},
                                         {"joint_bending", Quantity::joint_bending},
                                         {"joint_torsion", Quantity::joint_torsion},
                                         {"lateral_coupling", Quantity::lateral_coupling},
                                         {"bulge_neck_ratio", Quantity::bulge_neck_ratio},
                                         {"elbow_ratio", Quantity::elbow_ratio},
                                         {"plate_stretch_ratio", Quantity::plate_stretch_ratio},
                                         {"plate_draw_in", Quantity::plate_draw_in},
                                         {"plate_rise", Quantity::plate_rise},
                                         {"plate_draw_in_per_Pa", Quantity::plate_draw_in_rate},
                                         {"plate_edge_share", Quantity::plate_edge_share},
                                         {"plate_arm_ratio", Quantity::plate_arm_ratio},
                                         {"wide_volume_ratio", Quantity::wide_volume_ratio}};
  return words;
}
std::string_view to_string(Quantity quantity) {
  const auto& words = quantity_words();
  return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == quantity; })->first;
}

bool is_positive(Quantity quantity) {
  switch (quantity) {
    case Quantity::modulus:
    case Quantity::axial:
    case Quantity::bending:
    case Quantity::torsion:
    case Quantity::bending_ratio:
    case Quantity::torsion_ratio:
    case Quantity::shear_ratio:
    case Quantity::bulge_slope:
    case Quantity::bulge_fading:
    case Quantity::bulge_peak_ratio:
    case Quantity::bulge_neck_ratio:
    case Quantity::ground_stiffness:
    case Quantity::joint_axial:
    case Quantity::joint_bending:
    case Quantity::joint_torsion:
    case Quantity::plate_stretch_ratio:
    case Quantity::plate_draw_in_rate:
    case Quantity::plate_arm_ratio:
    case Quantity::wide_volume_ratio:
      return true;
    default:
      return false;
  }
}

io::Range allowed_range(Quantity quantity) {
  if (quantity == Quantity::bulge_peak_ratio) return io::at_least(1.0);
  if (quantity == Quantity::bulge_fading_share || quantity == Quantity::plate_edge_share) return io::within(0.0, 1.0);
  if (quantity == Quantity::elbow_ratio || quantity == Quantity::plate_rise) return io::non_negative();
  if (quantity == Quantity::lateral_coupling || quantity == Quantity::plate_draw_in)
    return {.lowest = 0.0, .highest = 1.0, .highest_excluded = true};
  return is_positive(quantity) ? io::positive() : io::any_number();
}

double FittedParameter::unknown_of(double value) const { return logarithmic ? std::log(value) : value / scale; }
double FittedParameter::value_of(double unknown) const { return logarithmic ? std::exp(unknown) : scale * unknown; }

void set_value(SurrogateParameters& parameters, const FittedParameter& parameter, double value) {
  if (parameter.classes.empty()) {
    place_of(parameters, parameter.quantity, 0) = value;
    return;
  }
  for (std::size_t n = 0; n < parameter.classes.size(); ++n) {
    const std::size_t c = parameter.classes[n];
    const double own = value * (parameter.proportions.empty() ? 1.0 : parameter.proportions[n]);
    place_of(parameters, parameter.quantity, c) = own * unit_of(parameters, parameter.quantity, c);
    if (parameter.quantity == Quantity::modulus) parameters.bending_Pa[c] = parameters.torsion_Pa[c] = own;
  }
}

double value_in(const SurrogateParameters& parameters, Quantity quantity, std::size_t wall_class) {
  SurrogateParameters copy = parameters;
  return place_of(copy, quantity, wall_class) / unit_of(parameters, quantity, wall_class);
}

double value_in(const SurrogateParameters& parameters, const FittedParameter& parameter) {
  return value_in(parameters, parameter.quantity, parameter.classes.empty() ? 0 : parameter.classes.front());
}

CalibrationBounds default_bounds(const SurrogateParameters& rough, double lowest_pressure_Pa, double highest_pressure_Pa) {
  constexpr double stiffness_factor = 1e3;
  constexpr double ratio_factor = 100.0;
  constexpr double slope_factor = 10.0;
  constexpr double bulge_factor = 1e3;
  constexpr double fading_factor = 100.0;
  constexpr double largest_softening = 0.95;  // times the pressure, so that the pole stays outside
  constexpr double largest_stiffening = 5.0;
  constexpr double joint_factor = 20.0;
  constexpr double largest_peak_ratio = 10.0;
  constexpr double largest_coupling = 0.95;
  constexpr double face_factor = 10.0;
  constexpr double largest_elbow_ratio = 20.0;
  constexpr double largest_draw_in = 0.5;
  constexpr double largest_rise = 0.5;
  const auto about = [](double value, double factor) { return ValueRange{value / factor, value * factor}; };
  const auto up_to = [](double value) { return ValueRange{-std::abs(value), std::abs(value)}; };
  // Without pressures of one sign its softening has no influence, but it still needs a bound.
  const double pressure_Pa = highest_pressure_Pa > 0.0 ? highest_pressure_Pa : std::max(-lowest_pressure_Pa, 1.0);
  const double vacuum_Pa = lowest_pressure_Pa < 0.0 ? -lowest_pressure_Pa : pressure_Pa;
  const ValueRange pressure_softening{-largest_stiffening / pressure_Pa, largest_softening / pressure_Pa};
  const ValueRange vacuum_softening{-largest_stiffening / vacuum_Pa, largest_softening / vacuum_Pa};
  const ValueRange stiffness = about(rough.axial_Pa[closed_wall_class], stiffness_factor);
  double steepest = 0.0;
  double least_bulge = std::numeric_limits<double>::max();
  double largest_bulge = 0.0;
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    steepest = std::max(steepest, std::abs(rough.extension[c].slope_per_Pa));
    least_bulge = std::min(least_bulge, std::abs(rough.bulge[c].slope_per_Pa));
    largest_bulge = std::max(largest_bulge, std::abs(rough.bulge[c].slope_per_Pa));
  }
  return {{Quantity::modulus, stiffness},
          {Quantity::axial, stiffness},
          {Quantity::bending, stiffness},
          {Quantity::torsion, stiffness},
          {Quantity::bending_ratio, about(1.0, ratio_factor)},
          {Quantity::torsion_ratio, about(1.0, ratio_factor)},
          {Quantity::shear_ratio, about(1.0, ratio_factor)},
          {Quantity::extension_slope, up_to(slope_factor * steepest)},
          {Quantity::extension_pressure_softening, pressure_softening},
          {Quantity::extension_vacuum_softening, vacuum_softening},
          {Quantity::bulge_slope, {least_bulge / bulge_factor, largest_bulge * bulge_factor}},
          {Quantity::bulge_pressure_softening, pressure_softening},
          {Quantity::bulge_vacuum_softening, vacuum_softening},
          {Quantity::bulge_fading_share, {0.0, 1.0}},
          {Quantity::bulge_fading, about(1.0 / pressure_Pa, fading_factor)},
          {Quantity::bulge_peak_ratio, {1.0, largest_peak_ratio}},
          {Quantity::ground_stiffness, about(rough.ground_stiffness_N_per_m, stiffness_factor)},
          {Quantity::joint_axial, about(1.0, joint_factor)},
          {Quantity::joint_bending, about(1.0, joint_factor)},
          {Quantity::joint_torsion, about(1.0, joint_factor)},
          {Quantity::lateral_coupling, {0.0, largest_coupling}},
          {Quantity::bulge_neck_ratio, about(1.0, face_factor)},
          {Quantity::elbow_ratio, {0.0, largest_elbow_ratio}},
          {Quantity::plate_stretch_ratio, about(1.0, ratio_factor)},
          {Quantity::plate_draw_in, {0.0, largest_draw_in}},
          {Quantity::plate_rise, {0.0, largest_rise}},
          {Quantity::plate_draw_in_rate, about(1.0 / pressure_Pa, fading_factor)},
          {Quantity::plate_edge_share, {0.0, 1.0}},
          {Quantity::plate_arm_ratio, about(1.0, face_factor)},
          {Quantity::wide_volume_ratio, about(1.0, face_factor)}};
}

}  // namespace menger::voxel
