#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/calibration/calibration_data.h"
#include "voxel/calibration/calibration_parameters.h"

namespace menger::voxel {

/// How well the data determine a value.
enum class Determination {
  determined,
  wide,           ///< its interval is larger than the value itself
  at_bound,       ///< the fit left it at a bound, and counts it as known
  not_separable,  ///< other values can make up for a change of it, so that it has no interval
  no_influence    ///< no load case answers to it: it keeps what it had before the fit
};
std::string_view to_string(Determination determination);

/// A parameter after a fit.
struct FittedValue {
  FittedParameter parameter;
  double value = 0.0;
  Determination determination = Determination::determined;
  std::optional<std::pair<double, double>> confidence_95;  ///< of determined and wide ones
};

/// How a fit is made.
struct CalibrationFitOptions {
  std::optional<double> loss_scale{};  ///< in standard deviations, of Cauchy's loss; without: sum of squares
  int largest_iteration_count = 100;
  const std::atomic<bool>* stop = nullptr;
  /// What is minimised so far, with weights and loss. May be empty.
  std::function<void(int iteration, double chi2)> progress{};
};

/// Parameters fitted to response curves, and how much they are to be trusted.
struct CalibrationFit {
  io::RunStatus status = io::RunStatus::completed;  ///< completed, not_converged or stopped
  std::string reason;                               ///< if not completed
  SurrogateParameters parameters;                   ///< the best found
  std::vector<FittedValue> values;                  ///< fitted ones first, then those without influence
  /// Between fitted values, in the order of `values`; nothing where one of the two has no interval.
  std::vector<std::vector<std::optional<double>>> correlation;
  std::vector<std::vector<double>> residuals;  ///< by curve: (surrogate - reference) / sigma, ordinate by ordinate
  double chi2 = 0.0;                           ///< sum of their squares, whatever the weights
  std::size_t residual_count = 0;
  std::size_t parameter_count = 0;  ///< fitted ones
  double aic = 0.0;                 ///< see akaike
  /// Whether the stated uncertainties explain the residuals: chi2 is below its 99 % quantile. If not, intervals are widened by
  /// the residuals; they hold if the model is right in shape and errors are independent, else they are too narrow.
  bool explained = true;

  /// chi2 by the degrees of freedom; by the residuals where none is left.
  [[nodiscard]] double reduced_chi2() const;
};

/// Akaike's criterion where the stated standard deviations may be too small by one common factor s >= 1, which is estimated:
/// n ln s^2 + chi2 / s^2 + 2 k with s^2 = max(1, chi2 / n).
/// @param chi2 of what the fit minimises: with the weights of the curves, by their mean over the residuals
double akaike(double chi2, std::size_t residual_count, std::size_t parameter_count);

/// Fits parameters by least squares within their bounds, beginning with those of `start`, moved well inside
/// the bounds.
///
/// Where the surrogate has no equilibrium there, it begins nearer to the bounds, and where it has none at the start itself, its
/// slopes of extension and bulge are halved up to eight times. A search that fails on the way ends as not_converged with the best
/// that it found.
CalibrationFit fit_parameters(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                              const SurrogateParameters& start, const Responder& responder,
                              const CalibrationFitOptions& options = {});

/// A residual far outside what the others are.
struct Outlier {
  std::size_t curve = 0;
  std::string ordinate;
  std::size_t row = 0;
  double residual = 0.0;  ///< in standard deviations
};

/// Residuals beyond five times the spread of all (1.4826 times the median of their magnitudes) and beyond three stated standard
/// deviations, the largest first.
std::vector<Outlier> outliers_of(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

}  // namespace menger::voxel
