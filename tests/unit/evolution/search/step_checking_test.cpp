// Elites evaluated again with half the time step: which are checked, and that nothing else changes.

#include "evolution/search/step_checking.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "evolution/report/step_check_table.h"
#include "evolution/search/search.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;

SearchPlan checked_plan() {
  SearchPlan plan = tests::small_plan();
  plan.offspring.constraints.levels = {1, 2};
  plan.step_checks = StepCheckPlan{.every = 2, .designs = 2};
  return plan;
}

class CheckedSearch : public tests::SearchFixture {
 protected:
  [[nodiscard]] RunView view(const RunArchive& archive, const SearchPlan& plan) const {
    return {.archive = &archive, .plan = plan, .physics = evaluator_.physics(), .half_step_physics = half_.physics()};
  }
};

/// Returns the content of an archive without its table of checks.
std::string without_checks(std::string content) {
  const std::size_t begin = content.find("step_check (");
  if (begin == std::string::npos) return content;
  const std::size_t end = content.find("study (", begin);
  return content.erase(begin, end - begin);
}

TEST_F(CheckedSearch, EverythingElseIsAsWithoutChecks) {
  SearchPlan plan = checked_plan();
  static_cast<void>(searched(plan, "checked"));
  plan.step_checks.reset();
  static_cast<void>(searched(plan, "unchecked"));
  const std::string unchecked = archive_content(file("unchecked"));
  const std::string checked = archive_content(file("checked"));
  EXPECT_NE(checked, unchecked);
  EXPECT_EQ(without_checks(checked), unchecked);
  EXPECT_EQ(unchecked.find("step_check"), std::string::npos) << "the archive of a search without checks stays what it was";
}

TEST_F(CheckedSearch, TheBestOfEveryDueGenerationAreEvaluatedAtAllLevels) {
  const SearchPlan plan = checked_plan();
  const RunArchive archive = searched(plan);
  const std::atomic<bool> never{false};
  for (int generation = 0; generation <= 6; generation += 2) {
    const auto checked = checked_designs(plan, archive, generation, evaluator_.physics(), half_.physics());
    ASSERT_EQ(checked.size(), 2U);
    const GenerationSummary summary = summarise_generation(view(archive, plan), generation);
    EXPECT_EQ(checked[0].elite.individual, summary.champion->individual.id);
    EXPECT_GE(checked[0].elite.fitness, checked[1].elite.fitness);
    for (const CheckedDesign& design : checked) {
      ASSERT_EQ(design.levels.size(), 2U);
      for (const CheckedLevel& level : design.levels) {
        const Evaluation expected = half_.evaluate(aggregate(design.elite.simulated, level.level), level.level, never);
        EXPECT_EQ(level.half.status, expected.status);
        EXPECT_EQ(level.half.displacement_m, expected.displacement_m);
        EXPECT_EQ(level.half.reason, expected.reason);
        EXPECT_TRUE(level.whole.displacement_m) << "an elite has a fitness";
      }
      EXPECT_EQ(whole_step_score(plan, design), design.elite.fitness);
    }
  }
}

TEST_F(CheckedSearch, NoDesignIsCheckedTwice) {
  ASSERT_EQ(search("run", checked_plan()), io::RunStatus::completed);
  const auto rows = static_cast<std::uint64_t>(
      SQLite::Database(file("run").string(), SQLite::OPEN_READONLY).execAndGet("SELECT COUNT(*) FROM step_check").getInt64());
  EXPECT_EQ(half_.calls(), rows);
  EXPECT_LT(rows, 4U * 2U * 2U) << "no elite stayed for two generations, so nothing is tested";
  ASSERT_EQ(search("run", checked_plan()), io::RunStatus::completed);
  EXPECT_EQ(half_.calls(), rows) << "a finished search checks nothing more";
}

TEST_F(CheckedSearch, IsTheSameForAnyNumberOfThreads) { expect_the_same_for_any_threads(checked_plan()); }

TEST_F(CheckedSearch, StoppedAtAnyCommitGoesOnToTheSameArchive) {
  // After the last check only the generation itself remains to be finished, and a stop does not prevent that.
  expect_the_same_after_stops(checked_plan(), {.stride = 3, .spared = 1});
}

