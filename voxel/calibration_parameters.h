#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/toml_document.h"
#include "voxel/surrogate_parameters.h"

namespace menger::voxel {

/// What is fitted. Each detail adds freedom to those that it is joined with, and its absence is a special case of its presence,
/// but for sections, which has no freedom of its own.
enum class CalibrationDetail {
  uniform,        ///< always there: one modulus for all stiffnesses, one law of extension, one of bulge, contact with the ground
  stiffness,      ///< axial, bending and torsional stiffness apart
  sections,       ///< stiffnesses and extension in the proportions that the sections of the wall have in the wall classes
  shear,          ///< shear compliance, in one ratio to axial compliance
  bulge_classes,  ///< slope and peak of the bulge by wall class
  extension_classes,  ///< slope of the extension by wall class
  stiffness_classes,  ///< axial stiffness by wall class; bending, torsion and shear in one ratio to axial
  fading,     ///< flat walls that bend first and then stretch: fading share of the bulge and where it fades, by wall class
  softening,  ///< softening of extension and bulge by wall class
  joints,     ///< factors of bonded joints
  lateral     ///< lateral coupling
};
using DetailSet = std::set<CalibrationDetail>;
const io::Words<CalibrationDetail>& detail_words();
std::string_view to_string(CalibrationDetail detail);

/// What a fitted number stands for. Ratios are to the axial stiffness (shear_ratio: compliance) of the same class.
enum class Quantity {
  modulus,  ///< of all three stiffnesses
  axial,
  bending,
  torsion,
  bending_ratio,
  torsion_ratio,
  shear_ratio,  ///< of the shear compliance 1 / (G A_s) to the axial compliance 1 / (E A)
  extension_slope,
  extension_pressure_softening,
  extension_vacuum_softening,
  bulge_slope,
  bulge_pressure_softening,
  bulge_vacuum_softening,
  bulge_fading_share,
  bulge_fading,
  bulge_peak_ratio,
  ground_stiffness,
  joint_axial,
  joint_bending,
  joint_torsion,
  lateral_coupling
};
/// As in files, with the unit: "axial_Pa", "extension_slope_per_Pa", "joint_axial".
const io::Words<Quantity>& quantity_words();
std::string_view to_string(Quantity quantity);
/// Values that make sense at all.
io::Range allowed_range(Quantity quantity);

/// Where values are looked for, ends included.
struct ValueRange {
  double lowest = 0.0;
  double highest = 0.0;
};
using CalibrationBounds = std::map<Quantity, ValueRange>;

/// One unknown of a fit. The solver sees u = ln(value) for what is positive, else u = value / scale, so that a step of one is a
/// large change of any of them.
struct FittedParameter {
  Quantity quantity = Quantity::modulus;
  std::vector<std::size_t> classes;  ///< wall classes that share the value, the one that names it first; none if it has no class
  std::vector<double> proportions;   ///< of the classes' values to the value, in their order; none: all alike
  std::string name;                  ///< "axial_4_Pa" of a class, "axial_Pa" of all
  ValueRange bounds;
  bool logarithmic = false;
  double scale = 1.0;  ///< > 0, of the value where it is not logarithmic

  [[nodiscard]] double unknown_of(double value) const;
  [[nodiscard]] double value_of(double unknown) const;
};

/// Wall classes that the load cases say something of, ascending, by what has a class. None of the lists is empty.
struct DeterminedClasses {
  std::vector<std::size_t> stiffness{0, 1, 2, 3, 4, 5, 6};
  std::vector<std::size_t> extension{0, 1, 2, 3, 4, 5};
  std::vector<std::size_t> bulge{0, 1, 2, 3, 4, 5};
};

/// The unknowns of details in the order in which they must be set. A class that is not determined shares the value of the
/// one with the nearest number of walls; of equally near ones the first in the order of the names.
/// @param bounds of every quantity, see default_bounds
/// @param rough parameters from whose classes the proportions of sections are taken
std::vector<FittedParameter> fitted_parameters(const DetailSet& details, const DeterminedClasses& classes,
                                               const CalibrationBounds& bounds, const SurrogateParameters& rough);

/// Puts a value where it belongs. Ratios are set after the axial stiffness.
void set_value(SurrogateParameters& parameters, const FittedParameter& parameter, double value);
/// The value that parameters have, of the first of its classes.
double value_in(const SurrogateParameters& parameters, const FittedParameter& parameter);

/// The parameters from which a fit begins that adds a detail to one that has none of it: bulges that come apart by wall class
/// begin in the proportions that they have in `rough`; what has no effect at zero begins at a value of the order that closed
/// forms give.
SurrogateParameters with_detail(const SurrogateParameters& fitted, CalibrationDetail detail, const SurrogateParameters& rough,
                                double highest_pressure_Pa);

/// Bounds about parameters known roughly: stiffnesses and slopes of the bulge within a factor of 1000, slopes of extension up to
/// ten times as large of either sign, softening so that no pole lies in the range of pressures.
/// @param lowest_pressure_Pa, highest_pressure_Pa of the load cases
CalibrationBounds default_bounds(const SurrogateParameters& rough, double lowest_pressure_Pa, double highest_pressure_Pa);

}  // namespace menger::voxel
