#include "voxel/calibration/calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/voxel/calibration/calibration_samples.h"
#include "voxel/calibration/calibration_run.h"
#include "voxel/statics/load_case_slopes.h"

namespace menger::voxel {
namespace {

using samples::noisy_curves;
using samples::value_named;

CalibrationPlan plan_of(std::vector<CalibrationDetail> details) {
  CalibrationPlan plan;
  plan.details = std::move(details);
  return plan;
}

/// All the details that the samples need, kept whatever they buy.
CalibrationPlan plan_by_class() {
  CalibrationPlan plan = plan_of({CalibrationDetail::uniform, CalibrationDetail::bulge_classes,
                                  CalibrationDetail::extension_classes, CalibrationDetail::stiffness_classes});
  plan.choice = CalibrationDetail::stiffness_classes;
  return plan;
}

TEST(CalibrationData, SmallOrdinatesAreNotTakenForPrecise) {
  meshes::LoadCase load_case = samples::load_cases()[1];
  meshes::ResponseCurve curve = samples::curve_of(load_case, samples::truth());
  for (double& value : curve.values[4]) value = 1e-9;  // extent_y_m
  for (double& value : curve.values[5]) value = 2e-3;  // extent_z_m
  const FittedCurve fitted = fitted_curve(curve, 4.0);
  const auto place = std::find(fitted.ordinates.begin(), fitted.ordinates.end(), "extent_y_m") - fitted.ordinates.begin();
  // 2 % of a hundredth of the larger extent, whatever the weight
  EXPECT_NEAR(fitted.sigma[static_cast<std::size_t>(place)], 0.02 * 0.01 * 2e-3, 1e-12);
  EXPECT_EQ(fitted.weight, 4.0);
}

TEST(CalibrationData, OrdinatesWithoutAnyAnswerAreLeftOut) {
  meshes::ResponseCurve curve = samples::curve_of(samples::load_cases()[1], samples::truth());
  for (double& value : curve.values[3]) value = 0.0;  // volume_change, the only one without unit
  const FittedCurve fitted = fitted_curve(curve);
  EXPECT_EQ(fitted.ordinates, (std::vector<std::string>{"force_N", "extent_y_m", "extent_z_m"}));
}

TEST(Calibration, FindsTheTruthWithoutNoise) {
  const SurrogateParameters truth = samples::truth();
  const Calibration found =
      calibrate(samples::problem(noisy_curves(truth, 1, 0.0)),
                plan_of({CalibrationDetail::uniform, CalibrationDetail::stiffness, CalibrationDetail::bulge_classes,
                         CalibrationDetail::extension_classes, CalibrationDetail::stiffness_classes}));
  ASSERT_EQ(found.fit().status, io::RunStatus::completed) << found.fit().reason;
  EXPECT_EQ(to_string(found.details()), "uniform + stiffness + bulge_classes + extension_classes + stiffness_classes");
  const std::vector<std::size_t> loaded{samples::corner_wall_class, closed_wall_class};
  EXPECT_EQ(found.classes.stiffness, loaded);
  EXPECT_EQ(found.classes.extension, loaded);
  EXPECT_EQ(found.classes.bulge, loaded);
  // the solver ends where a step changes chi2, here of 6e5 at the start, by less than 1e-9 of itself
  EXPECT_LT(found.fit().chi2, 1e-6);
  const SurrogateParameters& p = found.fit().parameters;
  for (const std::size_t c : loaded) {
    EXPECT_NEAR(p.axial_Pa[c], truth.axial_Pa[c], 1e-4 * truth.axial_Pa[c]);
    EXPECT_NEAR(p.bending_Pa[c], truth.bending_Pa[c], 1e-4 * truth.bending_Pa[c]);
    EXPECT_NEAR(p.torsion_Pa[c], truth.torsion_Pa[c], 1e-4 * truth.torsion_Pa[c]);
    EXPECT_NEAR(p.extension[c].slope_per_Pa, truth.extension[c].slope_per_Pa, 1e-4 * truth.extension[c].slope_per_Pa);
    EXPECT_NEAR(p.bulge[c].slope_per_Pa, truth.bulge[c].slope_per_Pa, 1e-4 * truth.bulge[c].slope_per_Pa);
    EXPECT_NEAR(p.bulge_peak_ratio[c], truth.bulge_peak_ratio[c], 1e-3);
  }
}

TEST(Calibration, MoreDetailNeverFitsWorse) {
  std::vector<CalibrationDetail> details;
  for (const auto& [word, detail] : detail_words()) {
    if (detail != CalibrationDetail::sections) details.push_back(detail);  // which says other things, not more
  }
  CalibrationPlan plan = plan_of(details);
  plan.choice = details.back();
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 3)), plan);
  ASSERT_EQ(found.steps.size(), details.size());
  // a search ends where its repetition lowers chi2 by less than a thousandth
  for (std::size_t s = 1; s < found.steps.size(); ++s)
    EXPECT_LE(found.steps[s].fit.chi2, found.steps[s - 1].fit.chi2 * (1.0 + 1e-3)) << to_string(found.steps[s].detail);
}

