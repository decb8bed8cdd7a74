#include "voxel/calibration/calibration_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "tests/unit/voxel/calibration/calibration_samples.h"

namespace menger::voxel {
namespace {

using samples::noisy_curves;
using samples::value_named;

TEST(CalibrationFit, ARepeatedSearchLeavesTheBoundsThatTheFirstEndedAt) {
  // A stiffness at its highest bound and slopes at their lowest: the first search runs from this corner along the bounds.
  const SurrogateParameters truth = [] {
    SurrogateParameters p = samples::truth();
    for (PressureLaw& law : p.bulge) {
      law.fading_share = 0.6;
      law.fading_per_Pa = 3e-4;
    }
    return p;
  }();
  CalibrationProblem problem = samples::problem(noisy_curves(truth, 1, 0.0));
  std::erase_if(problem.curves, [](const FittedCurve& curve) {
    return curve.load_case.name != "bar_inflation" && curve.load_case.name != "bar_stretch";
  });
  std::vector<FittedParameter> parameters;
  SurrogateParameters start = truth;
  for (const FittedParameter& parameter :
       fitted_parameters({CalibrationDetail::extension_classes, CalibrationDetail::bulge_classes,
                          CalibrationDetail::stiffness_classes, CalibrationDetail::fading},
                         {{samples::corner_wall_class}, {samples::corner_wall_class}, {samples::corner_wall_class}},
                         problem.bounds, problem.start)) {
    const std::map<Quantity, double> starts{{Quantity::axial, parameter.bounds.highest},
                                            {Quantity::extension_slope, parameter.bounds.lowest},
                                            {Quantity::extension_pressure_softening, 20e-6},
                                            {Quantity::bulge_slope, parameter.bounds.lowest},
                                            {Quantity::bulge_fading, 3e-4}};
    const auto begin = starts.find(parameter.quantity);
    if (begin == starts.end()) continue;
    parameters.push_back(parameter);
    set_value(start, parameter, begin->second);
  }
  std::vector<double> ends;  // chi2 of each search
  CalibrationFitOptions options;
  options.progress = [&](int iteration, double chi2) {
    if (iteration == 0) ends.push_back(0.0);
    ends.back() = chi2;
  };
  const CalibrationFit fit = fit_parameters(problem.curves, parameters, start, problem.responder, options);
  ASSERT_GE(ends.size(), 2U);
  EXPECT_GT(ends.front(), 100.0) << "one search finds the minimum from here: the test needs another start";
  EXPECT_EQ(fit.status, io::RunStatus::completed) << fit.reason;
  EXPECT_LT(fit.chi2, 1e-6);
  EXPECT_NEAR(value_named(fit, "axial_2a_Pa").value, 60e3, 6.0);
  EXPECT_NEAR(value_named(fit, "bulge_slope_2a_per_Pa").value, 1e-6, 1e-10);
}

TEST(CalibrationFit, AStartAtABoundIsMovedInside) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 1, 0.0));
  const auto parameters = fitted_parameters(samples::by_class, determined_classes(problem), problem.bounds, problem.start);
  SurrogateParameters start = problem.start;
  for (const FittedParameter& parameter : parameters) {
    if (parameter.quantity == Quantity::bulge_peak_ratio) set_value(start, parameter, parameter.bounds.lowest);
    if (parameter.quantity == Quantity::ground_stiffness) set_value(start, parameter, parameter.bounds.highest);
  }
  std::vector<double> chi2_by_iteration;
  CalibrationFitOptions options;
  options.progress = [&](int, double chi2) { chi2_by_iteration.push_back(chi2); };
  const CalibrationFit fit = fit_parameters(problem.curves, parameters, start, problem.responder, options);
  // where the search begins differs from the start, whose chi2 it would else have
  double chi2 = 0.0;
  for (const FittedCurve& curve : problem.curves) {
    const auto responses = responses_of(curve, problem.responder(start, curve.load_case, curve.states));
    ASSERT_TRUE(responses);
    for (const double residual : residuals_of(curve, *responses)) chi2 += residual * residual;
  }
  EXPECT_LT(chi2_by_iteration.front(), 0.99 * chi2);
  EXPECT_LT(fit.chi2, 1e-6);
}

