#include "evolution/reevaluation/search_comparison.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

const std::string reevaluation_header = "rank,surrogate_body_lengths,elements_body_lengths,elements_steps,elements_count\n";

/// Folders with the tables of menger export and menger reevaluate.
class SearchComparison : public testing::Test {
 protected:
  SearchComparison() {
    io::write_whole(folder_ / "both_1/costs.csv",
                    "generation,voxel_steps,element_steps\n0,1000,0\n1,500,0\n2,500,300\n3,100,100\n");
    io::write_whole(folder_ / "both_1/reevaluation.csv",
                    reevaluation_header + "1,0.5,0.1,10,10\n2,0.4,,20,10\n3,0.2,0.3,10,10\n");
    io::write_whole(folder_ / "plain_1/costs.csv", "generation,voxel_steps,element_steps\n0,1000,0\n1,500,0\n");
    io::write_whole(folder_ / "plain_1/reevaluation.csv",
                    reevaluation_header + "1,0.6,0.05,10,10\n2,0.5,0.2,20,10\n3,0.4,0.4,30,10\n");
  }

  [[nodiscard]] ComparedSearch read(const std::string& name, const ComparisonOptions& options = {}) const {
    return read_compared_search(folder_ / name, options);
  }

  const tests::TestFolder folder_;
};

TEST_F(SearchComparison, TheOutcomeIsTheBestByFiniteElements) {
  const ComparedSearch both = read("both_1");
  EXPECT_EQ(both.model, EvaluationModel::both);
  EXPECT_EQ(both.name, "both_1");
  ASSERT_EQ(both.robots.size(), 3U);
  EXPECT_FALSE(both.robots[1].body_lengths) << "it failed";
  EXPECT_EQ(both.best()->body_lengths, 0.3);
  EXPECT_EQ(both.best()->search_body_lengths, 0.2);
  EXPECT_EQ(both.inputs.size(), 2U);
  EXPECT_TRUE(both.inputs.contains((folder_ / "both_1/costs.csv").string()));
  EXPECT_TRUE(both.inputs.contains((folder_ / "both_1/reevaluation.csv").string()));
  const ComparedSearch plain = read("plain_1/");
  EXPECT_EQ(plain.model, EvaluationModel::voxels);
  EXPECT_EQ(plain.name, "plain_1");
  EXPECT_EQ(plain.best()->body_lengths, 0.4);
  io::write_whole(folder_ / "plain_1/costs.csv", "generation,voxel_steps,element_steps\n0,0,10\n");
  EXPECT_EQ(read("plain_1").model, EvaluationModel::finite_elements);
}

TEST_F(SearchComparison, TheReevaluationMayHaveAFolderOfItsOwn) {
  io::write_whole(folder_ / "plain_1/reevaluated/reevaluation.csv", reevaluation_header + "1,0.6,0.7,10,10\n");
  EXPECT_EQ(read("plain_1").best()->body_lengths, 0.7);
  fs::remove(folder_ / "plain_1/reevaluation.csv");
  EXPECT_EQ(read("plain_1").robots.size(), 1U);
}

TEST_F(SearchComparison, StepsAreCountedTogetherAtTheRateOfExchange) {
  const ComparisonOptions options{.voxel_steps_per_element_step = 2.0};
  const ComparedSearch both = read("both_1", options);
  EXPECT_EQ(both.voxel_steps, 2100.0);
  EXPECT_EQ(both.element_steps, 400.0);
  EXPECT_EQ(both.reevaluation_element_steps, 400.0);
  // The whole search comes first, then its robots one by one.
  EXPECT_EQ(both.robots[0].total_voxel_steps, 2100.0 + 2.0 * (400.0 + 100.0));
  EXPECT_EQ(both.robots[1].total_voxel_steps, 2100.0 + 2.0 * (400.0 + 300.0));
  EXPECT_EQ(both.robots[2].total_voxel_steps, 2100.0 + 2.0 * (400.0 + 400.0));
  const ComparedSearch plain = read("plain_1", options);
  EXPECT_EQ(plain.robots[2].total_voxel_steps, 1500.0 + 2.0 * 600.0);
  const std::string table = comparison_table({both, plain}, options).text();
  EXPECT_NE(table.find("both_1,both,3,1,2100,400,400,3700,0.3,0.2"), std::string::npos) << table;
  EXPECT_NE(table.find("plain_1,voxels,3,0,1500,0,600,2700,0.4,0.4"), std::string::npos) << table;
}

TEST_F(SearchComparison, WhatABudgetNoLongerPaysForDoesNotCount) {
  const ComparedSearch plain = read("plain_1", {.budget_element_steps = 350.0});
  EXPECT_EQ(plain.robots.size(), 2U);
  EXPECT_EQ(plain.reevaluation_element_steps, 300.0);
  EXPECT_EQ(plain.best()->body_lengths, 0.2);
  EXPECT_FALSE(read("plain_1", {.budget_element_steps = 50.0}).best());
}

TEST_F(SearchComparison, TheChartShowsTheBestSoFarAndTheOutcomes) {
  const io::Chart chart = comparison_chart({read("both_1"), read("plain_1")});
  ASSERT_EQ(chart.panels.size(), 2U);
  ASSERT_EQ(chart.panels[0].series.size(), 2U);
  for (const io::ChartPanel& panel : chart.panels) EXPECT_EQ(panel.y.title, "distance on finite elements (body lengths)");
  EXPECT_EQ(chart.panels[0].series[0].y, (std::vector{0.1, 0.1, 0.1, 0.1, 0.3}));
  EXPECT_EQ(chart.panels[0].series[1].y, (std::vector{0.05, 0.05, 0.2, 0.2, 0.4}));
  EXPECT_EQ(chart.panels[1].series[0].y, std::vector{0.4}) << "searches on voxels come first";
  EXPECT_EQ(chart.panels[1].series[1].y, std::vector{0.3});
  EXPECT_NE(comparison_text({read("both_1"), read("plain_1")}, {}).find("median outcome of searches on both: 0.30000"),
            std::string::npos);
}

TEST_F(SearchComparison, NumbersOfAnyLengthAreWrittenWhole) {
  io::write_whole(folder_ / "plain_1/reevaluation.csv", reevaluation_header + "1,0.6,1e300,10,10\n");
  const std::string text = comparison_text({read("plain_1")}, {});
  const std::size_t row = text.find("plain_1");
  EXPECT_EQ(text.find('\n', row) - row, 20U + 1 + 16 + 1 + 9 + 1 + 14 + 1 + (301 + 6) + 1 + 12) << text;
}

TEST_F(SearchComparison, MissingOrDamagedTablesAreNamed) {
  fs::remove(folder_ / "plain_1/reevaluation.csv");
  EXPECT_NE(tests::message_of([&] { (void)read("plain_1"); }).find("reevaluation.csv"), std::string::npos);
  io::write_whole(folder_ / "both_1/reevaluation.csv", "rank,elements_m2,elements_steps,elements_count\n1,1,1,1\n");
  EXPECT_NE(tests::message_of([&] { (void)read("both_1"); }).find("body_lengths"), std::string::npos);
  io::write_whole(folder_ / "both_1/costs.csv", "generation,voxel_steps\n0,1\n");
  EXPECT_NE(tests::message_of([&] { (void)read("both_1"); }).find("element_steps"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
