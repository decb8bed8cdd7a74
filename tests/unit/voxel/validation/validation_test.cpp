#include "voxel/validation/validation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/voxel/validation/validation_samples.h"
#include "voxel/validation/validation_charts.h"
#include "voxel/validation/validation_summary.h"
#include "voxel/validation/validation_tables.h"

namespace menger::voxel {
namespace {

using meshes::LoadCaseKind;
using samples::bar_curve;
using samples::responding;
using samples::validation_parameters;

// Sums and quotients of a few numbers of order one.
constexpr double rounding = 1e-12;

/// Pressure, force, change of volume.
const std::vector<std::vector<double>> blocked_table{{0.0, 1e3, 2e3}, {0.0, -0.1, -0.4}, {0.0, 0.02, 0.05}};

const ObservableError& error_of(const CurveComparison& comparison, const std::string& observable, double pressure_Pa) {
  const auto found = std::find_if(comparison.errors.begin(), comparison.errors.end(), [&](const ObservableError& error) {
    return error.observable == observable && error.pressure_Pa == pressure_Pa;
  });
  if (found == comparison.errors.end()) throw std::out_of_range(observable);
  return *found;
}

void expect_begin(const std::string& text, const std::string& beginning) { EXPECT_TRUE(text.starts_with(beginning)) << text; }

TEST(Validation, TakesErrorsByTheLargestMagnitudeOfTheObservableInItsCurve) {
  std::vector<std::vector<double>> response = blocked_table;
  response[1] = {0.0, -0.12, -0.3};
  response[2] = {0.0, 0.025, 0.05};
  const CurveComparison comparison = compare(bar_curve("bar_blocked", LoadCaseKind::blocked, blocked_table), "bar",
                                             validation_parameters(), responding(response));
  ASSERT_EQ(comparison.errors.size(), 4U) << "the state at rest says nothing";
  EXPECT_NEAR(error_of(comparison, "force_N", 1e3).error, -0.02 / 0.4, rounding);
  EXPECT_NEAR(error_of(comparison, "force_N", 1e3).pointwise_error.value(), -0.02 / 0.1, rounding);
  EXPECT_NEAR(error_of(comparison, "force_N", 2e3).error, 0.1 / 0.4, rounding);
  EXPECT_NEAR(error_of(comparison, "volume_change", 1e3).error, 0.1, rounding);
  EXPECT_EQ(error_of(comparison, "volume_change", 1e3).kind, ObservableKind::volume);
  EXPECT_TRUE(comparison.without_equilibrium.empty());
}

TEST(Validation, DrawsCurvesThatCoincideInBothModelsAsOne) {
  const std::vector<std::vector<double>> table{{1e3, 2e3},          {0.1, 0.2},   {1e-3, 2e-3},
                                               {1e-3, 2.000001e-3}, {1e-3, 2e-3}, {1e-4, 3e-4}};
  std::vector<std::vector<double>> response = table;
  response[4] = {1e-3, 1e-3};
  const io::Chart chart = curve_chart(
      compare(bar_curve("bar", LoadCaseKind::inflation, table), "bar", validation_parameters(), responding(response)));
  ASSERT_EQ(chart.panels.size(), 2U);
  const std::vector<io::ChartSeries>& series = chart.panels[1].series;
  ASSERT_EQ(series.size(), 6U);
  EXPECT_EQ(series[0].name, "extent x, extent y");
  EXPECT_EQ(series[2].name, "extent z") << "the surrogate tells it apart";
  EXPECT_EQ(series[4].name, "top");
}

TEST(Validation, DoesNotBlowUpAnObservableThatHardlyAnswers) {
  // The top stays within a ten-thousandth of what the extents do: its scale is a hundredth of theirs.
  const std::vector<std::vector<double>> table{{1e3}, {0.1}, {1e-3}, {1e-3}, {1e-3}, {1e-7}};
  std::vector<std::vector<double>> response = table;
  response[5] = {2e-6};
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::inflation, table), "bar", validation_parameters(), responding(response));
  EXPECT_NEAR(error_of(comparison, "top_m", 1e3).error, 1.9e-6 / 1e-5, rounding);
}

