#pragma once

#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/calibration/calibration.h"

namespace menger::voxel {

/// How far the surrogate is from one ordinate of one curve.
struct OrdinateError {
  std::size_t curve = 0;
  std::string ordinate;
  double rms = 0.0;       ///< in the unit of the ordinate
  double worst = 0.0;     ///< of largest magnitude, with its sign
  double relative = 0.0;  ///< RMS by the largest magnitude of the reference; by its sigma where that is larger
};

std::vector<OrdinateError> ordinate_errors(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// Root of the mean square of the relative errors of a kind of load case; nothing if there is none.
std::optional<double> relative_error_of(meshes::LoadCaseKind kind, const std::vector<FittedCurve>& curves,
                                        const CalibrationFit& fit);

/// A body for people: "3x1x1", with its level where that is not 1.
std::string body_text(const meshes::LoadCase& load_case);

/// What each detail buys: detail, joined_with, kept, status, parameters, residuals, chi2, reduced_chi2, aic, and
/// relative_rms_KIND for every kind among the curves; no numbers for a fit that ended without an answer.
io::CsvTable detail_table(const Calibration& calibration, const std::vector<FittedCurve>& curves);

/// parameter, value, lowest_95, highest_95, classes (wall classes that share it), determination.
io::CsvTable parameter_table(const CalibrationFit& fit);

/// Correlation of the fitted parameters, one row and column each; empty where one of the two has no interval.
io::CsvTable correlation_table(const CalibrationFit& fit);

/// case, kind, body, ordinate, rms, worst, unit, relative.
io::CsvTable residual_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// Every curve, reference against surrogate: case, kind, body, pressure_Pa, imposed, ordinate, reference, surrogate, sigma.
io::CsvTable answer_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// The surrogate's value behind a residual. @param n place among the residuals of the curve
double answer_at(const FittedCurve& curve, const std::vector<double>& residuals, std::size_t n);

}  // namespace menger::voxel
