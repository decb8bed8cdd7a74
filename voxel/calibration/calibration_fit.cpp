#include "voxel/calibration/calibration_fit.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "voxel/calibration/calibration_confidence.h"
#include "voxel/calibration/calibration_evaluation.h"
#include "voxel/calibration/calibration_search.h"

namespace menger::voxel {
namespace {

constexpr int most_halvings = 8;

std::vector<double> unknowns_of(const std::vector<FittedParameter>& parameters, const SurrogateParameters& start) {
  std::vector<double> unknowns;
  for (const FittedParameter& parameter : parameters) {
    const double value = std::clamp(value_in(start, parameter), parameter.bounds.lowest, parameter.bounds.highest);
    unknowns.push_back(parameter.unknown_of(value));
  }
  return unknowns;
}

void halve_slopes(SurrogateParameters& parameters) {
  for (PressureLaw& law : parameters.extension) law.slope_per_Pa *= 0.5;
  for (PressureLaw& law : parameters.bulge) law.slope_per_Pa *= 0.5;
}

/// Unknowns at the start, and the parameters without influence there, which are dropped from the evaluation.
struct Beginning {
  std::vector<double> unknowns;
  std::vector<FittedParameter> dropped;
};

/// Finds unknowns at which a fit can begin: at the start, or with smaller and smaller slopes if the surrogate has no equilibrium
/// there; well inside the bounds if possible, otherwise nearer to them. @return nothing if there is no equilibrium, or if stopped
std::optional<Beginning> beginning_of(CalibrationEvaluation& evaluation, SurrogateParameters start,
                                      const CalibrationFitOptions& options) {
  for (int halving = 0; halving <= most_halvings; ++halving) {
    const std::vector<double> at_start = unknowns_of(evaluation.parameters(), start);
    for (const double margin : inside_margins) {
      if (options.is_stopped()) return std::nullopt;
      Beginning beginning{moved_inside(at_start, evaluation.parameters(), margin), {}};
      if (auto dropped = evaluation.drop_without_influence(beginning.unknowns)) {
        beginning.dropped = std::move(*dropped);
        return beginning;
      }
      if (beginning.unknowns == at_start) break;  // it already lies inside
    }
    halve_slopes(start);
  }
  return std::nullopt;
}

void set_status(CalibrationFit& fit, io::RunStatus status, std::string reason) {
  fit.status = status;
  fit.reason = std::move(reason);
}

/// Sets the residuals without loss, and all that follows from their sum of squares.
void assess_residuals(CalibrationFit& fit, const std::vector<FittedCurve>& curves, const Responder& responder) {
  fit.residuals.resize(curves.size());
  tbb::parallel_for(std::size_t{0}, curves.size(), [&](std::size_t c) {
    const auto responses = responses_of(curves[c], responder(fit.parameters, curves[c].load_case, curves[c].states));
    if (responses) fit.residuals[c] = residuals_of(curves[c], *responses);
  });
  double weighted = 0.0;
  double weights = 0.0;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    double squares = 0.0;
    for (const double residual : fit.residuals[c]) squares += residual * residual;
    fit.chi2 += squares;
    fit.residual_count += fit.residuals[c].size();
    weighted += curves[c].weight * squares;
    weights += curves[c].weight * static_cast<double>(fit.residuals[c].size());
  }
  // Divided by the mean weight, so that a weight common to all curves has no effect.
  const double mean_weight = weights > 0.0 ? weights / static_cast<double>(fit.residual_count) : 1.0;
  fit.aic = akaike(weighted / mean_weight, fit.residual_count, fit.parameter_count);
  if (fit.residual_count <= fit.parameter_count) return;
  const boost::math::chi_squared expected(static_cast<double>(fit.residual_count - fit.parameter_count));
  fit.explained = fit.chi2 <= boost::math::quantile(expected, 0.99);
}

}  // namespace