TEST(Validation, CountsDisplacementsThatGoTheWrongWay) {
  // Of extents x (right), y (wrong at the second pressure), z (too small to have a sign) and of the top (wrong).
  const std::vector<std::vector<double>> table{{1e3, 2e3},     {0.1, 0.2},     {1e-3, 2e-3},
                                               {-3e-4, -1e-3}, {1e-4, 1.9e-4}, {1e-4, 3e-4}};
  std::vector<std::vector<double>> response = table;
  response[3] = {-1e-5, 1e-3};
  response[4] = {-1e-4, -1.9e-4};
  response[5] = {-1e-4, 0.0};
  const std::vector<CurveComparison> comparisons{
      compare(bar_curve("bar", LoadCaseKind::inflation, table), "bar", validation_parameters(), responding(response))};
  const std::vector<SignCount> expected{{.body = "bar", .observable = "extent_x_m", .count = 2, .wrong = 0},
                                        {.body = "bar", .observable = "extent_y_m", .count = 2, .wrong = 1},
                                        {.body = "bar", .observable = "top_m", .count = 1, .wrong = 1}};
  EXPECT_EQ(count_signs(comparisons), expected);
  EXPECT_EQ(sign_sentence(comparisons, true),
            "sign: 3 of 5 displacements that are at least 0.2 mm go the right way (the way of smaller ones is not judged); the "
            "wrong way: bar extent_y_m (1 of 2), bar top_m (1 "
            "of 1)");
  EXPECT_EQ(sign_sentence(comparisons, false), "");
  std::vector<CurveComparison> beyond = comparisons;
  for (ObservableError& error : beyond[0].errors) error.validity = Validity::size;
  EXPECT_EQ(sign_sentence(beyond, true), "") << "0 of 0 would sound as if none went the wrong way";
  expect_begin(sign_sentence(beyond, false), "sign, outside the range of validity: 3 of 5 displacements");
  expect_begin(furthest_sentence(beyond), "furthest off, outside the range of validity: 2 mm");
  EXPECT_EQ(signs_table(beyond).row_count(), 3U);
}

TEST(Validation, LeavesOutWhatIsZeroThroughout) {
  const std::vector<std::vector<double>> table{{1e3}, {-0.2}, {0.0}};
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::blocked, table), "bar", validation_parameters(), responding(table));
  ASSERT_EQ(comparison.errors.size(), 1U);
  EXPECT_EQ(comparison.errors[0].observable, "force_N");
}

TEST(Validation, TakesStiffnessFromTheSlopeAtEachPressure) {
  // Forces 100 u + 0.3 and 80 u at two pressures; the surrogate has 110 u + 0.2 and 60 u.
  const std::vector<double> pressures{0.0, 0.0, 0.0, 4e3, 4e3};
  const std::vector<double> imposed{-1e-3, 0.0, 1e-3, 0.0, 1e-3};
  const std::vector<double> forces{0.2, 0.3, 0.4, 0.0, 0.08};
  const std::vector<double> responses{0.09, 0.2, 0.31, 0.0, 0.06};
  const CurveComparison comparison = compare(bar_curve("bar", LoadCaseKind::shear, {pressures, imposed, forces}), "bar",
                                             validation_parameters(), responding({pressures, imposed, responses}));
  const ObservableError& relaxed = error_of(comparison, "stiffness_N_per_m", 0.0);
  EXPECT_NEAR(relaxed.reference, 100.0, 1e-9);
  EXPECT_NEAR(relaxed.surrogate, 110.0, 1e-9);
  EXPECT_NEAR(relaxed.error, 0.1, rounding);
  EXPECT_EQ(relaxed.kind, ObservableKind::stiffness);
  const ObservableError& driven = error_of(comparison, "stiffness_N_per_m", 4e3);
  EXPECT_NEAR(driven.error, (60.0 - 80.0) / 100.0, rounding);
  EXPECT_NEAR(driven.pointwise_error.value(), -0.25, rounding);
}

