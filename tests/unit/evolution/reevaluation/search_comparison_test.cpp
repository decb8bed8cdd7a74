#include "evolution/reevaluation/search_comparison.h"

#include <gtest/gtest.h>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// Folders with the tables of menger export and menger reevaluate.
class SearchComparison : public testing::Test {
 protected:
  SearchComparison() {
    io::write_whole(folder_ / "corrected_1/costs.csv",
                    "generation,voxel_steps,element_steps,total_voxel_steps_so_far\n0,1000,0,1000\n1,500,0,1500\n"
                    "2,500,300,2600\n3,100,100,2900\n");
    io::write_whole(
        folder_ / "corrected_1/reference.csv",
        "generation,surrogate_body_lengths,reference_body_lengths,element_steps\n2,0.5,0.1,100\n2,0.4,,200\n3,0.2,0.3,100\n");
    io::write_whole(folder_ / "plain_1/costs.csv",
                    "generation,voxel_steps,element_steps,total_voxel_steps_so_far\n0,1000,0,1000\n1,500,0,1500\n");
    io::write_whole(folder_ / "plain_1/reevaluation.csv",
                    "rank,surrogate_body_lengths,elements_body_lengths,elements_steps,elements_count\n"
                    "1,0.6,0.05,10,10\n2,0.5,0.2,20,10\n3,0.4,0.4,30,10\n");
  }

  [[nodiscard]] ComparedSearch read(const std::string& name, const ComparisonOptions& options = {}) const {
    return read_compared_search(folder_ / name, options);
  }

  const tests::TestFolder folder_;
};

TEST_F(SearchComparison, TheOutcomeIsTheBestByFiniteElements) {
  const ComparedSearch corrected = read("corrected_1");
  EXPECT_TRUE(corrected.is_corrected);
  EXPECT_EQ(corrected.name, "corrected_1");
  ASSERT_EQ(corrected.robots.size(), 3U);
  EXPECT_FALSE(corrected.robots[1].body_lengths) << "it failed";
  EXPECT_EQ(corrected.best()->body_lengths, 0.3);
  EXPECT_EQ(corrected.best()->surrogate_body_lengths, 0.2);
  const ComparedSearch plain = read("plain_1/");
  EXPECT_FALSE(plain.is_corrected);
  EXPECT_EQ(plain.name, "plain_1");
  EXPECT_EQ(plain.best()->body_lengths, 0.4);
}

TEST_F(SearchComparison, StepsAreCountedTogetherAtTheRateOfExchange) {
  const ComparisonOptions options{.voxel_steps_per_element_step = 2.0};
  const ComparedSearch corrected = read("corrected_1", options);
  EXPECT_EQ(corrected.voxel_steps, 2100.0);
  EXPECT_EQ(corrected.element_steps, 400.0);
  // The round of generation 2 follows generation 1, robot by robot; the round of generation 3 follows all of generation 2.
  EXPECT_EQ(corrected.robots[0].total_voxel_steps, 1500.0 + 200.0);
  EXPECT_EQ(corrected.robots[1].total_voxel_steps, 1500.0 + 600.0);
  EXPECT_EQ(corrected.robots[2].total_voxel_steps, 2600.0 + 200.0);
  const ComparedSearch plain = read("plain_1", options);
  EXPECT_EQ(plain.robots[2].total_voxel_steps, 1500.0 + 2.0 * 600.0) << "the whole search comes first";
  const std::string table = comparison_table({corrected, plain}, options).text();
  EXPECT_NE(table.find("corrected_1,corrected,3,1,2100,400,2900,0.3,0.2"), std::string::npos) << table;
  EXPECT_NE(table.find("plain_1,surrogate alone,3,0,1500,600,2700,0.4,0.4"), std::string::npos) << table;
}

TEST_F(SearchComparison, WhatABudgetNoLongerPaysForDoesNotCount) {
  const ComparedSearch plain = read("plain_1", {.budget_element_steps = 350.0});
  EXPECT_EQ(plain.robots.size(), 2U);
  EXPECT_EQ(plain.element_steps, 300.0);
  EXPECT_EQ(plain.best()->body_lengths, 0.2);
  EXPECT_FALSE(read("plain_1", {.budget_element_steps = 50.0}).best());
}

TEST_F(SearchComparison, TheChartShowsTheBestSoFarAndTheOutcomes) {
  const io::Chart chart = comparison_chart({read("corrected_1"), read("plain_1")});
  ASSERT_EQ(chart.panels.size(), 2U);
  ASSERT_EQ(chart.panels[0].series.size(), 2U);
  EXPECT_EQ(chart.panels[0].series[0].y, (std::vector{0.1, 0.1, 0.1, 0.1, 0.3}));
  EXPECT_EQ(chart.panels[0].series[1].y, (std::vector{0.05, 0.05, 0.2, 0.2, 0.4}));
  EXPECT_EQ(chart.panels[1].series[1].y, std::vector{0.4});
  EXPECT_NE(comparison_text({read("corrected_1"), read("plain_1")}, {}).find("median outcome: corrected searches 0.30000"),
            std::string::npos);
}

TEST_F(SearchComparison, MissingOrDamagedTablesAreNamed) {
  fs::remove(folder_ / "plain_1/reevaluation.csv");
  EXPECT_NE(tests::message_of([&] { (void)read("plain_1"); }).find("reevaluation.csv"), std::string::npos);
  io::write_whole(folder_ / "corrected_1/reference.csv", "generation,surrogate_m2,reference_m2,element_steps\n2,1,1,1\n");
  EXPECT_NE(tests::message_of([&] { (void)read("corrected_1"); }).find("body_lengths"), std::string::npos);
  io::write_whole(folder_ / "corrected_1/reference.csv",
                  "generation,surrogate_body_lengths,reference_body_lengths,element_steps\n7,1,1,1\n");
  EXPECT_NE(tests::message_of([&] { (void)read("corrected_1"); }).find("generation"), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