TEST(Calibration, BuysOnlyTheDetailThatTheDataAskFor) {
  // the proportions of the walls, but bending and torsion apart from axial stiffness
  SurrogateParameters truth = samples::truth();
  const SurrogateParameters rough = rough_parameters(samples::provenance(), 1);
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    truth.axial_Pa[c] = 0.8 * rough.axial_Pa[c];
    truth.bending_Pa[c] = 1.3 * rough.axial_Pa[c];
    truth.torsion_Pa[c] = 0.6 * rough.axial_Pa[c];
    truth.extension[c].slope_per_Pa = 1.2 * rough.extension[c].slope_per_Pa;
  }
  truth.bulge.fill(truth.bulge[closed_wall_class]);
  truth.bulge_peak_ratio.fill(2.2);
  const CalibrationPlan plan;
  const Calibration found = calibrate(samples::problem(noisy_curves(truth, 5)), plan);
  EXPECT_EQ(to_string(found.details()), "uniform + stiffness + sections");
  // all others were tried, once each: nothing was kept after them
  EXPECT_EQ(found.steps.size(), plan.details.size());
  EXPECT_TRUE(found.fit().explained);
  EXPECT_FALSE(found.steps[0].fit.explained);
}

TEST(Calibration, BuysClassesOfTheirOwnWhereTheDataAskForThem) {
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 5)), {});
  const DetailSet details = found.details();
  for (const CalibrationDetail detail : samples::by_class) EXPECT_TRUE(details.contains(detail)) << to_string(detail);
  // no load case responds to them
  for (const CalibrationDetail detail : {CalibrationDetail::shear, CalibrationDetail::lateral, CalibrationDetail::joints})
    EXPECT_FALSE(details.contains(detail)) << to_string(detail);
  EXPECT_TRUE(found.fit().explained);
}

/// Curves of the inflation of bodies that are two cells deep and wide, as a model with these parameters gives them.
std::vector<FittedCurve> inflations(const SurrogateParameters& truth, const std::vector<const char*>& bodies) {
  std::vector<FittedCurve> curves;
  for (const char* digits : bodies) {
    meshes::LoadCase load_case = samples::provenance().load_case;
    load_case.name = "inflation";
    load_case.kind = meshes::LoadCaseKind::inflation;
    load_case.cells = {3, 2, 2};
    load_case.digits = digits;
    load_case.pressures_Pa = {1000, 2000, 4000};
    const LoadCaseResponse response = respond(truth, load_case);
    EXPECT_EQ(response.status, io::RunStatus::completed) << response.reason;
    meshes::ResponseCurve curve{.provenance = samples::provenance(), .columns = response.columns, .values = response.values};
    curve.provenance.load_case = load_case;
    curves.push_back(fitted_curve(curve));
  }
  return curves;
}