TEST(Validation, ComparesFrequenciesOfTheBodyAtRest) {
  const std::vector<std::vector<double>> table{{0.0}, {20.0}, {25.0}, {60.0}};
  const CurveComparison comparison = compare(bar_curve("bar", LoadCaseKind::modes, table), "bar", validation_parameters(),
                                             responding({{0.0}, {22.0}, {25.0}, {60.0}}));
  ASSERT_EQ(comparison.errors.size(), 3U);
  EXPECT_NEAR(comparison.errors[0].error, 0.1, rounding);
  EXPECT_EQ(comparison.errors[0].kind, ObservableKind::frequency);
  EXPECT_EQ(comparison.errors[1].kind, ObservableKind::higher_frequency);
}

TEST(Validation, TellsWhichNumbersHaveNoAnswer) {
  const CurveComparison some = compare(bar_curve("bar", LoadCaseKind::blocked, blocked_table), "bar", validation_parameters(),
                                       responding({{0.0, 1e3}, {0.0, -0.1}, {0.0, 0.02}}, 0.1, io::RunStatus::not_converged));
  EXPECT_EQ(some.errors.size(), 2U);
  EXPECT_EQ(some.without_equilibrium, (std::vector<UndeterminedNumber>{{ObservableKind::force, Validity::inside},
                                                                       {ObservableKind::volume, Validity::inside}}));
  const CurveComparison none = compare(bar_curve("bar", LoadCaseKind::blocked, blocked_table), "bar", validation_parameters(),
                                       responding({}, 0.1, io::RunStatus::not_converged));
  EXPECT_EQ(none.without_equilibrium.size(), 4U);
  EXPECT_NE(summary_table({none}).text().find("all,force,inside,0,2,,,,,,"), std::string::npos) << summary_table({none}).text();
}

TEST(Validation, MarksWhatTheParametersSayNothingOf) {
  const auto first_validity = [](const meshes::ResponseCurve& curve, double largest_strain = 0.1) {
    return compare(curve, "bar", validation_parameters(), responding(curve.values, largest_strain)).errors.back().validity;
  };
  meshes::ResponseCurve curve = bar_curve("bar", LoadCaseKind::blocked, {{8e3}, {-0.4}, {0.1}});
  EXPECT_EQ(first_validity(curve), Validity::inside);
  EXPECT_EQ(first_validity(curve, 0.6), Validity::strain);
  curve.values[0] = {8.1e3};
  EXPECT_EQ(first_validity(curve), Validity::pressure);
  curve.values[0] = {-5.1e3};
  EXPECT_EQ(first_validity(curve), Validity::pressure);
  curve.provenance.load_case.level = 2;
  EXPECT_EQ(first_validity(curve), Validity::pressure) << "modules are checked alone";
  curve.provenance.load_case.cells = {4, 1, 1};
  curve.provenance.load_case.digits = "1111";
  EXPECT_EQ(first_validity(curve), Validity::size);
  curve.provenance.load_case.per_phase = true;
  EXPECT_EQ(first_validity(curve), Validity::chambers);
}

TEST(Validation, BlamesStrainOnlyOnTheStatesThatHaveIt) {
  const Responder responder = [](const SurrogateParameters&, const meshes::LoadCase& load_case,
                                 const std::vector<std::vector<double>>& states) {
    LoadCaseResponse response;
    response.columns = meshes::response_columns(load_case.kind);
    response.values = states.size() == 3 ? blocked_table : std::vector<std::vector<double>>{{1.0}, {1.0}, {1.0}};
    for (const auto& state : states) response.largest_strain = std::max(response.largest_strain, 4e-4 * state[0]);
    return response;
  };
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::blocked, blocked_table), "bar", validation_parameters(), responder);
  EXPECT_EQ(error_of(comparison, "force_N", 1e3).validity, Validity::inside);
  EXPECT_EQ(error_of(comparison, "force_N", 2e3).validity, Validity::strain);
}

TEST(Validation, DoesNotBlameStrainForAMissingAnswer) {
  // the state that has an response leaves the range of strains; what the other would do to the beams nobody knows
  const Responder responder = [](const SurrogateParameters&, const meshes::LoadCase& load_case,
                                 const std::vector<std::vector<double>>& states) {
    LoadCaseResponse response;
    response.columns = meshes::response_columns(load_case.kind);
    response.status = io::RunStatus::not_converged;
    response.largest_strain = 0.9;
    response.values = {{0.0, 1e3}, {0.0, -0.1}, {0.0, 0.02}};
    if (states.size() == 1) response.values = {{}, {}, {}};
    return response;
  };
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::blocked, blocked_table), "bar", validation_parameters(), responder);
  ASSERT_EQ(comparison.without_equilibrium.size(), 2U);
  EXPECT_EQ(comparison.without_equilibrium[0].validity, Validity::inside);
}

