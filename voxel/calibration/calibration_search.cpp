#include "voxel/calibration/calibration_search.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <span>

namespace menger::voxel {
namespace {

constexpr int most_repetitions = 4;

/// The residuals of all curves as a cost function of the solver.
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

/// Reports every iteration, and ends the search when asked to.
class Watch : public ceres::IterationCallback {
 public:
  explicit Watch(const CalibrationFitOptions& options) : options_(options) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    // The cost of a rejected step is that where it would have led: infinite if there is no equilibrium.
    if (summary.iteration == 0 || summary.step_is_successful) chi2_ = 2.0 * summary.cost;
    if (options_.progress) options_.progress(summary.iteration, chi2_);
    const bool stops = options_.stop != nullptr && *options_.stop;
    return stops ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const CalibrationFitOptions& options_;
  double chi2_ = 0.0;  ///< after the last accepted step
};

ceres::Solver::Options solver_options(const CalibrationFitOptions& fit_options) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = fit_options.largest_iteration_count;
  options.max_num_consecutive_invalid_steps = 20;  // steps into regions without equilibrium, which shrink the trust region
  options.function_tolerance = 1e-7;               // of chi2, where changes below about one have little meaning
  options.parameter_tolerance = 1e-7;
  options.gradient_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // responses to curves are computed in parallel, and summed in a fixed order
  // Otherwise a search that fails on its path would leave the unknowns at its start.
  options.update_state_every_iteration = true;
  return options;
}

/// Searches from inside the bounds near the end of another search, as far inside as there are equilibria.
std::optional<SearchEnd> search_from_inside(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                                            const CalibrationFitOptions& options) {
  const std::vector<double> ended = unknowns;
  for (const double margin : inside_margins) {
    unknowns = moved_inside(ended, evaluation.parameters(), margin);
    if (auto end = search_once(evaluation, unknowns, options)) return end;
    if (options.is_stopped()) break;
  }
  return std::nullopt;
}

}  // namespace

std::vector<double> moved_inside(std::vector<double> unknowns, const std::vector<FittedParameter>& parameters, double margin) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double lowest = parameters[p].unknown_of(parameters[p].bounds.lowest);
    const double highest = parameters[p].unknown_of(parameters[p].bounds.highest);
    const double inside = margin * (highest - lowest);
    unknowns[p] = std::clamp(unknowns[p], lowest + inside, highest - inside);
  }
  return unknowns;
}

std::optional<SearchEnd> search_once(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                                     const CalibrationFitOptions& fit_options) {
  // Ceres logs steps to unknowns without equilibrium; here these are expected.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Problem problem;
  problem.AddResidualBlock(new AllCurves(evaluation), nullptr, unknowns.data());
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    const FittedParameter& parameter = evaluation.parameters()[p];
    problem.SetParameterLowerBound(unknowns.data(), static_cast<int>(p), parameter.unknown_of(parameter.bounds.lowest));
    problem.SetParameterUpperBound(unknowns.data(), static_cast<int>(p), parameter.unknown_of(parameter.bounds.highest));
  }
  Watch watch(fit_options);
  ceres::Solver::Options options = solver_options(fit_options);
  options.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  // The costs of the summary cannot be used: they are -1, less than any cost, if there was no response.
  if (summary.iterations.empty()) return std::nullopt;
  SearchEnd end{.iterations = summary.iterations.size()};
  end.cost = summary.iterations.front().cost;
  for (const ceres::IterationSummary& iteration : summary.iterations) {
    if (iteration.step_is_successful) end.cost = std::min(end.cost, iteration.cost);
  }
  if (summary.termination_type != ceres::CONVERGENCE && summary.termination_type != ceres::USER_SUCCESS) {
    end.status = io::RunStatus::not_converged;
    end.reason = summary.message;
  }
  return end;
}

SearchEnd search_repeatedly(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                            const CalibrationFitOptions& options) {
  std::optional<SearchEnd> best = search_once(evaluation, unknowns, options);
  if (!best && !options.is_stopped())
    return {.status = io::RunStatus::not_converged, .reason = "the surrogate has no equilibrium at the start of the search"};
  for (int again = 0; best && again < most_repetitions && !options.is_stopped(); ++again) {
    std::vector<double> repeated = unknowns;
    const std::optional<SearchEnd> next = search_from_inside(evaluation, repeated, options);
    constexpr double worth = 1e-3;
    if (!next || !(next->cost < best->cost)) break;
    const bool ends = next->cost > (1.0 - worth) * best->cost;
    unknowns = repeated;
    best = next;
    if (ends) break;
  }
  SearchEnd end = best.value_or(SearchEnd{});
  if (options.is_stopped()) {
    end.status = io::RunStatus::stopped;
    end.reason = "after " + std::to_string(end.iterations) + " iterations";
  }
  return end;
}

}  // namespace menger::voxel
