// Data that contradict each other, are too few, or need values that the bounds forbid.

#include <algorithm>
#include <string>

#include "tests/extremes/calibration_rows.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/calibration_tables.h"

namespace menger::extremes {

namespace {

namespace samples = voxel::samples;
using meshes::LoadCaseKind;
using voxel::CalibrationFit;
using voxel::Determination;
using voxel::FittedCurve;
using voxel::FittedValue;

constexpr double contradiction = 1.5;  // force of the second curve divided by that of the first

/// Returns the fitted force divided by F, where the two curves have the forces F and f F with equal relative errors: the s with
/// the least (s - 1)^2 + (s / f - 1)^2.
double compromise() { return (1.0 + 1.0 / contradiction) / (1.0 + 1.0 / (contradiction * contradiction)); }

void run_contradiction(Outcome& outcome) {
  std::vector<FittedCurve> curves = tube_curves(9);
  const CalibrationFit sound = voxel::calibrate(samples::problem(curves), tube_plan()).fit();
  outcome.expect(sound.explained, "one curve alone is explained");
  FittedCurve second = curve_of_kind(curves, LoadCaseKind::stretch);
  const std::string first_name = second.load_case.name;
  second.load_case.name += "_again";
  const std::size_t force = ordinate_index(second, "force_N");
  for (double& force_N : second.reference[force]) force_N *= contradiction;
  second.sigma[force] *= contradiction;
  curves.push_back(second);
  const CalibrationFit fit = voxel::calibrate(samples::problem(curves), tube_plan()).fit();
  outcome.expect_status(fit.status, io::RunStatus::completed, fit.reason);
  outcome.expect(!fit.explained,
                 "chi2 " + shown(fit.chi2) + " of " + std::to_string(fit.residual_count) + " residuals is not explained");
  outcome.expect_near("axial stiffness Pa", fit.parameters.axial_Pa[voxel::closed_wall_class],
                      compromise() * calibration_truth().axial_Pa[voxel::closed_wall_class], 0.03);
  std::vector<voxel::OrdinateError> errors = voxel::ordinate_errors(curves, fit);
  std::sort(errors.begin(), errors.end(), [](const auto& a, const auto& b) { return a.relative > b.relative; });
  for (std::size_t n = 0; n < 2; ++n) {
    const std::string& name = curves[errors[n].curve].load_case.name;
    const bool is_first = name == first_name;
    outcome.expect(
        (is_first || name == second.load_case.name) && errors[n].ordinate == "force_N" && (errors[n].worst > 0.0) == is_first,
        name + " " + errors[n].ordinate + " off by " + shown(100.0 * errors[n].relative, 2) + " %, at worst by " +
            shown(errors[n].worst, 2) + " N");
  }
  outcome.expect_at_most("relative error of the next", errors[2].relative, 0.04);
}

std::string names_of(const CalibrationFit& fit, Determination determination) {
  std::string names;
  for (const FittedValue& value : fit.values) {
    if (value.determination == determination) names.append(names.empty() ? "" : " ").append(value.parameter.name);
  }
  return names;
}

void run_single_point(Outcome& outcome) {
  meshes::LoadCase load_case = samples::load_cases().front();
  load_case.pressures_Pa = {5000.0};
  const std::vector<FittedCurve> curves{voxel::fitted_curve(samples::curve_of(load_case, calibration_truth()))};
  const voxel::CalibrationProblem problem = samples::problem(curves);
  voxel::CalibrationPlan plan;
  plan.details = {voxel::CalibrationDetail::uniform};
  const CalibrationFit fit = voxel::calibrate(problem, plan).fit();
  outcome.expect_status(fit.status, io::RunStatus::completed, fit.reason);
  outcome.expect_at_most("chi2", fit.chi2, 1e-4);
  const std::string entangled = names_of(fit, Determination::not_separable);
  outcome.expect(entangled ==
                     "extension_slope_per_Pa extension_pressure_softening_per_Pa bulge_slope_per_Pa "
                     "bulge_pressure_softening_per_Pa",
                 "not separable: " + entangled);
  const std::string unseen = names_of(fit, Determination::no_influence);
  outcome.expect(unseen == "modulus_Pa extension_vacuum_softening_per_Pa bulge_vacuum_softening_per_Pa ground_stiffness_N_per_m",
                 "without influence: " + unseen);
  for (const FittedValue& value : fit.values)
    outcome.expect(value.confidence_95.has_value() == (value.parameter.name == "bulge_peak_ratio"),
                   value.parameter.name + (value.confidence_95 ? " has an interval" : " has none"));
  outcome.expect(fit.parameters.axial_Pa == problem.start.axial_Pa, "the modulus stays what it was");
}

void run_bound(Outcome& outcome) {
  const double truth = calibration_truth().ground_stiffness_N_per_m;
  const double lowest = 1.2 * truth;
  voxel::CalibrationProblem problem = samples::problem(tube_curves(13));
  problem.bounds[voxel::Quantity::ground_stiffness] = {lowest, 2.0 * truth};
  const CalibrationFit fit = voxel::calibrate(problem, tube_plan()).fit();
  outcome.expect_status(fit.status, io::RunStatus::completed, fit.reason);
  const std::string at_bound = names_of(fit, Determination::at_bound);
  outcome.expect(at_bound == "ground_stiffness_N_per_m", "at a bound: " + at_bound);
  const FittedValue& value = value_named(fit, "ground_stiffness_N_per_m");
  outcome.expect_near("its value N/m", value.value, lowest, 1e-6);
  outcome.expect(!value.confidence_95, "it has no interval");
  outcome.expect(!fit.explained, "what it leaves is not explained");
  outcome.expect_at_most("farthest of the others from the truth in standard deviations",
                         worst_distance(fit, fit, calibration_truth()), 3.0);
}

}  // namespace

std::vector<Row> calibration_data_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "contradictory curves",
                  .done = "a tube is stretched twice, the second time with 1.5 times the force",
                  .expected = "completed and not explained; the axial stiffness is the weighted mean, 1.154 times that of the "
                              "first, to 3 %, three standard deviations; the forces of the two curves have the largest errors, "
                              "of opposite signs, and no other ordinate is off by more than 4 %, twice its uncertainty",
                  .run = run_contradiction});
  rows.push_back({.name = "single point",
                  .done = "fit of nine values to one state of inflation, at 5 kPa",
                  .expected = "completed; only the ratio of two bulges at this pressure, the peak ratio, has an interval; slope "
                              "and softening make up for each other; no load case depends on modulus, vacuum and contact, and "
                              "they keep what they had",
                  .run = run_single_point});
  rows.push_back({.name = "parameter at its bound",
                  .done = "the ground stiffness must be 1.2 times the true one at least",
                  .expected = "completed; it alone is reported at its bound, exactly there and without interval; not explained, "
                              "since 20 % are ten standard deviations; the others are within three of the truth",
                  .run = run_bound});
  return rows;
}

}  // namespace menger::extremes
