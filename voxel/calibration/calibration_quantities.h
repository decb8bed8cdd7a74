#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The quantity that a fitted number stands for. Ratios are relative to the axial stiffness of the same class (shear_ratio: to
/// its compliance).
enum class Quantity {
  modulus,  ///< of axial, bending and torsional stiffness
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
  lateral_coupling,
  bulge_neck_ratio,
  elbow_ratio,
  plate_stretch_ratio,
  plate_draw_in,
  plate_rise,
  plate_draw_in_rate,  ///< how soon plates rise and draw their edges in
  plate_edge_share,
  plate_arm_ratio,
  wide_volume_ratio
};
/// The names used in files, with the unit: "axial_Pa", "extension_slope_per_Pa", "joint_axial".
const io::Words<Quantity>& quantity_words();
std::string_view to_string(Quantity quantity);
/// Whether only positive values are meaningful, so that fits use their logarithms.
bool is_positive(Quantity quantity);
/// The range of meaningful values.
io::Range allowed_range(Quantity quantity);

/// An interval of values, ends included.
struct ValueRange {
  double lowest = 0.0;
  double highest = 0.0;
};
using CalibrationBounds = std::map<Quantity, ValueRange>;

/// One unknown of a fit. The solver uses u = ln(value) for positive quantities, otherwise u = value / scale. A step of one is
/// thus a large change of any of them.
struct FittedParameter {
  Quantity quantity = Quantity::modulus;
  /// Wall classes that share the value; the first one gives it its name. Empty for a quantity without classes.
  std::vector<std::size_t> classes;
  std::vector<double> proportions;  ///< value of each class divided by the value; empty: all equal
  std::string name;                 ///< "axial_4_Pa" for a class, "axial_Pa" for all
  ValueRange bounds;
  bool logarithmic = false;
  double scale = 1.0;  ///< > 0, of the value if it is not logarithmic

  [[nodiscard]] double unknown_of(double value) const;
  [[nodiscard]] double value_of(double unknown) const;
};

/// Sets a fitted value in parameters. Ratios must be set after the axial stiffness.
void set_value(SurrogateParameters& parameters, const FittedParameter& parameter, double value);
/// The value of a fitted parameter in parameters, of the first of its classes.
double value_in(const SurrogateParameters& parameters, const FittedParameter& parameter);
/// The value of a quantity in a wall class. The class is ignored for a quantity without classes.
double value_in(const SurrogateParameters& parameters, Quantity quantity, std::size_t wall_class);

/// Returns the bounds within which a fit may change the parameters, around roughly known ones. Wall classes share them.
///
/// - Stiffnesses: a factor of 1000 about that of the class with walls on all sides; that of the ground about its own.
/// - Ratios of stiffnesses: a factor of 100 about 1. Joints: a factor of 20 about 1.
/// - Slopes of the bulge with pressure (PressureLaw): from a thousandth of the smallest to a thousand times the largest of all
///   wall classes.
/// - Slopes of the extension with pressure: up to ten times the steepest of all wall classes, of either sign.
/// - Softening: 1 - q |p| stays positive at all pressures of the load cases, so that a PressureLaw has no pole there.
///   Stiffening (q < 0) is bounded too: q |p| >= -5.
/// - Fading and draw-in: a factor of 100 about 1 / pressure. Stretch of plates: as ratios of stiffnesses.
/// - Ratios of necks, arms and volumes: a factor of 10 about 1.
/// - Share of fading and of edges of plates, draw-in, peak ratio, elbow ratio and lateral coupling: fixed intervals.
///
/// @param rough parameters that are known roughly
/// @param lowest_pressure_Pa, highest_pressure_Pa the range of pressures in the load cases
CalibrationBounds default_bounds(const SurrogateParameters& rough, double lowest_pressure_Pa, double highest_pressure_Pa);

}  // namespace menger::voxel
