#include "voxel/calibration_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace menger::voxel {
namespace {

template <class Value>
std::string_view word_of(const io::Words<Value>& words, Value value) {
  return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == value; })->first;
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
    case Quantity::ground_stiffness:
    case Quantity::joint_axial:
    case Quantity::joint_bending:
    case Quantity::joint_torsion:
      return true;
    default:
      return false;
  }
}

using Classes = std::vector<std::size_t>;
const Classes all_classes{0, 1, 2, 3, 4, 5, 6};
const Classes closed_first{6, 0, 1, 2, 3, 4, 5};  // of what is one for all, the closed cell's is known best

/// The determined class that stands in for one: that of the nearest number of walls, the first of equally near ones.
std::size_t nearest(const Classes& determined, std::size_t wall_class) {
  constexpr ByWallClass<int> wall_count{0, 1, 2, 2, 2, 3, 4};
  const auto distance = [&](std::size_t other) {
    return other == wall_class ? -1 : std::abs(wall_count.at(other) - wall_count.at(wall_class));
  };
  return *std::min_element(determined.begin(), determined.end(),
                           [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
}

/// A determined class first, then those it stands in for.
Classes shared_by(const Classes& determined, std::size_t owner) {
  Classes classes{owner};
  for (const std::size_t other : all_classes) {
    if (other != owner && nearest(determined, other) == owner) classes.push_back(other);
  }
  return classes;
}

/// "axial_Pa" becomes "axial_2a_Pa".
std::string class_name(std::string_view name, std::size_t wall_class) {
  const std::array<std::string_view, 2> units{"_per_Pa", "_Pa"};
  const std::string number = "_" + std::string(wall_class_names.at(wall_class));
  for (const std::string_view unit : units) {
    if (name.ends_with(unit)) return std::string(name.substr(0, name.size() - unit.size())) + number + std::string(unit);
  }
  return std::string(name) + number;
}

/// Collects the unknowns of details.
class ParameterList {
 public:
  ParameterList(const CalibrationBounds& bounds, const SurrogateParameters& rough) : bounds_(bounds), rough_(rough) {}

  void add(Quantity quantity) { add(quantity, {}, std::string(to_string(quantity))); }
  void add_for_all(Quantity quantity) { add(quantity, closed_first, std::string(to_string(quantity))); }
  void add_by_class(Quantity quantity, const Classes& determined) {
    for (const std::size_t owner : determined)
      add(quantity, shared_by(determined, owner), class_name(to_string(quantity), owner));
  }
  void add_law(Quantity quantity, bool by_class, const Classes& determined) {
    if (by_class) {
      add_by_class(quantity, determined);
    } else {
      add_for_all(quantity);
    }
  }
  /// One value for all classes in their rough proportions.
  void add_in_proportion(Quantity quantity);

  [[nodiscard]] std::vector<FittedParameter> take() { return std::move(parameters_); }

 private:
  void add(Quantity quantity, Classes classes, std::string name) {
    const ValueRange range = bounds_.at(quantity);
    const double largest = std::max(std::abs(range.lowest), std::abs(range.highest));
    const bool logarithmic = is_positive(quantity);
    parameters_.push_back(
        {quantity, std::move(classes), {}, std::move(name), range, logarithmic, logarithmic ? 1.0 : 0.1 * largest});
  }

  const CalibrationBounds& bounds_;
  const SurrogateParameters& rough_;
  std::vector<FittedParameter> parameters_;
};

/// Where the value of a quantity lies in a set of parameters; the first class for those that all share.
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
    case Quantity::lateral_coupling:
      break;
  }
  return p.lateral_coupling;
}

/// What turns a value into that of its place: the axial stiffness for ratios to it, and its inverse for those of compliances.
double unit_of(const SurrogateParameters& p, Quantity quantity, std::size_t wall_class) {
  if (quantity == Quantity::bending_ratio || quantity == Quantity::torsion_ratio) return p.axial_Pa[wall_class];
  return quantity == Quantity::shear_ratio ? 1.0 / p.axial_Pa[wall_class] : 1.0;
}