/// Walls that are all alike, and bulge to a peak of twice their mean.
SurrogateParameters alike_walls() {
  SurrogateParameters truth = rough_parameters(samples::provenance(), 1);
  truth.axial_Pa.fill(60e3);
  truth.bending_Pa = truth.torsion_Pa = truth.axial_Pa;
  truth.extension.fill(samples::law(3e-6, 0.0, 0.0));
  truth.bulge.fill(samples::law(5e-6, 0.0, 0.0));
  truth.bulge_peak_ratio.fill(2.0);
  return truth;
}

/// The fit of a detail, whatever it gains, to curves of equilibria.
Calibration fitted_with(CalibrationDetail detail, std::vector<FittedCurve> curves) {
  CalibrationProblem problem = samples::problem(std::move(curves));
  problem.responder = equilibrium_responder();
  CalibrationPlan plan = plan_of({CalibrationDetail::uniform, detail});
  plan.choice = detail;
  return calibrate(problem, plan);
}

TEST(Calibration, FindsHowFarPlatesStandOutWhereLimbsLeaveThem) {
  SurrogateParameters truth = alike_walls();
  truth.neck_ratio = 1.7;
  // A slab, and one on two legs, whose feet move outwards. The slab alone says how far its walls stand out.
  const Calibration found = fitted_with(CalibrationDetail::necks, inflations(truth, {"000000111111", "100001111111"}));
  ASSERT_TRUE(found.details().contains(CalibrationDetail::necks));
  ASSERT_EQ(found.steps.size(), 2U);
  EXPECT_TRUE(found.steps[0].fit.residuals[1].empty()) << "necks take no part in other fits";
  EXPECT_FALSE(found.fit().residuals[1].empty());
  EXPECT_LT(found.fit().chi2, 1e-3);
  EXPECT_EQ(found.fit().parameter_count, found.steps[0].fit.parameter_count + 1);
  EXPECT_EQ(found.fit().correlation.size(), found.fit().parameter_count);
  EXPECT_NEAR(value_named(found.fit(), "bulge_neck_ratio").value, 1.7, 0.01);
}

TEST(Calibration, LeavesElbowsAsTheyAreWhereNoCurveHasOne) {
  const Calibration found = fitted_with(CalibrationDetail::elbows, inflations(alike_walls(), {"111000000000"}));
  ASSERT_TRUE(found.details().contains(CalibrationDetail::elbows));
  EXPECT_EQ(found.fit().parameters.elbow_ratio, 0.0);
}

TEST(Calibration, FindsHowFarElbowsOpen) {
  SurrogateParameters truth = alike_walls();
  truth.elbow_ratio = 2.2;
  const Calibration found = fitted_with(CalibrationDetail::elbows, inflations(truth, {"111100000000", "111000100000"}));
  ASSERT_TRUE(found.details().contains(CalibrationDetail::elbows));
  EXPECT_LT(found.fit().chi2, 1e-3);
  EXPECT_EQ(found.fit().parameter_count, found.steps[0].fit.parameter_count + 1);
  EXPECT_NEAR(value_named(found.fit(), "elbow_ratio").value, 2.2, 0.01);
}

