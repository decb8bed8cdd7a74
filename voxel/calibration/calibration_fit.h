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

/// How well the data determine a fitted value.
enum class Determination {
  determined,
  wide,           ///< its interval is larger than the value itself
  at_bound,       ///< the fit ended with the value at a bound, and counts it as known
  not_separable,  ///< other values can compensate a change of it, so it has no interval
  /// No load case depends on it: not before the fit, whose value it then keeps, or not where the fit ended.
  no_influence
};
std::string_view to_string(Determination determination);

/// A parameter after a fit.
struct FittedValue {
  FittedParameter parameter;
  double value = 0.0;
  Determination determination = Determination::determined;
  std::optional<std::pair<double, double>> confidence_95;  ///< if determined or wide
};

/// Options of a fit.
struct CalibrationFitOptions {
  std::optional<double> loss_scale{};  ///< of Cauchy's loss, in standard deviations; without it the sum of squares is minimised
  int largest_iteration_count = 100;
  const std::atomic<bool>* stop = nullptr;
  /// Called with the present value of what is minimised, weights and loss included. May be empty.
  std::function<void(int iteration, double chi2)> progress{};

  [[nodiscard]] bool is_stopped() const { return stop != nullptr && *stop; }
};

/// The result of a fit: parameters and how well the curves determine them.
struct CalibrationFit {
  io::RunStatus status = io::RunStatus::completed;  ///< completed, not_converged or stopped
  std::string reason;                               ///< if not completed
  SurrogateParameters parameters;                   ///< the best found
  std::vector<FittedValue> values;                  ///< fitted ones first, then those without influence
  /// Correlation of fitted values, in the order of `values`; nothing if one of the two has no interval.
  std::vector<std::vector<std::optional<double>>> correlation;
  /// By curve: (surrogate - reference) / sigma, ordinate by ordinate. Empty for curves that took no part in the fit.
  std::vector<std::vector<double>> residuals;
  double chi2 = 0.0;  ///< sum of the squared residuals, without weights
  std::size_t residual_count = 0;
  std::size_t parameter_count = 0;  ///< fitted ones
  double aic = 0.0;                 ///< see akaike
  /// Whether the stated uncertainties explain the residuals: chi2 is below its 99 % quantile. If not, intervals are widened
  /// according to the residuals. They are then right if the model has the right shape and errors are independent; otherwise they
  /// are too narrow.
  bool explained = true;

  /// chi2 divided by the degrees of freedom, or by the number of residuals if no degree of freedom is left.
  [[nodiscard]] double reduced_chi2() const;
};

/// Akaike's information criterion. The stated standard deviations may all be too small by one factor s >= 1, which is estimated:
/// n ln s^2 + chi2 / s^2 + 2 k with s^2 = max(1, chi2 / n) for n residuals and k parameters.
/// @param chi2 weighted as in the fit: squares with the weights of the curves, divided by the mean weight of a residual
double akaike(double chi2, std::size_t residual_count, std::size_t parameter_count);

/// Fits parameters by least squares within their bounds. The search begins at the values of `start`, moved well inside the
/// bounds.
///
/// If the surrogate has no equilibrium there, the search begins nearer to the bounds. If it has none at the start itself, the
/// slopes of extension and bulge are halved, up to eight times. A search that fails on its path ends as not_converged with the
/// best parameters found.
CalibrationFit fit_parameters(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                              const SurrogateParameters& start, const Responder& responder,
                              const CalibrationFitOptions& options = {});

/// A residual much larger than the others.
struct Outlier {
  std::size_t curve = 0;
  std::string ordinate;
  std::size_t row = 0;
  double residual = 0.0;  ///< in standard deviations
};

/// Residuals larger than five times the spread of all residuals (1.4826 times the median of their magnitudes) and larger than
/// three stated standard deviations, largest first.
std::vector<Outlier> outliers_of(const std::vector<FittedCurve>& curves, const CalibrationFit& fit);

}  // namespace menger::voxel