/// Closed forms that have no response for ground stiffnesses in a range.
Responder without_responses_in(double lowest_N_per_m, double highest_N_per_m) {
  return [=](const SurrogateParameters& p, const meshes::LoadCase& load_case, const Responder::States& states) {
    const double stiffness = p.ground_stiffness_N_per_m;
    if (stiffness > lowest_N_per_m && stiffness < highest_N_per_m)
      return LoadCaseResponse{.status = io::RunStatus::not_converged, .columns = {}, .values = {}};
    return samples::closed_forms(p, load_case, states);
  };
}

// The ground stiffness, of 5000 in truth, ends at its bound of 6000; a repetition begins at 6049, or 6012, 6002, 6000 where there
// is no response.
TEST(CalibrationFit, ARepetitionWithoutAnswersLosesNothing) {
  for (const double lowest : {6030.0, 6010.0, 6001.0}) {
    CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 13));
    problem.bounds[Quantity::ground_stiffness] = {6000.0, 9000.0};
    const auto parameters = fitted_parameters(samples::by_class, determined_classes(problem), problem.bounds, problem.start);
    SurrogateParameters start = samples::truth();
    start.ground_stiffness_N_per_m = 8000.0;
    const CalibrationFit whole = fit_parameters(problem.curves, parameters, start, problem.responder);
    const CalibrationFit fit = fit_parameters(problem.curves, parameters, start, without_responses_in(lowest, 6100.0));
    EXPECT_EQ(fit.status, io::RunStatus::completed) << fit.reason;
    EXPECT_NEAR(value_named(fit, "ground_stiffness_N_per_m").value, 6000.0, 1e-6);
    EXPECT_EQ(fit.residual_count, whole.residual_count) << "every value has its response";
    EXPECT_NEAR(fit.chi2, whole.chi2, 1e-3 * whole.chi2) << "where a search ends that gains no more";
  }
}

TEST(CalibrationFit, BeginsBesideABoundWhereThereIsNoAnswerInside) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 13));
  problem.bounds[Quantity::ground_stiffness] = {6000.0, 9000.0};
  const auto parameters = fitted_parameters(samples::by_class, determined_classes(problem), problem.bounds, problem.start);
  SurrogateParameters start = samples::truth();
  start.ground_stiffness_N_per_m = 6000.0;
  std::vector<double> chi2_by_iteration;
  CalibrationFitOptions options;
  options.progress = [&](int, double chi2) { chi2_by_iteration.push_back(chi2); };
  const CalibrationFit fit = fit_parameters(problem.curves, parameters, start, without_responses_in(6001.0, 1e9), options);
  for (const double chi2 : chi2_by_iteration)
    EXPECT_TRUE(std::isfinite(chi2)) << "also after steps to where there is no equilibrium";
  EXPECT_EQ(fit.status, io::RunStatus::completed) << fit.reason;
  EXPECT_NEAR(value_named(fit, "ground_stiffness_N_per_m").value, 6000.0, 1e-6);
  // slopes were not halved for it
  const double truth = samples::truth().bulge[closed_wall_class].slope_per_Pa;
  EXPECT_NEAR(value_named(fit, "bulge_slope_4_per_Pa").value, truth, 0.1 * truth);
}

TEST(CalibrationFit, IntervalsStayWithinTheBounds) {
  // where nothing fades, how fast it would is not known at all
  const SurrogateParameters truth = samples::truth();
  const CalibrationProblem problem = samples::problem(noisy_curves(truth, 5));
  DetailSet details = samples::by_class;
  details.insert(CalibrationDetail::fading);
  const auto parameters = fitted_parameters(details, determined_classes(problem), problem.bounds, problem.start);
  const SurrogateParameters start = with_detail(truth, CalibrationDetail::fading, problem.start, 15e3);
  for (const FittedValue& value : fit_parameters(problem.curves, parameters, start, problem.responder).values) {
    if (!value.confidence_95) continue;
    constexpr double rounding = 1e-9;
    const ValueRange& bounds = value.parameter.bounds;
    const double slack = rounding * (bounds.highest - bounds.lowest);
    EXPECT_GE(value.confidence_95->first, bounds.lowest - slack) << value.parameter.name;
    EXPECT_LE(value.confidence_95->second, bounds.highest + slack) << value.parameter.name;
  }
}

}  // namespace
}  // namespace menger::voxel
