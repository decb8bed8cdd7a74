#include "evolution/report/generation_summary.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

/// The columns that a legend explains are those of the heading, without their units.
void expect_explained(const RunView& run, const std::string& unit) {
  const std::string header = summary_header(run);
  const std::string legend = summary_legend(run);
  EXPECT_NE(header.find("F [" + unit + "]"), std::string::npos) << header;
  for (const int level : run.plan.levels()) {
    const std::string displacement = "d" + std::to_string(level);
    EXPECT_NE(header.find("  " + displacement + " [BL"), std::string::npos) << header;
    EXPECT_NE(legend.find(displacement), std::string::npos) << legend;
  }
  for (const std::string column : {"gen", "F", "H", "age", "mean F"})
    EXPECT_TRUE(legend.starts_with(column + ": ") || legend.find("; " + column + ": ") != std::string::npos) << legend;
  for (const std::string column : {"evals", "cached", "pruned", "time"})
    EXPECT_NE(legend.find(column), std::string::npos) << legend;
  EXPECT_EQ(legend.find('\n'), std::string::npos);
}

TEST(GenerationSummary, LegendExplainsTheColumns) {
  RunView run{.plan = tests::small_plan(), .physics = {}};
  expect_explained(run, "BL");
  EXPECT_EQ(summary_legend(run).find("period"), std::string::npos);
  run.is_per_period = true;
  expect_explained(run, "BL/T");
  EXPECT_NE(summary_legend(run).find("T a period of the drive"), std::string::npos);
  run.plan.objective = Objective::squared_metres_per_scale;
  expect_explained(run, "m2/T");
}

TEST(GenerationSummary, ColumnsKeepTheirPlacesWithAnyUnit) {
  RunView run{.plan = tests::small_plan(), .physics = {}};
  const std::size_t length = summary_header(run).size();
  run.is_per_period = true;
  EXPECT_EQ(summary_header(run).size(), length);
}

}  // namespace
}  // namespace menger::evolution
