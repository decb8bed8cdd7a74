#include "voxel/calibration_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "voxel/calibration_confidence.h"
#include "voxel/calibration_evaluation.h"

namespace menger::voxel {
namespace {

constexpr int most_halvings = 8;
constexpr int most_repetitions = 4;

/// All residuals over all unknowns, in the solver's terms.
class AllCurves : public ceres::CostFunction {
 public:
  explicit AllCurves(const CalibrationEvaluation& evaluation) : evaluation_(evaluation) {
    set_num_residuals(static_cast<int>(evaluation.residual_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int32_t>(evaluation.parameters().size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::span<const double> unknowns(parameters[0], evaluation_.parameters().size());
    if (jacobians == nullptr || jacobians[0] == nullptr) {
      const auto values = evaluation_.residuals(unknowns);
      if (values) Eigen::Map<Eigen::VectorXd>(residuals, values->size()) = *values;
      return values.has_value();
    }
    const auto at = evaluation_.linearise(unknowns);
    if (!at) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, at->residuals.size()) = at->residuals;
    Eigen::Map<RowMajorMatrix>(jacobians[0], at->jacobian.rows(), at->jacobian.cols()) = at->jacobian;
    return true;
  }

 private:
  const CalibrationEvaluation& evaluation_;
};

/// Tells of each iteration and ends the solution when asked to.
class Watch : public ceres::IterationCallback {
 public:
  explicit Watch(const CalibrationFitOptions& options) : options_(options) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (options_.progress) options_.progress(summary.iteration, 2.0 * summary.cost);
    const bool stops = options_.stop != nullptr && *options_.stop;
    return stops ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const CalibrationFitOptions& options_;
};

ceres::Solver::Summary solve(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                             const CalibrationFitOptions& fit_options) {
  // Ceres logs steps to where the surrogate has no equilibrium, which is no news here.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Problem problem;
  problem.AddResidualBlock(new AllCurves(evaluation), nullptr, unknowns.data());
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const FittedParameter& parameter = evaluation.parameters()[p];
    problem.SetParameterLowerBound(unknowns.data(), static_cast<int>(p), parameter.unknown_of(parameter.bounds.lowest));
    problem.SetParameterUpperBound(unknowns.data(), static_cast<int>(p), parameter.unknown_of(parameter.bounds.highest));
  }
  Watch watch(fit_options);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = fit_options.largest_iteration_count;
  options.max_num_consecutive_invalid_steps = 20;  // into regions without equilibrium, from where the trust region shrinks
  options.function_tolerance = 1e-7;               // of chi2, which means something to about one
  options.parameter_tolerance = 1e-7;
  options.gradient_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // curves are answered in parallel, in a fixed order of summation
  options.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary;
}

/// Unknowns well inside their bounds: from a bound a step that the others want is cut off at once, and the search may end where
/// it began.
std::vector<double> moved_inside(std::vector<double> unknowns, const std::vector<FittedParameter>& parameters) {
  constexpr double margin = 0.02;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double lowest = parameters[p].unknown_of(parameters[p].bounds.lowest);
    const double highest = parameters[p].unknown_of(parameters[p].bounds.highest);
    const double inside = margin * (highest - lowest);
    unknowns[p] = std::clamp(unknowns[p], lowest + inside, highest - inside);
  }
  return unknowns;
}

std::vector<double> unknowns_of(const std::vector<FittedParameter>& parameters, const SurrogateParameters& start) {
  std::vector<double> unknowns;
  for (const FittedParameter& parameter : parameters) {
    const double value = std::clamp(value_in(start, parameter), parameter.bounds.lowest, parameter.bounds.highest);
    unknowns.push_back(parameter.unknown_of(value));
  }
  return moved_inside(std::move(unknowns), parameters);
}

void halve_slopes(SurrogateParameters& parameters) {
  for (PressureLaw& law : parameters.extension) law.slope_per_Pa *= 0.5;
  for (PressureLaw& law : parameters.bulge) law.slope_per_Pa *= 0.5;
}

bool is_stopped(const CalibrationFitOptions& options) { return options.stop != nullptr && *options.stop; }

void set_status(CalibrationFit& fit, io::RunStatus status, std::string reason) {
  fit.status = status;
  fit.reason = std::move(reason);
}

/// Residuals without loss, and what follows from their sum of squares.
void judge_residuals(CalibrationFit& fit, const std::vector<FittedCurve>& curves, const Responder& responder) {
  fit.residuals.resize(curves.size());
  tbb::parallel_for(std::size_t{0}, curves.size(), [&](std::size_t c) {
    const auto answers = answers_of(curves[c], responder(fit.parameters, curves[c].load_case, curves[c].states));
    if (answers) fit.residuals[c] = residuals_of(curves[c], *answers);
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
  // By the mean weight, so that one that all curves have changes nothing.
  const double mean_weight = weights > 0.0 ? weights / static_cast<double>(fit.residual_count) : 1.0;
  fit.aic = akaike(weighted / mean_weight, fit.residual_count, fit.parameter_count);
  if (fit.residual_count <= fit.parameter_count) return;
  // Wilson and Hilferty's approximation of the quantile: to a few parts in a thousand from three degrees of freedom on
  const auto freedom = static_cast<double>(fit.residual_count - fit.parameter_count);
  const double spread = 2.0 / (9.0 * freedom);
  constexpr double normal_quantile_99 = 2.326348;
  fit.explained = fit.chi2 <= freedom * std::pow(1.0 - spread + normal_quantile_99 * std::sqrt(spread), 3);
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
  return "no load case answers to it";
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
  SurrogateParameters begin = start;
  CalibrationEvaluation evaluation(curves, parameters, begin, responder, options.loss_scale, options.stop);
  std::vector<double> unknowns = unknowns_of(parameters, begin);
  std::optional<std::vector<FittedParameter>> dropped = evaluation.drop_without_influence(unknowns);
  for (int halving = 0; !dropped && halving < most_halvings && !is_stopped(options); ++halving) {
    halve_slopes(begin);
    unknowns = unknowns_of(parameters, begin);
    dropped = evaluation.drop_without_influence(unknowns);
  }
  if (is_stopped(options)) {
    set_status(fit, io::RunStatus::stopped, "before the first iteration");
  } else if (!dropped) {
    set_status(fit, io::RunStatus::not_converged, "the surrogate has no equilibrium at the start of the fit");
  } else if (unknowns.empty()) {
    set_status(fit, io::RunStatus::not_converged, "no load case answers to any of the parameters");
  }
  if (fit.status != io::RunStatus::completed) return fit;

  if (options.loss_scale) {
    // Far residuals hardly pull, so that a search among them may end anywhere: it begins where squares end.
    const CalibrationEvaluation squares(curves, evaluation.parameters(), begin, responder, {}, options.stop);
    solve(squares, unknowns, options);
  }
  ceres::Solver::Summary summary = solve(evaluation, unknowns, options);
  // A search that ran along bounds is begun anew from inside them, with its trust region as wide as at first.
  for (int again = 0; again < most_repetitions && !is_stopped(options); ++again) {
    std::vector<double> repeated = moved_inside(unknowns, evaluation.parameters());
    const ceres::Solver::Summary next = solve(evaluation, repeated, options);
    constexpr double worth = 1e-3;
    if (!(next.final_cost < summary.final_cost)) break;
    const bool ends = next.final_cost > (1.0 - worth) * summary.final_cost;
    unknowns = repeated;
    summary = next;
    if (ends) break;
  }
  if (is_stopped(options)) {
    set_status(fit, io::RunStatus::stopped, "after " + std::to_string(summary.iterations.size()) + " iterations");
  } else if (summary.termination_type != ceres::CONVERGENCE) {
    set_status(fit, io::RunStatus::not_converged, summary.message);
  }
  fit.parameters = evaluation.parameters_at(unknowns);
  fit.parameter_count = unknowns.size();
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const FittedParameter& parameter = evaluation.parameters()[p];
    fit.values.push_back({parameter, parameter.value_of(unknowns[p]), Determination::determined, {}});
  }
  for (const FittedParameter& parameter : *dropped)
    fit.values.push_back({parameter, value_in(fit.parameters, parameter), Determination::no_influence, {}});
  judge_residuals(fit, curves, responder);
  if (const auto at = evaluation.linearise(unknowns)) set_confidence(fit, at->jacobian, evaluation.weights());
  return fit;
}

std::vector<Outlier> outliers_of(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  constexpr double far = 5.0;
  constexpr double least = 3.0;
  constexpr double normal_spread = 1.4826;  // standard deviation by the median of the magnitudes
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
