#pragma once

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

#include "io/text/toml_document.h"
#include "voxel/calibration/calibration_quantities.h"
#include "voxel/model/surrogate_parameters.h"

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

/// The parameters from which a fit begins that adds a detail to one that has none of it: bulges that come apart by wall class
/// begin in the proportions that they have in `rough`; what has no effect at zero begins at a value of the order that closed
/// forms give.
SurrogateParameters with_detail(const SurrogateParameters& fitted, CalibrationDetail detail, const SurrogateParameters& rough,
                                double highest_pressure_Pa);

/// All places from which such a fit is searched for, that of with_detail first. Wide walls stop bending at pressures that are a
/// small part of what narrow ones bear, so that bulges that fade have more than one minimum: from rates three, ten and thirty
/// times the inverse of the highest pressure.
std::vector<SurrogateParameters> starts_with_detail(const SurrogateParameters& fitted, CalibrationDetail detail,
                                                    const SurrogateParameters& rough, double highest_pressure_Pa);

}  // namespace menger::voxel
