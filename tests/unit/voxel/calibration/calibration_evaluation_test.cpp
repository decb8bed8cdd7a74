#include "voxel/calibration/calibration_evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/calibration_start.h"

namespace menger::voxel {
namespace {

/// A problem of closed forms, its parameters and unknowns off the truth.
struct Case {
  CalibrationProblem problem;
  std::vector<FittedParameter> parameters;
  std::vector<double> unknowns;

  [[nodiscard]] CalibrationEvaluation evaluation(std::optional<double> loss_scale = {}) const {
    return {problem.curves, parameters, problem.start, problem.responder, loss_scale};
  }
};

Case off_the_truth() {
  Case made;
  made.problem = samples::problem(samples::noisy_curves(samples::truth(), 3));
  made.parameters =
      fitted_parameters(samples::by_class, determined_classes(made.problem), made.problem.bounds, made.problem.start);
  const SurrogateParameters truth = samples::truth();
  for (std::size_t p = 0; p < made.parameters.size(); ++p)
    made.unknowns.push_back(made.parameters[p].unknown_of(value_in(truth, made.parameters[p])) + (p % 2 == 0 ? 0.02 : -0.03));
  return made;
}

/// Differences of the residuals by one unknown, of fourth order.
Eigen::VectorXd difference(const CalibrationEvaluation& evaluation, std::vector<double> unknowns, std::size_t parameter) {
  constexpr double step = 2e-4;
  const double at = unknowns[parameter];
  const auto residuals_at = [&](double change) -> Eigen::VectorXd {
    unknowns[parameter] = at + change;
    return evaluation.residuals(unknowns).value();
  };
  return (8.0 * (residuals_at(step) - residuals_at(-step)) - (residuals_at(2 * step) - residuals_at(-2 * step))) / (12.0 * step);
}

// Central differences over 1e-4 of an unknown err by 1e-8 of the third derivative, which is of the order of the first.
TEST(CalibrationEvaluation, LinearisesItsResiduals) {
  const Case fit = off_the_truth();
  for (const std::optional<double> loss_scale : {std::optional<double>(), std::optional(2.0)}) {
    const CalibrationEvaluation evaluation = fit.evaluation(loss_scale);
    const auto at = evaluation.linearise(fit.unknowns);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->residuals, evaluation.residuals(fit.unknowns));
    ASSERT_EQ(static_cast<std::size_t>(at->jacobian.rows()), evaluation.residual_count());
    ASSERT_EQ(static_cast<std::size_t>(at->jacobian.cols()), fit.parameters.size());
    for (std::size_t p = 0; p < fit.parameters.size(); ++p) {
      const Eigen::VectorXd expected = difference(evaluation, fit.unknowns, p);
      const double scale = expected.cwiseAbs().maxCoeff();
      EXPECT_GT(scale, 0.0) << fit.parameters[p].name;
      const double error = (at->jacobian.col(static_cast<Eigen::Index>(p)) - expected).cwiseAbs().maxCoeff();
      EXPECT_LT(error, 1e-6 * scale) << fit.parameters[p].name;
    }
  }
}

// One-sided differences over 1e-4 err by half of that times the second derivative.
TEST(CalibrationEvaluation, LinearisesAtABoundFromTheOtherSide) {
  Case fit = off_the_truth();
  const auto softest = std::ranges::find(fit.parameters, Quantity::ground_stiffness, &FittedParameter::quantity);
  ASSERT_NE(softest, fit.parameters.end());
  const auto p = static_cast<std::size_t>(softest - fit.parameters.begin());
  const double lowest = softest->bounds.lowest;
  fit.unknowns[p] = softest->unknown_of(lowest);
  double lowest_asked = 2.0 * lowest;
  fit.problem.responder = Responder([&](const SurrogateParameters& parameters, const auto& load_case, const auto& states) {
    lowest_asked = std::min(lowest_asked, parameters.ground_stiffness_N_per_m);
    return samples::closed_forms(parameters, load_case, states);
  });
  const CalibrationEvaluation evaluation = fit.evaluation();
  const auto at = evaluation.linearise(fit.unknowns);
  ASSERT_TRUE(at);
  EXPECT_GE(lowest_asked, lowest);
  const Eigen::VectorXd expected = difference(evaluation, fit.unknowns, p);
  const double error = (at->jacobian.col(static_cast<Eigen::Index>(p)) - expected).cwiseAbs().maxCoeff();
  EXPECT_LT(error, 1e-3 * expected.cwiseAbs().maxCoeff());
}

TEST(CalibrationEvaluation, HasNoLinearisationWhereThereIsNoAnswer) {
  Case fit = off_the_truth();
  const auto slope = std::ranges::find(fit.parameters, Quantity::extension_slope, &FittedParameter::quantity);
  ASSERT_NE(slope, fit.parameters.end());
  fit.unknowns[static_cast<std::size_t>(slope - fit.parameters.begin())] = slope->unknown_of(1e-3);
  EXPECT_FALSE(fit.evaluation().residuals(fit.unknowns));
  EXPECT_FALSE(fit.evaluation().linearise(fit.unknowns));
}

TEST(CalibrationEvaluation, DropsWhatNoCurveDependsOn) {
  Case fit = off_the_truth();
  std::erase_if(fit.problem.curves, [](const FittedCurve& curve) { return curve.load_case.kind == meshes::LoadCaseKind::press; });
  CalibrationEvaluation evaluation = fit.evaluation();
  const Eigen::VectorXd before = evaluation.residuals(fit.unknowns).value();
  std::vector<double> unknowns = fit.unknowns;
  const auto dropped = evaluation.drop_without_influence(unknowns);
  ASSERT_TRUE(dropped);
  ASSERT_EQ(dropped->size(), 1U);
  EXPECT_EQ(dropped->front().quantity, Quantity::ground_stiffness);
  EXPECT_EQ(unknowns.size() + 1, fit.unknowns.size());
  // The dropped one stands at its start now, which no residual sees.
  EXPECT_EQ(evaluation.residuals(unknowns), before);
  const auto all = fit.evaluation().linearise(fit.unknowns);
  const auto kept = evaluation.linearise(unknowns);
  ASSERT_TRUE(all && kept);
  for (std::size_t p = 0; p < evaluation.parameters().size(); ++p) {
    const auto same = std::ranges::find(fit.parameters, evaluation.parameters()[p].name, &FittedParameter::name);
    ASSERT_NE(same, fit.parameters.end());
    // Influences below a millionth of a sigma are left out.
    EXPECT_LT((kept->jacobian.col(static_cast<Eigen::Index>(p)) - all->jacobian.col(same - fit.parameters.begin()))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6)
        << same->name;
  }
}

}  // namespace
}  // namespace menger::voxel
