#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

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
/// Whether only positive values make sense, so that fits see their logarithms.
bool is_positive(Quantity quantity);
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

/// Puts a value where it belongs. Ratios are set after the axial stiffness.
void set_value(SurrogateParameters& parameters, const FittedParameter& parameter, double value);
/// The value that parameters have, of the first of its classes.
double value_in(const SurrogateParameters& parameters, const FittedParameter& parameter);
/// The value of a quantity that parameters have in a wall class; which does not matter to what has no class.
double value_in(const SurrogateParameters& parameters, Quantity quantity, std::size_t wall_class);

/// Bounds about parameters known roughly: stiffnesses and slopes of the bulge within a factor of 1000, slopes of extension up to
/// ten times as large of either sign, softening so that no pole lies in the range of pressures.
/// @param lowest_pressure_Pa, highest_pressure_Pa of the load cases
CalibrationBounds default_bounds(const SurrogateParameters& rough, double lowest_pressure_Pa, double highest_pressure_Pa);

}  // namespace menger::voxel