void ParameterList::add_in_proportion(Quantity quantity) {
  add_for_all(quantity);
  SurrogateParameters rough = rough_;
  const double closed = place_of(rough, quantity, closed_wall_class);
  for (const std::size_t c : closed_first) parameters_.back().proportions.push_back(place_of(rough, quantity, c) / closed);
}

}  // namespace

const io::Words<CalibrationDetail>& detail_words() {
  static const io::Words<CalibrationDetail> words{{"uniform", CalibrationDetail::uniform},
                                                  {"stiffness", CalibrationDetail::stiffness},
                                                  {"sections", CalibrationDetail::sections},
                                                  {"bulge_classes", CalibrationDetail::bulge_classes},
                                                  {"extension_classes", CalibrationDetail::extension_classes},
                                                  {"stiffness_classes", CalibrationDetail::stiffness_classes},
                                                  {"shear", CalibrationDetail::shear},
                                                  {"softening", CalibrationDetail::softening},
                                                  {"fading", CalibrationDetail::fading},
                                                  {"joints", CalibrationDetail::joints},
                                                  {"lateral", CalibrationDetail::lateral}};
  return words;
}
std::string_view to_string(CalibrationDetail detail) { return word_of(detail_words(), detail); }

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
                                         {"lateral_coupling", Quantity::lateral_coupling}};
  return words;
}
std::string_view to_string(Quantity quantity) { return word_of(quantity_words(), quantity); }

io::Range allowed_range(Quantity quantity) {
  if (quantity == Quantity::bulge_peak_ratio) return io::at_least(1.0);
  if (quantity == Quantity::bulge_fading_share) return io::within(0.0, 1.0);
  if (quantity == Quantity::lateral_coupling) return {.lowest = 0.0, .highest = 1.0, .highest_excluded = true};
  return is_positive(quantity) ? io::positive() : io::any_number();
}

double FittedParameter::unknown_of(double value) const { return logarithmic ? std::log(value) : value / scale; }
double FittedParameter::value_of(double unknown) const { return logarithmic ? std::exp(unknown) : scale * unknown; }

std::vector<FittedParameter> fitted_parameters(const DetailSet& details, const DeterminedClasses& classes,
                                               const CalibrationBounds& bounds, const SurrogateParameters& rough) {
  const auto has = [&](CalibrationDetail detail) { return details.contains(detail); };
  ParameterList list(bounds, rough);
  if (has(CalibrationDetail::stiffness_classes)) {
    list.add_by_class(Quantity::axial, classes.stiffness);
    list.add_for_all(Quantity::bending_ratio);
    list.add_for_all(Quantity::torsion_ratio);
  } else {
    const std::vector<Quantity> moduli = has(CalibrationDetail::stiffness)
                                             ? std::vector{Quantity::axial, Quantity::bending, Quantity::torsion}
                                             : std::vector{Quantity::modulus};
    for (const Quantity quantity : moduli) {
      if (has(CalibrationDetail::sections)) {
        list.add_in_proportion(quantity);
      } else {
        list.add_for_all(quantity);
      }
    }
  }
  if (has(CalibrationDetail::shear)) list.add_for_all(Quantity::shear_ratio);
  if (has(CalibrationDetail::sections) && !has(CalibrationDetail::extension_classes)) {
    list.add_in_proportion(Quantity::extension_slope);
  } else {
    list.add_law(Quantity::extension_slope, has(CalibrationDetail::extension_classes), classes.extension);
  }
  list.add_law(Quantity::extension_pressure_softening, has(CalibrationDetail::softening), classes.extension);
  list.add_law(Quantity::extension_vacuum_softening, has(CalibrationDetail::softening), classes.extension);
  list.add_law(Quantity::bulge_slope, has(CalibrationDetail::bulge_classes), classes.bulge);
  list.add_law(Quantity::bulge_pressure_softening, has(CalibrationDetail::softening), classes.bulge);
  list.add_law(Quantity::bulge_vacuum_softening, has(CalibrationDetail::softening), classes.bulge);
  list.add_law(Quantity::bulge_peak_ratio, has(CalibrationDetail::bulge_classes), classes.bulge);
  if (has(CalibrationDetail::fading)) {
    list.add_law(Quantity::bulge_fading_share, has(CalibrationDetail::bulge_classes), classes.bulge);
    list.add_law(Quantity::bulge_fading, has(CalibrationDetail::bulge_classes), classes.bulge);
  }
  list.add(Quantity::ground_stiffness);
  if (has(CalibrationDetail::joints)) {
    list.add(Quantity::joint_axial);
    list.add(Quantity::joint_bending);
    list.add(Quantity::joint_torsion);
  }
  if (has(CalibrationDetail::lateral)) list.add(Quantity::lateral_coupling);
  return list.take();
}

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