TEST(Calibration, FindsHowPlatesRiseAndDrawTheirEdgesIn) {
  SurrogateParameters truth = alike_walls();
  // No curve says how stiff beams are, so the fit leaves that; how much the middle of a plate moves its edges depends on it.
  const SurrogateParameters start = samples::problem({}).start;
  truth.axial_Pa = start.axial_Pa;
  truth.bending_Pa = start.bending_Pa;
  truth.torsion_Pa = start.torsion_Pa;
  truth.shear_compliance_per_Pa = start.shear_compliance_per_Pa;
  truth.plate_stretch_ratio = 6.0;
  truth.plate_draw_in = 0.06;
  truth.plate_rise = 0.03;
  truth.plate_draw_in_per_Pa = 7e-4;  // half of it within the pressures
  truth.plate_edge_share = 0.4;
  truth.plate_arm_ratio = 1.25;
  truth.wide_volume_ratio = 1.1;
  const Calibration found =
      fitted_with(CalibrationDetail::plates, inflations(truth, {"111000000000", "111111000000", "110110000000", "111110000000"}));
  ASSERT_TRUE(found.details().contains(CalibrationDetail::plates));
  EXPECT_LT(found.fit().chi2, 1e-3);
  EXPECT_EQ(found.fit().parameter_count, found.steps[0].fit.parameter_count + 7);
  EXPECT_NEAR(value_named(found.fit(), "plate_stretch_ratio").value, 6.0, 0.06);
  EXPECT_NEAR(value_named(found.fit(), "plate_draw_in").value, 0.06, 0.001);
  EXPECT_NEAR(value_named(found.fit(), "plate_rise").value, 0.03, 0.0005);
  EXPECT_NEAR(value_named(found.fit(), "plate_draw_in_per_Pa").value, 7e-4, 7e-6);
  EXPECT_NEAR(value_named(found.fit(), "plate_edge_share").value, 0.4, 0.01);
  EXPECT_NEAR(value_named(found.fit(), "plate_arm_ratio").value, 1.25, 0.01);
  EXPECT_NEAR(value_named(found.fit(), "wide_volume_ratio").value, 1.1, 0.01);
}

TEST(Calibration, TakesTheDetailThatIsNamed) {
  CalibrationPlan plan = plan_of({CalibrationDetail::uniform, CalibrationDetail::bulge_classes});
  plan.choice = CalibrationDetail::uniform;
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 5)), plan);
  EXPECT_EQ(to_string(found.details()), "uniform");
  EXPECT_EQ(found.steps.size(), 1U);
}

TEST(Calibration, TriesAgainWhatDidNotPayBeforeAnother) {
  // Softening differs a little between the classes, bending from axial stiffness by far: beside that error the former counts for
  // nothing, so that it is dropped first and kept in the end.
  SurrogateParameters truth = samples::truth();
  truth.axial_Pa.fill(140e3);
  truth.bending_Pa.fill(1400e3);
  truth.torsion_Pa.fill(140e3);
  truth.extension.fill(samples::law(2.5e-6, 10e-6, -15e-6));
  truth.extension[closed_wall_class].pressure_softening_per_Pa = 20e-6;
  truth.bulge.fill(truth.bulge[closed_wall_class]);
  truth.bulge_peak_ratio.fill(2.2);
  const CalibrationPlan plan = plan_of({CalibrationDetail::uniform, CalibrationDetail::softening, CalibrationDetail::stiffness});
  const Calibration found = calibrate(samples::problem(noisy_curves(truth, 17)), plan);
  ASSERT_EQ(found.steps.size(), 4U);
  EXPECT_FALSE(found.steps[1].is_kept);
  EXPECT_TRUE(found.steps[2].is_kept);
  EXPECT_EQ(found.steps[3].detail, CalibrationDetail::softening);
  EXPECT_TRUE(found.steps[3].is_kept);
}

TEST(Calibration, NamesWhatNoLoadCaseAnswersTo) {
  CalibrationPlan plan = plan_by_class();
  plan.details.push_back(CalibrationDetail::joints);
  plan.choice = CalibrationDetail::joints;
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 7)), plan);
  EXPECT_EQ(value_named(found.fit(), "joint_axial").determination, Determination::no_influence);
  EXPECT_EQ(value_named(found.fit(), "joint_axial").value, 1.0);
  EXPECT_EQ(value_named(found.fit(), "axial_4_Pa").determination, Determination::determined);
}

