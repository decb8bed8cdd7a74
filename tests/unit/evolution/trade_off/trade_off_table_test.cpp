#include "evolution/trade_off/trade_off_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "evolution/trade_off/trade_off_chart.h"
#include "io/text/toml_document.h"

namespace menger::evolution {
namespace {

TradeRow row(const std::string& label, double value, double seconds) {
  TradeRow made{.model = "voxels", .label = label};
  made.fidelity = {{"number", label}};
  made.values = {value};
  made.seconds = seconds;
  made.peak_megabytes = 10.0;
  made.status = "completed";
  return made;
}

/// A table with these errors, computed by hand, against a reference of 2: 50 %, 10 %, 20 %, 5 %, 5 %, none, 1 % (its own).
TradeTable table() {
  TradeTable made{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  made.rows = {row("a", 1.0, 1.0), row("b", 2.2, 2.0), row("c", 1.6, 3.0), row("d", 1.9, 4.0), row("e", 2.1, 5.0)};
  made.rows.push_back(row("failed", 0.0, 0.5));
  made.rows.back().values = {std::nullopt};
  made.rows.push_back(row("reference", 2.0, 100.0));
  compare_with_reference(made, 6, {0.01});
  return made;
}

TEST(TradeTable, ErrorsAreRelativeToTheReferenceAndItsOwnIsItsEstimate) {
  const TradeTable evaluated = table();
  const double rounding = 1e-12;
  EXPECT_NEAR(evaluated.rows[0].error.value(), 0.5, rounding);
  EXPECT_NEAR(evaluated.rows[1].error.value(), 0.1, rounding);
  EXPECT_NEAR(evaluated.rows[2].error.value(), 0.2, rounding);
  EXPECT_FALSE(evaluated.rows[5].error);
  EXPECT_EQ(evaluated.rows[6].error, 0.01);
}

TEST(TradeTable, TheLargestErrorCountsAndAMissingValueLeavesNone) {
  TradeTable evaluated{.observables = {"a_m", "b_m", "ratio"}, .fidelity_columns = {}};
  evaluated.rows = {row("1", 0, 1.0), row("2", 0, 1.0), row("reference", 0, 1.0)};
  evaluated.rows[0].values = {1.1, 2.8, 0.5};
  evaluated.rows[1].values = {1.1, std::nullopt, 0.5};
  evaluated.rows[2].values = {1.0, 2.0, 0.5};
  compare_with_reference(evaluated, 2, {std::nullopt, std::nullopt, std::nullopt});
  EXPECT_NEAR(evaluated.rows[0].error.value(), 0.4, 1e-12);
  EXPECT_FALSE(evaluated.rows[1].error);
  EXPECT_FALSE(evaluated.reference_error);
}

TEST(TradeTable, WhatBarelyMovesIsEvaluatedByATenthOfTheLargest) {
  TradeTable evaluated{.observables = {"a_m", "b_m"}, .fidelity_columns = {}};
  evaluated.rows = {row("1", 0, 1.0), row("reference", 0, 1.0)};
  evaluated.rows[0].values = {1.1, 5e-4};
  evaluated.rows[1].values = {1.0, 1e-6};
  compare_with_reference(evaluated, 1, {0.0, 3.0});
  EXPECT_NEAR(evaluated.rows[0].errors[0].value(), 0.1, 1e-12);
  EXPECT_NEAR(evaluated.rows[0].errors[1].value(), (5e-4 - 1e-6) / 0.1, 1e-12);
  EXPECT_NEAR(evaluated.reference_error.value(), 3.0 * 1e-6 / 0.1, 1e-12);
}

TEST(TradeTable, WhereNothingMovesThereIsNoError) {
  TradeTable evaluated{.observables = {"a_m"}, .fidelity_columns = {}};
  evaluated.rows = {row("1", 0.0, 1.0), row("reference", 0.0, 1.0)};
  compare_with_reference(evaluated, 1, {std::nullopt});
  EXPECT_FALSE(evaluated.rows[0].error);
  EXPECT_NE(recommendation_text(evaluated, {0.1}).find("no errors can be given"), std::string::npos);
}

TEST(TradeTable, FrontHoldsWhatNothingBeatsInBothTimeAndError) {
  EXPECT_EQ(pareto_front(table()), (std::vector<std::size_t>{0, 1, 3, 6}));
}

TEST(TradeTable, EqualRowsStandOnTheFrontOnce) {
  TradeTable evaluated{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  evaluated.rows = {row("a", 1.0, 1.0), row("b", 1.0, 1.0), row("reference", 2.0, 3.0)};
  compare_with_reference(evaluated, 2, {std::nullopt});
  EXPECT_EQ(pareto_front(evaluated), (std::vector<std::size_t>{0}));
}

TEST(TradeTable, RecommendsTheCheapestThatIsGoodEnough) {
  const std::vector<Recommendation> found = recommendations(table(), {0.6, 0.12, 0.08, 0.02, 0.005});
  ASSERT_EQ(found.size(), 5U);
  EXPECT_EQ(found[0].row, 0U);
  EXPECT_EQ(found[1].row, 1U);
  EXPECT_EQ(found[2].row, 3U);
  EXPECT_EQ(found[3].row, 6U);
  EXPECT_FALSE(found[4].row);
}

TEST(TradeTable, NothingIsRecommendedForLessThanTheReferenceIsKnownTo) {
  TradeTable evaluated{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  evaluated.rows = {row("a", 2.02, 1.0), row("reference", 2.0, 3.0)};  // 1 % from a reference with an error of 10 %
  compare_with_reference(evaluated, 1, {0.1});
  EXPECT_FALSE(recommendations(evaluated, {0.05})[0].row);
  EXPECT_EQ(recommendations(evaluated, {0.1})[0].row, 0U);
}

TEST(TradeTable, CostIsProcessorTimeIfThatOfAllRunsIsKnown) {
  TradeTable busy = table();
  busy.rows[3].cpu_seconds = 0.8;  // 4 s of wall time beside other work
  EXPECT_EQ(recommendations(busy, {0.12})[0].row, 1U) << "processor and wall times are not ranked against each other";
  for (TradeRow& one : busy.rows)
    if (!one.cpu_seconds) one.cpu_seconds = one.seconds;
  EXPECT_EQ(recommendations(busy, {0.12})[0].row, 3U);
  EXPECT_EQ(pareto_front(busy).front(), 3U);
  EXPECT_NE(recommendation_text(busy, {0.12}).find("it costs 0.8 s of a core and 10 MB"), std::string::npos)
      << recommendation_text(busy, {0.12});
  EXPECT_EQ(trade_panel(busy, "busy").x.title.substr(0, 14), "processor time");
}

TEST(TradeTable, RecommendationSaysWhatItCostsAndWhyThereIsNone) {
  const std::string text = recommendation_text(table(), {0.12, 0.005});
  EXPECT_NE(text.find("for 12 % you need voxels, b (10 % from the reference), it costs 2 s and 10 MB"), std::string::npos)
      << text;
  EXPECT_NE(text.find("for 0.5 % no run is accurate enough: the reference itself is known to 1 % only"), std::string::npos)
      << text;
}

TEST(TradeTable, RecommendationIsReadableToml) {
  const io::TomlTable read = io::parse_toml(recommendation_toml(table(), {0.12, 0.005}, "recommendation"), "text.toml");
  const auto entries = read.tables("recommendation");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_TRUE(entries[0].boolean("found"));
  EXPECT_EQ(entries[0].text("number"), "b");
  EXPECT_EQ(entries[0].number("seconds"), 2.0);
  EXPECT_FALSE(entries[1].boolean("found"));
}

TEST(TradeTable, CsvHoldsEveryRowWithItsRole) {
  const io::CsvContents csv = io::parse_csv(trade_csv(table()).text(), "tradeoff.csv");
  ASSERT_EQ(csv.row_count(), 7U);
  EXPECT_EQ(csv.text(0, "role"), "front");
  EXPECT_EQ(csv.text(2, "role"), "");
  EXPECT_EQ(csv.text(6, "role"), "reference, front");
  EXPECT_EQ(csv.text(5, "length_m"), "");
  EXPECT_NEAR(csv.number(1, "relative_error"), 0.1, 1e-12);
  EXPECT_EQ(csv.number(1, "reference_relative_error"), 0.01);
}

TEST(TradeTable, PanelHoldsAPointForEveryRowWithAnErrorAndTheFront) {
  const io::ChartPanel panel = trade_panel(table(), "title");
  std::size_t points = 0;
  std::size_t on_front = 0;
  double level = 0.0;
  for (const io::ChartSeries& series : panel.series) {
    if (series.name == "the reference's own error") {
      level = series.y.front();
    } else {
      (series.name == "Pareto front" ? on_front : points) += series.x.size();
    }
  }
  EXPECT_EQ(points, 6U);
  EXPECT_EQ(on_front, 4U);
  EXPECT_NEAR(level, 1.0, 1e-12);
}

TEST(TradeTable, GainsBelowWhatIsKnownAreNeitherOnTheFrontNorRecommended) {
  // 10 %, then 9.95 % (a negligible gain), 1.5 % and 0.5 %; the last two are below the reference's own 2 %
  TradeTable evaluated{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  evaluated.rows = {row("a", 2.2, 1.0), row("b", 2.199, 2.0), row("c", 2.03, 3.0), row("d", 2.01, 4.0),
                    row("reference", 2.0, 5.0)};
  compare_with_reference(evaluated, 4, {0.02});
  EXPECT_EQ(pareto_front(evaluated), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(recommendations(evaluated, {0.021})[0].row, 2U);
  EXPECT_FALSE(recommendations(evaluated, {0.01})[0].row);
}

TEST(TradeTable, PointsThatAreAllAlikeStandWithinADecade) {
  TradeTable evaluated{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  evaluated.rows = {row("a", 2.2, 2.0), row("b", 2.2 + 1e-12, 3.0), row("reference", 2.0, 5.0)};
  compare_with_reference(evaluated, 2, {std::nullopt});
  const io::ChartPanel panel = trade_panel(evaluated, "title");
  EXPECT_NEAR(panel.x.lowest.value(), 1.0, 1e-12);
  EXPECT_NEAR(panel.x.highest.value(), 10.0, 1e-12);
  EXPECT_GE(panel.y.highest.value() / panel.y.lowest.value(), 9.9);
  EXPECT_EQ(panel.x.title, "wall time (s)");
  EXPECT_EQ(panel.y.title, "largest error of the observables (%)");
}

TEST(TradeTable, PanelSaysWherePointsAreNotDrawnAtTheirPlace) {
  TradeTable evaluated{.observables = {"length_m"}, .fidelity_columns = {"number"}};
  evaluated.rows = {row("a", 2.2, 2.0), row("b", 2.0 + 1e-9, 1e-5), row("reference", 2.0, 5.0)};
  compare_with_reference(evaluated, 2, {std::nullopt});
  const io::ChartPanel panel = trade_panel(evaluated, "title");
  EXPECT_EQ(panel.x.title, "wall time (s); shorter ones are drawn as 0.001");
  EXPECT_EQ(panel.y.title, "largest error of the observables (%); smaller ones are drawn as 0.0001");
}

}  // namespace
}  // namespace menger::evolution