/// An response ends where walls touch, beyond -1 kPa, and what comes after has none.
LoadCaseResponse touching_walls(const SurrogateParameters&, const meshes::LoadCase& load_case,
                                const std::vector<std::vector<double>>& states) {
  LoadCaseResponse response;
  response.columns = meshes::response_columns(load_case.kind);
  response.values.resize(3);
  for (const auto& state : states) {
    if (state[0] < -1e3) {
      response.status = io::RunStatus::wall_contact;
      break;
    }
    response.values[0].push_back(state[0]);
    response.values[1].push_back(-1e-4 * state[0]);
    response.values[2].push_back(2e-5 * state[0]);
  }
  return response;
}

TEST(Validation, KeepsTheAnswersUnderPressureWhereVacuumHasNone) {
  const std::vector<std::vector<double>> table{{-2e3, -1e3, 0.0, 2e3}, {0.2, 0.1, 0.0, -0.1}, {-0.04, -0.02, 0.0, 0.04}};
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::blocked, table), "bar", validation_parameters(), touching_walls);
  EXPECT_EQ(comparison.response.status, io::RunStatus::wall_contact);
  EXPECT_EQ(comparison.without_equilibrium.size(), 2U) << "of the first state";
  EXPECT_NEAR(error_of(comparison, "force_N", -1e3).error, 0.0, rounding);
  EXPECT_NEAR(error_of(comparison, "force_N", 2e3).error, -0.1 / 0.2, rounding);
}

TEST(Validation, KeepsTheAnswersUnderMildVacuumWhereDeepVacuumHasNone) {
  const std::vector<std::vector<double>> table{{-2e3, -1e3, -5e2}, {0.2, 0.1, 0.05}, {-0.04, -0.02, -0.01}};
  const CurveComparison comparison =
      compare(bar_curve("bar", LoadCaseKind::blocked, table), "bar", validation_parameters(), touching_walls);
  EXPECT_EQ(comparison.response.status, io::RunStatus::wall_contact);
  EXPECT_EQ(comparison.without_equilibrium.size(), 2U) << "of the deepest state";
  EXPECT_NEAR(error_of(comparison, "force_N", -1e3).error, 0.0, rounding);
  EXPECT_NEAR(error_of(comparison, "force_N", -5e2).error, 0.0, rounding);
}

TEST(Validation, JudgesByTheClaimsItIsGiven) {
  const std::vector<std::vector<double>> table{{-2e3, -5e2, 1e3}, {0.2, 0.05, -0.1}, {-0.04, -0.01, 0.02}};
  const CurveComparison comparison = compare(bar_curve("bar", LoadCaseKind::blocked, table), "bar", validation_parameters(),
                                             touching_walls, std::vector{Validity::size, Validity::inside, Validity::strain});
  ASSERT_EQ(comparison.without_equilibrium.size(), 2U);
  EXPECT_EQ(comparison.without_equilibrium[0].validity, Validity::size);
  EXPECT_EQ(error_of(comparison, "force_N", -5e2).validity, Validity::inside);
  EXPECT_EQ(error_of(comparison, "force_N", 1e3).validity, Validity::strain);
}

TEST(Validation, NamesBodiesAfterTheirCases) {
  std::vector<meshes::ResponseCurve> curves{
      bar_curve("bar3_inflation", LoadCaseKind::inflation, {}), bar_curve("stretch-long", LoadCaseKind::stretch, {}),
      bar_curve("modes", LoadCaseKind::modes, {}), bar_curve("bar3_blocked", LoadCaseKind::blocked, {})};
  curves[2].provenance.load_case.digits = "110";
  curves[3].provenance.load_case.digits = "121";
  EXPECT_EQ(body_names(curves), (std::vector<std::string>{"bar3+long", "bar3+long", "modes", "bar3_blocked_4"}));
}