TEST(Calibration, ValidityIsTheRangeOfTheLoadCasesByWallClass) {
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 7)), plan_of({CalibrationDetail::uniform}));
  const ValidityRange& validity = found.fit().parameters.validity;
  // The tube of 3 x 1 x 1 cells has class 4 along it, across three cells, and 3 and 2o across it, across one; the bar of 3 x 2 x
  // 2 has 2a along it and across it, and 1 across its middle, across two. None has class 0 or a joint.
  ByGap<ByWallClass<double>> lowest{};
  lowest[gaps::one_cell][walls::three] = lowest[gaps::one_cell][walls::limb] = -12e3;
  lowest[gaps::two_cells] = lowest[gaps::one_cell];
  lowest[gaps::two_cells][walls::corner] = lowest[gaps::two_cells][walls::one] = -12e3;
  lowest[gaps::three_or_more_cells] = lowest[gaps::two_cells];
  lowest[gaps::three_or_more_cells][walls::closed] = -12e3;
  EXPECT_EQ(validity.lowest_pressure_Pa, lowest);
  ByWallClass<double> highest = all_classes(15e3);
  highest[walls::none] = highest[walls::bend] = 0.0;
  EXPECT_EQ(validity.highest_pressure_Pa, highest);
  EXPECT_EQ(validity.highest_joint_pressure_Pa, 0.0);
  EXPECT_EQ(validity.longest_body_cells, 3);
  EXPECT_EQ(validity.longest_aggregate_modules, 1);
  EXPECT_NEAR(validity.largest_strain, 0.006 / 0.03, 1e-15);
}

TEST(Calibration, ASinglePointDeterminesNearlyNothing) {
  meshes::LoadCase load_case = samples::load_cases()[0];
  load_case.pressures_Pa = {5000.0};
  const std::vector<FittedCurve> curves{fitted_curve(samples::curve_of(load_case, samples::truth()))};
  const Calibration found = calibrate(samples::problem(curves), plan_of({CalibrationDetail::uniform}));
  // one state of a bar: extension, bulge and peak at one pressure; slope and softening of each cannot be told apart
  EXPECT_LT(found.fit().chi2, 1e-4);
  for (const char* name : {"extension_slope_per_Pa", "extension_pressure_softening_per_Pa", "bulge_slope_per_Pa"}) {
    EXPECT_EQ(value_named(found.fit(), name).determination, Determination::not_separable) << name;
    EXPECT_FALSE(value_named(found.fit(), name).confidence_95) << name;
  }
  for (const char* name : {"modulus_Pa", "extension_vacuum_softening_per_Pa", "ground_stiffness_N_per_m"})
    EXPECT_EQ(value_named(found.fit(), name).determination, Determination::no_influence) << name;
}

TEST(Calibration, ContradictoryCurvesAreNotExplained) {
  std::vector<FittedCurve> curves = noisy_curves(samples::truth(), 9);
  FittedCurve twice = curves[1];
  for (auto& values : twice.reference) {
    for (double& value : values) value *= 1.5;
  }
  curves.push_back(twice);
  const Calibration found = calibrate(samples::problem(curves), plan_by_class());
  EXPECT_FALSE(found.fit().explained);
  EXPECT_GT(found.fit().reduced_chi2(), 10.0);
  // the interval is widened by what the data contradict each other
  const auto sound = calibrate(samples::problem(noisy_curves(samples::truth(), 9)), plan_by_class());
  const auto width = [](const CalibrationFit& fit) {
    const auto interval = *value_named(fit, "axial_4_Pa").confidence_95;
    return interval.second - interval.first;
  };
  EXPECT_GT(width(found.fit()), 2.0 * width(sound.fit()));
}

TEST(Calibration, AnOutlierIsNamedAndARobustLossBearsIt) {
  std::vector<FittedCurve> curves = noisy_curves(samples::truth(), 11);
  ASSERT_EQ(curves[2].load_case.kind, meshes::LoadCaseKind::bending);
  curves[2].reference[0][2] *= 3.0;
  CalibrationPlan plan = plan_by_class();
  const double truth = samples::truth().bending_Pa[closed_wall_class];
  const Calibration pulled = calibrate(samples::problem(curves), plan);
  plan.fit.loss_scale = 2.0;
  const Calibration robust = calibrate(samples::problem(curves), plan);
  ASSERT_EQ(robust.fit().status, io::RunStatus::completed);
  const auto outliers = outliers_of(curves, robust.fit());
  ASSERT_FALSE(outliers.empty());
  EXPECT_EQ(outliers[0].curve, 2U);
  EXPECT_EQ(outliers[0].row, 2U);
  EXPECT_EQ(outliers_of(curves, pulled.fit())[0].curve, 2U) << "the plain fit names the curve, too";
  // five per cent are three standard deviations of the ratio; the outlier alone pulls the plain fit further
  EXPECT_NEAR(robust.fit().parameters.bending_Pa[closed_wall_class], truth, 0.05 * truth);
  EXPECT_GT(std::abs(pulled.fit().parameters.bending_Pa[closed_wall_class] - truth), 0.1 * truth);
}