double value_in(const SurrogateParameters& parameters, const FittedParameter& parameter) {
  const std::size_t c = parameter.classes.empty() ? 0 : parameter.classes.front();
  SurrogateParameters copy = parameters;
  const double value = place_of(copy, parameter.quantity, c);
  return value / unit_of(parameters, parameter.quantity, c);
}

SurrogateParameters with_detail(const SurrogateParameters& fitted, CalibrationDetail detail, const SurrogateParameters& rough,
                                double highest_pressure_Pa) {
  constexpr double tube_shear_ratio = 5.0;  // a third of E, and the walls along the force, which are half of the section
  constexpr double rough_coupling = 0.2;
  SurrogateParameters p = fitted;
  switch (detail) {
    case CalibrationDetail::bulge_classes:
      for (std::size_t c = 0; c < wall_class_count; ++c) {
        p.bulge[c].slope_per_Pa = fitted.bulge[closed_wall_class].slope_per_Pa * rough.bulge[c].slope_per_Pa /
                                  rough.bulge[closed_wall_class].slope_per_Pa;
      }
      break;
    case CalibrationDetail::softening:
      for (std::size_t c = 0; c < wall_class_count; ++c) {
        for (PressureLaw* law : {&p.extension[c], &p.bulge[c]})
          law->pressure_softening_per_Pa = law->vacuum_softening_per_Pa = 0.0;
      }
      break;
    case CalibrationDetail::fading:
      for (PressureLaw& law : p.bulge) {
        law.fading_share = 0.5;
        law.fading_per_Pa = 3.0 / std::max(highest_pressure_Pa, 1.0);
      }
      break;
    case CalibrationDetail::shear:
      for (std::size_t c = 0; c < wall_class_count; ++c) p.shear_compliance_per_Pa[c] = tube_shear_ratio / p.axial_Pa[c];
      break;
    case CalibrationDetail::lateral:
      p.lateral_coupling = rough_coupling;
      break;
    default:
      break;
  }
  return p;
}

CalibrationBounds default_bounds(const SurrogateParameters& rough, double lowest_pressure_Pa, double highest_pressure_Pa) {
  constexpr double stiffness_factor = 1e3;
  constexpr double ratio_factor = 100.0;
  constexpr double slope_factor = 10.0;
  constexpr double bulge_factor = 1e3;
  constexpr double fading_factor = 100.0;
  constexpr double largest_softening = 0.95;  // by the pressure: the pole stays outside
  constexpr double largest_stiffening = 5.0;
  constexpr double joint_factor = 20.0;
  constexpr double largest_peak_ratio = 10.0;
  constexpr double largest_coupling = 0.95;
  const auto about = [](double value, double factor) { return ValueRange{value / factor, value * factor}; };
  const auto up_to = [](double value) { return ValueRange{-std::abs(value), std::abs(value)}; };
  // Without pressures of a sign its softening has no influence, but a bound it needs.
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
          {Quantity::lateral_coupling, {0.0, largest_coupling}}};
}

}  // namespace menger::voxel