TEST(Validation, NamesABodyWithSeveralNamesByWhatTheyShare) {
  const std::vector<std::vector<double>> table{{0.0}, {0.0}, {0.0}};
  const auto names_of = [&](const std::vector<std::string>& cases) {
    std::vector<meshes::ResponseCurve> curves;
    for (const std::string& name : cases) curves.push_back(bar_curve(name, LoadCaseKind::blocked, table));
    return body_names(curves);
  };
  EXPECT_EQ(names_of({"bar_low_blocked", "bar_high_blocked"}), (std::vector<std::string>{"bar", "bar"}));
  EXPECT_EQ(names_of({"bar_blocked", "beam_blocked"}), (std::vector<std::string>{"bar+beam", "bar+beam"}));
  EXPECT_EQ(names_of({"bar_blocked", "barrel_blocked"}), (std::vector<std::string>{"bar+barrel", "bar+barrel"}));
  EXPECT_EQ(names_of({"bar_blocked", "bar_again_blocked"}), (std::vector<std::string>{"bar", "bar"}));
}

TEST(ValidationSummary, InterpolatesQuantiles) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_NEAR(quantile(values, 0.0), 1.0, rounding);
  EXPECT_NEAR(quantile(values, 0.5), 2.5, rounding);
  EXPECT_NEAR(quantile(values, 0.9), 3.7, rounding);
  EXPECT_NEAR(quantile(values, 1.0), 4.0, rounding);
  EXPECT_NEAR(quantile({7.0}, 0.9), 7.0, rounding);
}

TEST(ValidationSummary, TakesMissingValuesAsLargerThanAllOthers) {
  const std::vector<double> values{1.0, 2.0, 3.0};
  EXPECT_NEAR(quantile(values, 0.5, 0).value(), 2.0, rounding);
  EXPECT_NEAR(quantile(values, 0.5, 1).value(), 2.5, rounding) << "of four values, the last unknown";
  EXPECT_NEAR(quantile(values, 0.5, 2).value(), 3.0, rounding) << "the last that is known";
  EXPECT_FALSE(quantile(values, 0.5, 3).has_value()) << "between a known one and an unknown one";
  EXPECT_FALSE(quantile(values, 1.0, 1).has_value());
  EXPECT_FALSE(quantile({}, 0.5, 0).has_value());
}

/// Changes of volume of 1 at pressures 1 ... n Pa and errors of them.
CurveComparison with_errors(const std::string& body, const std::vector<double>& errors, Validity validity = Validity::inside) {
  CurveComparison comparison;
  comparison.curve = bar_curve(body + "_blocked", LoadCaseKind::blocked, {});
  comparison.body = body;
  for (const double error : errors) {
    comparison.errors.push_back({.kind = ObservableKind::volume,
                                 .observable = "volume_change",
                                 .pressure_Pa = static_cast<double>(comparison.errors.size() + 1),
                                 .reference = 1.0,
                                 .surrogate = 1.0 + error,
                                 .error = error,
                                 .pointwise_error = error,
                                 .validity = validity});
  }
  return comparison;
}

TEST(ErrorsChart, ShowsWhatLiesOutsideTheRangeOnlyWhereNothingLiesInside) {
  const CurveComparison inside = with_errors("a", {0.01, -0.03});
  const CurveComparison outside = with_errors("b", {0.9, -1.2}, Validity::pressure);
  const io::Chart both = errors_chart({inside, outside}, 0.1);
  EXPECT_EQ(both.title, "surrogate against finite elements, inside the range of validity");
  ASSERT_EQ(both.panels.size(), 3U);
  ASSERT_EQ(both.panels[2].series.size(), 1U);
  EXPECT_EQ(both.panels[2].series[0].name, "a");
  EXPECT_EQ(both.panels[1].title, "error in displacement") << "there is none";
  const io::Chart alone = errors_chart({outside}, 0.1);
  EXPECT_EQ(alone.title, "surrogate against finite elements, all outside the range of validity: nothing was compared inside");
  EXPECT_EQ(alone.panels[2].title, "error in volume, outside the range of validity");
  ASSERT_EQ(alone.panels[2].series.size(), 1U);
  EXPECT_EQ(alone.panels[2].series[0].y.size(), 2U);
  EXPECT_TRUE(errors_chart({}, 0.1).panels[2].series.empty());
}

