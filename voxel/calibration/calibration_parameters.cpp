#include "voxel/calibration/calibration_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace menger::voxel {
namespace {

using Classes = std::vector<std::size_t>;
const Classes every_class{0, 1, 2, 3, 4, 5, 6};
const Classes closed_first{6, 0, 1, 2, 3, 4, 5};  // for a value common to all, the closed cell is the best known

/// The determined class that represents a class: the one with the nearest number of walls, the first of equally near ones.
std::size_t nearest(const Classes& determined, std::size_t wall_class) {
  constexpr ByWallClass<int> wall_count{0, 1, 2, 2, 2, 3, 4};
  const auto distance = [&](std::size_t other) {
    return other == wall_class ? -1 : std::abs(wall_count.at(other) - wall_count.at(wall_class));
  };
  return *std::min_element(determined.begin(), determined.end(),
                           [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
}

/// A determined class, followed by those that it represents.
Classes shared_by(const Classes& determined, std::size_t owner) {
  Classes classes{owner};
  for (const std::size_t other : every_class) {
    if (other != owner && nearest(determined, other) == owner) classes.push_back(other);
  }
  return classes;
}

/// Inserts the class into a name: "axial_Pa" becomes "axial_2a_Pa".
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

void ParameterList::add_in_proportion(Quantity quantity) {
  add_for_all(quantity);
  const double closed = value_in(rough_, quantity, closed_wall_class);
  for (const std::size_t c : closed_first) parameters_.back().proportions.push_back(value_in(rough_, quantity, c) / closed);
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
                                                  {"lateral", CalibrationDetail::lateral},
                                                  {"elbows", CalibrationDetail::elbows},
                                                  {"plates", CalibrationDetail::plates},
                                                  {"necks", CalibrationDetail::necks}};
  return words;
}
std::string_view to_string(CalibrationDetail detail) {
  const auto& words = detail_words();
  return std::find_if(words.begin(), words.end(), [&](const auto& word) { return word.second == detail; })->first;
}

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
  if (has(CalibrationDetail::elbows)) list.add(Quantity::elbow_ratio);
  if (has(CalibrationDetail::plates)) {
    list.add(Quantity::plate_stretch_ratio);
    list.add(Quantity::plate_draw_in);
    list.add(Quantity::plate_rise);
    list.add(Quantity::plate_draw_in_rate);
    list.add(Quantity::plate_edge_share);
    list.add(Quantity::plate_arm_ratio);
    list.add(Quantity::wide_volume_ratio);
  }
  if (has(CalibrationDetail::necks)) list.add(Quantity::bulge_neck_ratio);
  return list.take();
}

SurrogateParameters with_detail(const SurrogateParameters& fitted, CalibrationDetail detail, const SurrogateParameters& rough,
                                double highest_pressure_Pa) {
  constexpr double tube_shear_ratio = 5.0;  // G is a third of E, and the walls along the force are half of the section
  constexpr double rough_coupling = 0.2;
  constexpr double rough_elbow_ratio = 2.5;  // of silicone chambers whose walls are a fifth of a cell
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
    case CalibrationDetail::elbows:
      p.elbow_ratio = rough_elbow_ratio;
      break;
    case CalibrationDetail::plates:  // of silicone chambers whose walls are a fifth of a cell
      p.plate_stretch_ratio = 2.0;
      p.plate_draw_in = 0.1;
      p.plate_rise = 0.03;
      p.plate_draw_in_per_Pa = 10.0 / std::max(highest_pressure_Pa, 1.0);
      p.plate_edge_share = 0.3;
      p.plate_arm_ratio = 1.2;
      p.wide_volume_ratio = 1.1;
      break;
    default:
      break;
  }
  return p;
}

std::vector<SurrogateParameters> starts_with_detail(const SurrogateParameters& fitted, CalibrationDetail detail,
                                                    const SurrogateParameters& rough, double highest_pressure_Pa) {
  std::vector<SurrogateParameters> starts{with_detail(fitted, detail, rough, highest_pressure_Pa)};
  if (detail != CalibrationDetail::fading) return starts;
  for (const double faster : {10.0 / 3.0, 10.0}) {
    starts.push_back(starts.front());
    for (PressureLaw& law : starts.back().bulge) law.fading_per_Pa *= faster;
  }
  return starts;
}

}  // namespace menger::voxel
