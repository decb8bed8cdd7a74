#pragma once

#include <string>

#include "voxel/calibration/calibration.h"
#include "voxel/calibration/calibration_study.h"

namespace menger::voxel {

/// The parameters of the fit that was chosen, with the damping of the study's loss data. Where the fit ended early they are the
/// best found, and their texts say so.
SurrogateParameters reported_parameters(const Calibration& calibration, const CalibrationStudy& study);

/// Voxel parameters as read_surrogate reads them, with a table [fit]: status, details, explained, chi2, reduced_chi2, aic,
/// residuals, curves with their content hashes, 95 % intervals, and the names of parameters that the curves do not determine;
/// details whose fits failed, if any. The status is that of the fit that the parameters are of, whatever became of further
/// details.
std::string parameters_text(const Calibration& calibration, const CalibrationStudy& study);

/// The outcome for people and scripts: status and reason, details, whether the uncertainties explain the residuals, classes that
/// took another's values, outliers, notes.
std::string result_text(const Calibration& calibration, const CalibrationStudy& study, const std::vector<FittedCurve>& curves);

/// The wall classes that no load case says anything of, and whose values they took, in sentences.
std::vector<std::string> class_notes(const DeterminedClasses& classes);

}  // namespace menger::voxel