TEST(ValidationSummary, KeepsWhatLiesOutsideTheRangeApart) {
  const std::vector<CurveComparison> comparisons{with_errors("a", {0.01, -0.03, 0.02}),
                                                 with_errors("b", {0.9, -1.2}, Validity::pressure), with_errors("c", {-0.05})};
  const std::vector<ErrorSummary> summaries = summarise(comparisons);
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_TRUE(summaries[0].inside);
  EXPECT_EQ(summaries[0].count, 4U);
  EXPECT_NEAR(summaries[0].median.value(), 0.025, rounding);
  EXPECT_NEAR(summaries[0].worst.value(), 0.05, rounding);
  EXPECT_EQ(summaries[0].worst_body, "c");
  EXPECT_FALSE(summaries[1].inside);
  EXPECT_NEAR(summaries[1].worst.value(), 1.2, rounding);
  EXPECT_EQ(summarise(comparisons, "a")[0].count, 3U);

  const ErrorPlace worst = worst_error(comparisons).value();
  EXPECT_EQ(worst.comparison, 2U) << "the larger errors lie outside the range";
  EXPECT_EQ(worst_error({comparisons[1]}).value().error, 1U);
  EXPECT_FALSE(worst_error({}).has_value());
}

/// The displacement of one observable in a bar of 30 mm: 2.5 times its small largest value off.
CurveComparison with_displacements() {
  CurveComparison comparison;
  comparison.curve = bar_curve("bar_inflation", LoadCaseKind::inflation, {});
  comparison.body = "bar";
  const auto add = [&](const std::string& observable, double pressure_Pa, double reference, double surrogate, double scale,
                       Validity validity) {
    comparison.errors.push_back({.kind = ObservableKind::displacement,
                                 .observable = observable,
                                 .pressure_Pa = pressure_Pa,
                                 .reference = reference,
                                 .surrogate = surrogate,
                                 .error = (surrogate - reference) / scale,
                                 .pointwise_error = std::nullopt,
                                 .validity = validity});
  };
  add("extent_y_m", 1e3, -0.0004, 0.0006, 0.0004, Validity::inside);  // 1 mm, 250 %
  add("top_m", 1e3, 0.008, 0.006, 0.008, Validity::inside);           // 2 mm, 25 %
  add("top_m", 2e3, 0.016, 0.011, 0.016, Validity::pressure);         // 5 mm, outside
  return comparison;
}

TEST(ValidationSummary, FindsTheStateThatIsFurthestOffInLengthsNotInShares) {
  const std::vector<CurveComparison> comparisons{with_errors("a", {3.0}), with_displacements()};
  const ErrorPlace place = furthest_off(comparisons).value();
  EXPECT_EQ(place.comparison, 1U);
  EXPECT_EQ(place.error, 1U) << "the largest error in per cent is that of extent_y_m, or of the volume of the other body";
  const FurthestDisplacement furthest = furthest_displacement(comparisons, place);
  EXPECT_EQ(furthest.observable, "top_m");
  EXPECT_NEAR(furthest.difference_m, 0.002, rounding);
  EXPECT_NEAR(furthest.share, 0.002 / 0.03, rounding);
  EXPECT_NEAR(furthest.error, 0.25, rounding);
  EXPECT_EQ(furthest_off({with_errors("a", {0.1, 0.3})}).value().error, 1U) << "without displacements the worst error";
  EXPECT_FALSE(furthest_off({}).has_value());
  EXPECT_EQ(
      furthest_sentence(comparisons),
      "furthest off: 2 mm, 6.67 % of the length of the body (bar top_m at 1 kPa, 25 % of the largest in its curve); the worst "
      "in per cent of its curve, 250 %, is 1 mm (bar extent_y_m); the median is 1.5 mm");
  EXPECT_EQ(furthest_sentence({with_errors("a", {0.1})}), "");
  const std::string table = summary_table(comparisons).text();
  EXPECT_NE(table.find(",worst_observable,median_m,worst_m,furthest_body,furthest_observable,furthest_pressure_Pa,furthest_m,"
                       "furthest_share,furthest_error\n"),
            std::string::npos);
  EXPECT_NE(table.find(",extent_y_m,0.0015,0.001,bar,top_m,1000,0.002,"), std::string::npos) << table;
}

