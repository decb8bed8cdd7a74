#pragma once

#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/calibration/calibration.h"

namespace menger::voxel {

/// The error of the surrogate in one ordinate of one curve.
struct OrdinateError {
  std::size_t curve = 0;
  std::string ordinate;
  double rms = 0.0;       ///< in the unit of the ordinate
  double worst = 0.0;     ///< error of largest magnitude, with its sign
  double relative = 0.0;  ///< RMS divided by the largest magnitude of the reference, or by its sigma if that is larger
};

std::vector<OrdinateError> ordinate_errors(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// Root mean square of the relative errors of a kind of load case, or of all of them; nothing if there is none.
std::optional<double> relative_error_of(std::optional<meshes::LoadCaseKind> kind, const std::vector<FittedCurve>& curves,
                                        const CalibrationFit& fit);

/// A short text for a body: "3x1x1", with its level if that is not 1.
std::string body_text(const meshes::LoadCase& load_case);

/// A table of the gain of each detail: detail, joined_with, kept, status, parameters, residuals, chi2, reduced_chi2, aic,
/// relative_rms over all curves, and relative_rms_KIND for every kind among them. A fit that ended without a result has no
/// numbers.
io::CsvTable detail_table(const Calibration& calibration, const std::vector<FittedCurve>& curves);

/// A table of the fit, one row per parameter: parameter, value, lowest_95, highest_95, classes, determination. lowest_95 and
/// highest_95 are the ends of the 95 % confidence interval, empty if there is none. classes names the wall classes that share the
/// value, with spaces between. determination is a word for how well the data determine it, see Determination.
io::CsvTable parameter_table(const CalibrationFit& fit);

/// A table of the correlations of fitted parameters, one row and column each; empty where one of the two has no interval.
io::CsvTable correlation_table(const CalibrationFit& fit);

/// A table of the errors: case, kind, body, ordinate, rms, worst, unit, relative.
io::CsvTable residual_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// A table of every curve, reference and surrogate: case, kind, body, pressure_Pa, imposed, ordinate, reference, surrogate,
/// sigma.
io::CsvTable response_table(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

/// The value of the surrogate that gave a residual. @param n position among the residuals of the curve
double response_at(const FittedCurve& curve, const std::vector<double>& residuals, std::size_t n);

}  // namespace menger::voxel
