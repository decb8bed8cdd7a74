#pragma once

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/calibration/calibration_quantities.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// The details of the model that a fit may include. Each detail adds freedom to those that it is joined with. The model without
/// it is a special case of the model with it, except for sections, which has no freedom of its own.
enum class CalibrationDetail {
  /// Always included: one modulus for all stiffnesses, one law of extension, one of bulge, and contact with the ground.
  uniform,
  stiffness,  ///< separate axial, bending and torsional stiffness
  /// Stiffnesses and extension in the proportions of the wall sections of the wall classes.
  sections,
  shear,              ///< shear compliance, in one ratio to axial compliance
  bulge_classes,      ///< slope and peak of the bulge by wall class
  extension_classes,  ///< slope of the extension by wall class
  stiffness_classes,  ///< axial stiffness by wall class; bending, torsion and shear in one ratio to axial
  /// For flat walls that first bend and then stretch: fading share and fading rate of the bulge, by wall class if bulge_classes
  /// is included.
  fading,
  softening,  ///< softening of extension and bulge by wall class
  joints,     ///< factors of bonded joints
  lateral,    ///< lateral coupling
  elbows,     ///< how far elbows open
  plates,     ///< how plates rise, stretch and draw their edges in, and what volume lies below wide walls
  /// How far plates stand out where limbs leave them. Always tried last, and fitted alone to the bodies that have such limbs;
  /// these take no part in the fits of all other details.
  necks
};
using DetailSet = std::set<CalibrationDetail>;
const io::Words<CalibrationDetail>& detail_words();
std::string_view to_string(CalibrationDetail detail);

/// The wall classes that the load cases determine, ascending, for each property. None of the lists is empty.
struct DeterminedClasses {
  std::vector<std::size_t> stiffness{0, 1, 2, 3, 4, 5, 6};
  std::vector<std::size_t> extension{0, 1, 2, 3, 4, 5};
  std::vector<std::size_t> bulge{0, 1, 2, 3, 4, 5};
};

/// The unknowns of details, in the order in which they must be set. A class that is not determined shares the value of the
/// determined class with the nearest number of walls; of equally near ones, of the first in the order of their names.
/// @param bounds of every quantity, see default_bounds
/// @param rough parameters whose classes give the proportions of sections
std::vector<FittedParameter> fitted_parameters(const DetailSet& details, const DeterminedClasses& classes,
                                               const CalibrationBounds& bounds, const SurrogateParameters& rough);

/// The parameters at which the fit of an added detail begins. Bulges that are separated by wall class begin in the proportions
/// that they have in `rough`. A parameter without effect at zero begins at a value of the order that closed forms give.
SurrogateParameters with_detail(const SurrogateParameters& fitted, CalibrationDetail detail, const SurrogateParameters& rough,
                                double highest_pressure_Pa);

/// All starts of the fit of an added detail; the first is that of with_detail.
///
/// Wide walls stop bending at pressures that are a small fraction of those that narrow walls bear, so a fit of fading bulges has
/// more than one minimum. Its starts have fading rates of three, ten and thirty times the inverse of the highest pressure.
std::vector<SurrogateParameters> starts_with_detail(const SurrogateParameters& fitted, CalibrationDetail detail,
                                                    const SurrogateParameters& rough, double highest_pressure_Pa);

}  // namespace menger::voxel