TEST_F(CheckedSearch, TheTableHoldsBothResultsOfEveryEliteAndLevel) {
  const SearchPlan plan = checked_plan();
  const RunArchive archive = searched(plan);
  const io::CsvContents table = io::parse_csv(step_check_table(view(archive, plan)).text(), "check_dt.csv");
  ASSERT_EQ(table.row_count(), 4U * 2U * 2U);
  std::size_t failed = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double whole = table.number(row, "displacement_body_lengths");
    const auto half = table.optional_number(row, "half_step_displacement_body_lengths");
    EXPECT_EQ(half.has_value(), table.text(row, "half_step_status") == "completed");
    EXPECT_EQ(half.has_value(), table.optional_number(row, "distance_m").has_value());
    if (!half) {
      ++failed;
      EXPECT_FALSE(table.optional_number(row, "half_step_score_body_lengths"));
      continue;
    }
    EXPECT_EQ(table.number(row, "change"), *half / whole - 1.0);
    EXPECT_NEAR(std::round(10.0 * *half), 10.0 * *half, 1e-9) << "by the evaluator with half the step";
  }
  EXPECT_GT(failed, 0U);
  EXPECT_LT(failed, table.row_count());
}

TEST_F(CheckedSearch, PeopleReadWhatHalfTheStepMakes) {
  SearchPlan plan = checked_plan();
  CheckedDesign design;
  design.elite.individual = 12;
  const auto moved = [](double metres) {
    Evaluation result;
    result.status = io::RunStatus::completed;
    result.displacement_m = {metres, 0.0, 0.0};
    return result;
  };
  design.levels = {{1, moved(0.030), moved(0.027)}, {2, moved(0.045), moved(0.054)}};
  EXPECT_DOUBLE_EQ(whole_step_score(plan, design).value(), 0.5);
  EXPECT_DOUBLE_EQ(half_step_score(plan, design).value(), 0.6);
  EXPECT_EQ(step_check_text(plan, 4, {design}),
            "     time step check, generation 4, individual 12: score 0.6 with half the time step, 0.5 with the whole one, +20 "
            "%; level 1 -10 %; level 2 +20 %\n");
  design.levels[1].half = {};
  design.levels[1].half.status = io::RunStatus::diverged;
  design.levels[1].half.reason = "voxel 7: speed";
  EXPECT_EQ(step_check_text(plan, 4, {design}),
            "     time step check, generation 4, individual 12: no score with half the time step; level 1 -10 %; level 2 "
            "diverged (voxel 7: speed)\n");
}

TEST(Elites, AreTheFittestOfEqualsTheYoungestAndEachBodyOnce) {
  Phenotype bar;
  bar.body = meshes::Polycube::from_digits(3, 3, 3, "111000000000000000000000000");
  Phenotype lifted;
  lifted.body = meshes::Polycube::from_digits(3, 3, 3, "000000000111000000000000000");
  Phenotype plate;
  plate.body = meshes::Polycube::from_digits(3, 3, 3, "111111111000000000000000000");
  const auto survivor = [](std::uint64_t id, int age, std::optional<double> fitness, const Phenotype& phenotype) {
    Survivor one;
    one.individual.id = id;
    one.individual.phenotype = phenotype;
    one.member = {.id = id, .age = age, .fitness = fitness, .survivor_rank = id};
    return one;
  };
  std::vector<Survivor> survivors{survivor(1, 9, 0.5, bar), survivor(2, 3, 0.5, plate), survivor(3, 0, 0.4, lifted),
                                  survivor(4, 0, std::nullopt, plate)};
  const auto ids = [&](const SearchPlan& plan, std::size_t count) {
    std::vector<std::uint64_t> all;
    for (const Elite& elite : elites(plan, survivors, count)) all.push_back(elite.individual);
    return all;
  };
  SearchPlan plan;
  EXPECT_EQ(ids(plan, 1), (std::vector<std::uint64_t>{2})) << "the younger of two equals";
  EXPECT_EQ(ids(plan, 9), (std::vector<std::uint64_t>{2, 1, 3})) << "who has no fitness is no elite";
  plan.stand = true;
  EXPECT_EQ(ids(plan, 9), (std::vector<std::uint64_t>{2, 1})) << "standing they are one body";
  survivors[1].member.survivor_rank.reset();
  EXPECT_EQ(ids(plan, 1), (std::vector<std::uint64_t>{1})) << "who was culled is no elite";
}

}  // namespace
}  // namespace menger::evolution
