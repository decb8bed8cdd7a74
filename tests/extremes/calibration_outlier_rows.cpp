// Single values with large errors among correct ones.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "tests/extremes/calibration_rows.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"

namespace menger::extremes {

namespace {

namespace samples = voxel::samples;
using meshes::LoadCaseKind;
using voxel::CalibrationFit;
using voxel::FittedCurve;

constexpr double outlying = 15.0;  // standard deviations

/// Moves a value by `outlying` standard deviations. @return its position: "tube_stretch force_N 2"
std::string spoil(std::vector<FittedCurve>& curves, LoadCaseKind kind, const std::string& ordinate, std::size_t row,
                  double sign) {
  FittedCurve& curve = curve_of_kind(curves, kind);
  const std::size_t place = ordinate_index(curve, ordinate);
  curve.reference[place][row] += sign * outlying * curve.sigma[place];
  return curve.load_case.name + " " + ordinate + " " + std::to_string(row);
}

std::vector<std::string> flagged(const std::vector<FittedCurve>& curves, const CalibrationFit& fit) {
  std::vector<std::string> places;
  for (const voxel::Outlier& outlier : outliers_of(curves, fit))
    places.push_back(curves[outlier.curve].load_case.name + " " + outlier.ordinate + " " + std::to_string(outlier.row));
  std::sort(places.begin(), places.end());
  return places;
}

CalibrationFit robust_fit(const std::vector<FittedCurve>& curves) {
  voxel::CalibrationPlan plan = tube_plan();
  plan.fit.loss_scale = 2.0;
  return voxel::calibrate(samples::problem(curves), plan).fit();
}

void run_outliers(Outcome& outcome) {
  constexpr std::uint64_t seeds = 10;
  const voxel::SurrogateParameters truth = calibration_truth();
  double worst = 0.0;
  double least_of_squares = std::numeric_limits<double>::infinity();
  std::uint64_t flagged_alone = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    std::vector<FittedCurve> curves = tube_curves(seed);
    const CalibrationFit clean = voxel::calibrate(samples::problem(curves), tube_plan()).fit();
    const std::vector<std::string> spoilt{spoil(curves, LoadCaseKind::bending, "moment_N_m", 1, 1.0),
                                          spoil(curves, LoadCaseKind::inflation, "extent_x_m", 7, 1.0),
                                          spoil(curves, LoadCaseKind::stretch, "force_N", 2, -1.0)};
    const CalibrationFit pulled = voxel::calibrate(samples::problem(curves), tube_plan()).fit();
    const CalibrationFit robust = robust_fit(curves);
    if (robust.status != io::RunStatus::completed) outcome.expect_status(robust.status, io::RunStatus::completed, robust.reason);
    if (flagged(curves, clean).empty() && flagged(curves, robust) == spoilt) ++flagged_alone;
    worst = std::max(worst, worst_distance(robust, clean, truth));
    least_of_squares = std::min(least_of_squares, worst_distance(pulled, clean, truth));
  }
  outcome.expect(flagged_alone == seeds, "they alone are flagged, " + std::to_string(flagged_alone) + " times");
  outcome.expect_at_most("farthest value from the truth in standard deviations", worst, 4.0);
  outcome.expect_between("the same of plain squares, at least", least_of_squares, 5.0, 100.0);
}

/// The three points of the curve have 1/35, 9/35 and 25/35 of its weight.
void run_leverage(Outcome& outcome) {
  std::vector<FittedCurve> curves = tube_curves(11);
  const CalibrationFit clean = voxel::calibrate(samples::problem(curves), tube_plan()).fit();
  spoil(curves, LoadCaseKind::bending, "moment_N_m", 2, 1.0);
  CalibrationFit fit = robust_fit(curves);
  outcome.expect_status(fit.status, io::RunStatus::completed, fit.reason);
  const std::vector<std::string> places = flagged(curves, fit);
  for (const std::string& place : places) outcome.expect(place.starts_with("tube_bending"), place + " is flagged");
  outcome.expect(!places.empty() && !fit.explained, "the curve is named and the residuals are not explained");
  const double truth_Pa = calibration_truth().bending_Pa[voxel::closed_wall_class];
  outcome.expect_between("bending stiffness by the true one", fit.parameters.bending_Pa[voxel::closed_wall_class] / truth_Pa,
                         0.95, 1.35);
  voxel::SurrogateParameters truth = calibration_truth();
  truth.bending_Pa = fit.parameters.bending_Pa;  // all except the moved one
  outcome.expect_at_most("farthest of the others from the truth in standard deviations", worst_distance(fit, clean, truth), 4.0);
}

}  // namespace

std::vector<Row> calibration_outlier_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "outliers",
                  .done =
                      "three of a tube's 77 reference values are moved by 15 standard deviations, the others have noise; with "
                      "ten seeds",
                  .expected = "these three alone are flagged; with Cauchy's loss no value is farther than four standard "
                              "deviations from the truth, which 90 values hardly pass by chance; plain squares miss it by five "
                              "at least",
                  .run = run_outliers});
  rows.push_back({.name = "outlier that outweighs its curve",
                  .done = "the same for the largest of three angles of bending, which has 25 of 35 parts of the weight",
                  .expected =
                      "a limit of the loss: one value against two that weigh less. The curve is flagged, not which of its "
                      "points is wrong; not explained; the bending stiffness lies between the truth and the outlier's "
                      "1.3 times it, to 5 %, and nothing else is touched",
                  .run = run_leverage});
  return rows;
}

}  // namespace menger::extremes
