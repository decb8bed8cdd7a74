// Starts at which the surrogate has no equilibrium.

#include "tests/extremes/calibration_rows.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"

namespace menger::extremes {

namespace {

namespace samples = voxel::samples;
using voxel::CalibrationFit;
using voxel::closed_wall_class;

/// A slope of extension that turns cells inside out: rest lengths are below zero from 1 kPa on.
constexpr double inverting_per_Pa = -1e-3;

/// Returns a problem with the curves of the surrogate itself instead of closed forms, and a start without equilibria.
voxel::CalibrationProblem inverted_problem() {
  std::vector<voxel::FittedCurve> curves = tube_curves(0, 0.0);
  for (voxel::FittedCurve& curve : curves) {
    const voxel::LoadCaseResponse response = voxel::respond(calibration_truth(), curve.load_case, curve.states);
    meshes::ResponseCurve made{.provenance = samples::provenance(), .columns = response.columns, .values = response.values};
    made.provenance.load_case = curve.load_case;
    curve = voxel::fitted_curve(made);
  }
  voxel::CalibrationProblem problem = samples::problem(curves);
  problem.responder = [](const auto& parameters, const auto& load_case, const auto& states) {
    return voxel::respond(parameters, load_case, states);
  };
  for (voxel::PressureLaw& law : problem.start.extension) law.slope_per_Pa = inverting_per_Pa;
  problem.bounds[voxel::Quantity::extension_slope] = {2.0 * inverting_per_Pa, -2.0 * inverting_per_Pa};
  return problem;
}

void expect_no_equilibrium(Outcome& outcome, const voxel::CalibrationProblem& problem) {
  const voxel::FittedCurve& inflation = problem.curves.front();
  const voxel::LoadCaseResponse response = problem.responder(problem.start, inflation.load_case, inflation.states);
  outcome.note("at the start");
  outcome.expect_status(response.status, io::RunStatus::limit_point, response.reason);
}

void run_pulled_back(Outcome& outcome) {
  const voxel::CalibrationProblem problem = inverted_problem();
  expect_no_equilibrium(outcome, problem);
  const CalibrationFit fit = voxel::calibrate(problem, tube_plan()).fit();
  outcome.expect_status(fit.status, io::RunStatus::completed, fit.reason);
  const voxel::SurrogateParameters truth = calibration_truth();
  const voxel::SurrogateParameters& found = fit.parameters;
  outcome.expect_near("extension 1/Pa", found.extension[closed_wall_class].slope_per_Pa,
                      truth.extension[closed_wall_class].slope_per_Pa, 1e-3);
  outcome.expect_near("bulge 1/Pa", found.bulge[closed_wall_class].slope_per_Pa, truth.bulge[closed_wall_class].slope_per_Pa,
                      1e-3);
  outcome.expect_near("axial Pa", found.axial_Pa[closed_wall_class], truth.axial_Pa[closed_wall_class], 1e-3);
}

void run_out_of_reach(Outcome& outcome) {
  voxel::CalibrationProblem problem = inverted_problem();
  problem.bounds[voxel::Quantity::extension_slope] = {2.0 * inverting_per_Pa, 0.5 * inverting_per_Pa};
  expect_no_equilibrium(outcome, problem);
  const CalibrationFit fit = voxel::calibrate(problem, tube_plan()).fit();
  outcome.expect_status(fit.status, io::RunStatus::not_converged, fit.reason);
  outcome.expect(fit.reason.find("no equilibrium") != std::string::npos, "says why");
  outcome.expect(fit.values.empty(), "no value passes for a fitted one");
  outcome.expect(fit.parameters.axial_Pa == problem.start.axial_Pa, "the parameters are those of the start");
}

}  // namespace

std::vector<Row> calibration_start_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "no equilibrium at the start",
                  .done =
                      "the surrogate's own curves are fitted from an extension of -1e-3 per Pa, 400 times the true one in the "
                      "wrong direction",
                  .expected = "limit_point at the start, where no length is left; completed: slopes are halved until there are "
                              "equilibria; the truth to 1e-3, since the curves are "
                              "without noise and the search ends where chi2 does not change any more",
                  .run = run_pulled_back});
  rows.push_back({.name = "no equilibrium within the bounds",
                  .done = "the same with bounds that allow no other extension",
                  .expected = "limit_point at the start; not converged, and why; parameters as they were, no fitted values",
                  .run = run_out_of_reach});
  return rows;
}

}  // namespace menger::extremes