TEST(Calibration, AValueAtItsBoundIsReported) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 13));
  problem.bounds[Quantity::ground_stiffness] = {6000.0, 9000.0};  // the truth is 5000
  const Calibration found = calibrate(problem, plan_by_class());
  const FittedValue& value = value_named(found.fit(), "ground_stiffness_N_per_m");
  EXPECT_EQ(value.determination, Determination::at_bound);
  EXPECT_NEAR(value.value, 6000.0, 1e-6);
  EXPECT_FALSE(value.confidence_95);
  EXPECT_EQ(value_named(found.fit(), "axial_4_Pa").determination, Determination::determined);
}

TEST(Calibration, AStartWithoutEquilibriumIsPulledBack) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 15, 0.0));
  for (PressureLaw& law : problem.start.extension) law.slope_per_Pa = 2e-4;  // extension 3 at 15 kPa, where there is no response
  problem.bounds[Quantity::extension_slope] = {-1e-3, 1e-3};
  const Calibration found = calibrate(problem, plan_by_class());
  ASSERT_EQ(found.fit().status, io::RunStatus::completed) << found.fit().reason;
  EXPECT_LT(found.fit().chi2, 1e-3);
}

// Nothing has an response with lateral coupling, which the third detail begins with.
TEST(Calibration, ADetailThatCannotBeFittedLeavesThoseThatCan) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 15));
  problem.responder = [](const SurrogateParameters& p, const meshes::LoadCase& load_case, const Responder::States& states) {
    if (p.lateral_coupling > 0.0) return LoadCaseResponse{.status = io::RunStatus::not_converged, .columns = {}, .values = {}};
    return samples::closed_forms(p, load_case, states);
  };
  CalibrationPlan plan = plan_of(
      {CalibrationDetail::uniform, CalibrationDetail::stiffness, CalibrationDetail::lateral, CalibrationDetail::bulge_classes});
  for (const auto choice : {std::optional<CalibrationDetail>{}, std::optional(CalibrationDetail::bulge_classes)}) {
    plan.choice = choice;
    const Calibration found = calibrate(problem, plan);
    EXPECT_EQ(to_string(found.details()), "uniform + stiffness + bulge_classes");
    EXPECT_EQ(found.fit().status, io::RunStatus::completed);
    EXPECT_GT(found.fit().parameter_count, 0U);
    // who named the detail is told that it is not there; else it is one that did not pay
    EXPECT_EQ(found.ended().status, choice ? io::RunStatus::not_converged : io::RunStatus::completed);
    const std::vector<std::string> failed = failed_details(found);
    ASSERT_EQ(failed.size(), 1U);
    EXPECT_EQ(failed[0].find("detail lateral: not_converged, the surrogate has no equilibrium"), 0U) << failed[0];
  }
}

