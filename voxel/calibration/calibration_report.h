#pragma once

#include <string>

#include "voxel/calibration/calibration.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::voxel {

/// The parameters of the chosen fit, with the damping from the study's loss data. If the fit ended early, they are the best
/// found; the texts below then state this.
SurrogateParameters reported_parameters(const Calibration& calibration, const CalibrationStudy& study);

/// The text of a file of voxel parameters, as read_surrogate reads it, with a table [fit]. The table has status, details,
/// explained, chi2, reduced_chi2, aic, residuals, curves with their content hashes, 95 % intervals, the names of parameters that
/// the curves do not determine, and details whose fits failed, if any. The status is that of the fit that gave the parameters,
/// for any outcome of further details.
std::string parameters_text(const Calibration& calibration, const CalibrationStudy& study);

/// The text of result.toml: status and reason, details, whether the uncertainties explain the residuals, classes that share
/// another's values, outliers, notes.
std::string result_text(const Calibration& calibration, const CalibrationStudy& study, const std::vector<FittedCurve>& curves);

/// Sentences on the wall classes that no load case determines, and on the classes whose values they share.
std::vector<std::string> class_notes(const DeterminedClasses& classes);

}  // namespace menger::voxel