TEST(ValidationSummary, ComparesBodiesByTheirLength) {
  std::vector<CurveComparison> comparisons{with_displacements(), with_displacements()};
  comparisons[0].curve.provenance.load_case.level = 2;  // 90 mm long
  comparisons[0].errors[1].surrogate = 0.004;           // 4 mm are less of it than 2 mm of the other
  EXPECT_EQ(furthest_off(comparisons).value().comparison, 1U);
}

TEST(ValidationSummary, JudgesMediansAndNamesTheBodiesThatMiss) {
  const std::vector<CurveComparison> comparisons{with_errors("a", {0.01, 0.02, 0.03}), with_errors("b", {0.2}),
                                                 with_errors("c", {-0.3}), with_errors("d", {5.0}, Validity::size)};
  const std::vector<AimOutcome> outcomes = assess(comparisons, 0.1);
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_FALSE(outcomes[0].median.has_value()) << "no displacement was compared";
  EXPECT_NEAR(outcomes[1].median.value(), 0.03, rounding);
  EXPECT_TRUE(outcomes[1].met);
  EXPECT_EQ(outcomes[1].bodies_beyond, (std::vector<std::string>{"c", "b"}));
  EXPECT_FALSE(assess(comparisons, 0.015)[1].met);
  const std::vector<std::string> sentences = aim_sentences(comparisons, 0.015);
  EXPECT_NE(sentences[0].find("no value was compared"), std::string::npos);
  EXPECT_EQ(sentences[1].rfind("volume: median error 3 %, aim 1.5 %: missed; bodies that miss the aim: c, b, a", 0), 0U)
      << sentences[1];
}

TEST(ValidationSummary, CountsNumbersWithoutAnswerAsMissed) {
  std::vector<CurveComparison> comparisons{with_errors("a", {0.01, 0.02, 0.03})};
  comparisons[0].without_equilibrium.assign(3, {ObservableKind::volume, Validity::inside});
  const AimOutcome missed = assess(comparisons, 0.1)[1];
  EXPECT_FALSE(missed.median.has_value()) << "half of the six have no equilibrium";
  EXPECT_FALSE(missed.met);
  EXPECT_EQ(missed.undetermined_inside, 3U);
  EXPECT_EQ(missed.bodies_beyond, std::vector<std::string>{"a"});
  const std::string sentence = aim_sentences(comparisons, 0.1)[1];
  EXPECT_NE(sentence.find("missed; no equilibrium inside the range (counted as missed): 3 of 6 values"), std::string::npos)
      << sentence;

  comparisons[0].without_equilibrium.assign(3, {ObservableKind::volume, Validity::pressure});
  const AimOutcome met = assess(comparisons, 0.1)[1];
  EXPECT_TRUE(met.met) << "nothing is claimed outside the range";
  EXPECT_EQ(met.undetermined_outside, 3U);
  EXPECT_NE(aim_sentences(comparisons, 0.1)[1].find("met; no equilibrium outside the range (not counted): 3"), std::string::npos);
}

TEST(ValidationTables, HoldOneRowPerNumberAndPerKind) {
  const std::vector<CurveComparison> comparisons{with_errors("a", {0.01, -0.03}), with_errors("b", {0.9}, Validity::pressure)};
  EXPECT_EQ(errors_table(comparisons).row_count(), 3U);
  EXPECT_NE(errors_table(comparisons).text().find("b_blocked,b,volume,volume_change,1,,1,1.9,0.9,0.9,pressure\n"),
            std::string::npos);
  EXPECT_EQ(summary_table(comparisons).row_count(), 4U) << "two for all bodies, one for each";
  const std::vector<std::string> lines = summary_lines(comparisons);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].find("worst body"), lines[1].find('a', lines[1].find('%')));
}

}  // namespace
}  // namespace menger::voxel