// Bulges by class begin in their rough proportions, here so large that there is no response until they are halved too often to
// come back; the fit before, with one bulge for all classes, is the truth.
TEST(Calibration, ADetailIsNeverWorseThanTheFitThatItHolds) {
  SurrogateParameters truth = samples::truth();
  truth.bulge.fill(truth.bulge[closed_wall_class]);
  truth.bulge_peak_ratio.fill(2.2);
  truth.axial_Pa.fill(truth.axial_Pa[closed_wall_class]);
  truth.bending_Pa.fill(truth.bending_Pa[closed_wall_class]);
  truth.torsion_Pa.fill(truth.torsion_Pa[closed_wall_class]);
  truth.extension.fill(truth.extension[closed_wall_class]);
  CalibrationProblem problem = samples::problem(noisy_curves(truth, 15));
  // responses only about the truth, but for a valley far away from it
  problem.responder = [&](const SurrogateParameters& p, const meshes::LoadCase& load_case, const Responder::States& states) {
    const double ratio = p.bulge[samples::corner_wall_class].slope_per_Pa / truth.bulge[samples::corner_wall_class].slope_per_Pa;
    if (ratio > 5.0 && ratio < 20.0) return LoadCaseResponse{.status = io::RunStatus::not_converged, .columns = {}, .values = {}};
    return samples::closed_forms(p, load_case, states);
  };
  CalibrationPlan plan = plan_of({CalibrationDetail::uniform, CalibrationDetail::stiffness, CalibrationDetail::bulge_classes});
  plan.choice = CalibrationDetail::bulge_classes;
  const Calibration found = calibrate(problem, plan);
  ASSERT_EQ(found.steps.size(), 3U);
  EXPECT_EQ(found.fit().status, io::RunStatus::completed) << found.fit().reason;
  EXPECT_LE(found.fit().chi2, found.steps[1].fit.chi2 * (1.0 + 1e-3));
}

TEST(Calibration, SaysWhereThereIsNoAnswerAtAll) {
  CalibrationProblem problem = samples::problem(noisy_curves(samples::truth(), 15));
  problem.responder = [](const SurrogateParameters&, const meshes::LoadCase&, const std::vector<std::vector<double>>&) {
    return LoadCaseResponse{.status = io::RunStatus::not_converged, .columns = {}, .values = {}};
  };
  const Calibration found = calibrate(problem, plan_of({CalibrationDetail::uniform}));
  EXPECT_EQ(found.fit().status, io::RunStatus::not_converged);
  EXPECT_NE(found.fit().reason.find("no equilibrium"), std::string::npos);
}

TEST(Calibration, StopsWhenAskedTo) {
  const std::atomic<bool> stop{true};
  CalibrationPlan plan;
  plan.fit.stop = &stop;
  const Calibration found = calibrate(samples::problem(noisy_curves(samples::truth(), 15)), plan);
  EXPECT_EQ(found.fit().status, io::RunStatus::stopped);
  EXPECT_EQ(found.steps.size(), 1U);
}

TEST(CalibrationRun, StoppedFitLeavesTheResultsOfAnEarlierOne) {
  CalibrationStudy study;
  for (const meshes::LoadCase& load_case : samples::load_cases())
    study.curves.push_back({.curve = samples::curve_of(load_case, samples::truth()), .file = {}, .hash = {}, .table_hash = {}});
  study.plan = plan_of({CalibrationDetail::uniform});
  const tests::TestFolder folder;
  CalibrationRunOptions options{.pictures = false};
  ASSERT_NE(run_calibration(study, samples::closed_forms, folder, options).calibration.ended().status, io::RunStatus::stopped);
  const auto texts = [&] {
    std::vector<std::string> found;
    for (const char* file : {"parameters.toml", "result.toml", "details.csv", "residuals.csv", "manifest.json"})
      found.push_back(io::read_whole(folder / file));
    return found;
  };
  const std::vector<std::string> earlier = texts();
  const std::atomic<bool> stop{true};
  options.stop = &stop;
  const CalibrationRunResult stopped = run_calibration(study, samples::closed_forms, folder, options);
  EXPECT_EQ(stopped.calibration.ended().status, io::RunStatus::stopped);
  EXPECT_EQ(texts(), earlier);
  const tests::TestFolder empty;
  (void)run_calibration(study, samples::closed_forms, empty, options);
  EXPECT_TRUE(std::filesystem::is_empty(empty.path()));
}

}  // namespace
}  // namespace menger::voxel