std::string_view to_string(Determination determination) {
  switch (determination) {
    case Determination::determined:
      return "determined";
    case Determination::wide:
      return "interval larger than the value";
    case Determination::at_bound:
      return "at a bound";
    case Determination::not_separable:
      return "not separable from others";
    case Determination::no_influence:
      break;
  }
  return "no load case depends on it";
}

double CalibrationFit::reduced_chi2() const {
  const std::size_t freedom = residual_count > parameter_count ? residual_count - parameter_count : residual_count;
  return freedom > 0 ? chi2 / static_cast<double>(freedom) : 0.0;
}

double akaike(double chi2, std::size_t residual_count, std::size_t parameter_count) {
  if (residual_count == 0) return 0.0;
  const auto n = static_cast<double>(residual_count);
  const double square = std::max(1.0, chi2 / n);
  return n * std::log(square) + chi2 / square + 2.0 * static_cast<double>(parameter_count);
}

CalibrationFit fit_parameters(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                              const SurrogateParameters& start, const Responder& responder,
                              const CalibrationFitOptions& options) {
  CalibrationFit fit;
  fit.parameters = start;
  CalibrationEvaluation evaluation(curves, parameters, start, responder, options.loss_scale, options.stop);
  std::optional<Beginning> beginning = beginning_of(evaluation, start, options);
  if (options.is_stopped()) {
    set_status(fit, io::RunStatus::stopped, "before the first iteration");
  } else if (!beginning) {
    set_status(fit, io::RunStatus::not_converged, "the surrogate has no equilibrium at the start of the fit");
  } else if (beginning->unknowns.empty()) {
    set_status(fit, io::RunStatus::not_converged, "no load case depends on any of the parameters");
  }
  if (fit.status != io::RunStatus::completed) return fit;

  std::vector<double> unknowns = beginning->unknowns;
  if (options.loss_scale) {
    // Outliers have little effect on the loss, so a search among them may end anywhere. It begins at the minimum of the squares.
    const CalibrationEvaluation squares(curves, evaluation.parameters(), start, responder, {}, options.stop);
    static_cast<void>(search_once(squares, unknowns, options));
  }
  const SearchEnd end = search_repeatedly(evaluation, unknowns, options);
  set_status(fit, end.status, end.reason);
  fit.parameters = evaluation.parameters_at(unknowns);
  fit.parameter_count = unknowns.size();
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const FittedParameter& parameter = evaluation.parameters()[p];
    fit.values.push_back({parameter, parameter.value_of(unknowns[p]), Determination::determined, {}});
  }
  for (const FittedParameter& parameter : beginning->dropped)
    fit.values.push_back({parameter, value_in(fit.parameters, parameter), Determination::no_influence, {}});
  assess_residuals(fit, curves, responder);
  if (const auto at = evaluation.linearise(unknowns)) set_confidence(fit, at->jacobian, evaluation.weights());
  return fit;
}

std::vector<Outlier> outliers_of(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  constexpr double far = 5.0;
  constexpr double least = 3.0;
  constexpr double normal_spread = 1.4826;  // standard deviation / median of the magnitudes
  std::vector<double> magnitudes;
  for (const auto& residuals : fit.residuals) {
    for (const double residual : residuals) magnitudes.push_back(std::abs(residual));
  }
  if (magnitudes.empty()) return {};
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  const double limit = std::max(least, far * normal_spread * *middle);
  std::vector<Outlier> outliers;
  for (std::size_t c = 0; c < fit.residuals.size(); ++c) {
    const std::size_t rows = curves[c].states.size();
    for (std::size_t n = 0; n < fit.residuals[c].size(); ++n) {
      if (std::abs(fit.residuals[c][n]) > limit)
        outliers.push_back({c, curves[c].ordinates[n / rows], n % rows, fit.residuals[c][n]});
    }
  }
  std::sort(outliers.begin(), outliers.end(),
            [](const Outlier& a, const Outlier& b) { return std::abs(a.residual) > std::abs(b.residual); });
  return outliers;
}

}  // namespace menger::voxel
