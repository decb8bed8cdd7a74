#include "evolution/report/individual_table.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

TEST(IndividualTable, HasEveryBodyWithItsResults) {
  const tests::TestFolder folder;
  const test_support::FakeEvaluator evaluator{{.failing = 0.2, .before_result = {}}};
  const SearchPlan plan = tests::small_plan();
  RunArchive archive = RunArchive::open(folder / "run.sqlite", "a study", 1);
  ASSERT_EQ(run_search(plan, evaluator, archive, {}), io::RunStatus::completed);
  const RunView run{.archive = &archive, .plan = plan, .physics = evaluator.physics()};
  const io::CsvContents table = io::parse_csv(individual_table(run).text(), "individuals.csv");
  ASSERT_EQ(table.row_count(), archive.next_id());
  std::size_t without = 0;
  std::size_t failed = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    ASSERT_EQ(table.count(row, "individual"), row);
    const Individual individual = archive.individual(row);
    EXPECT_EQ(table.count(row, "generation"), static_cast<std::size_t>(individual.generation));
    EXPECT_EQ(table.text(row, "parent"), individual.parent ? std::to_string(*individual.parent) : "");
    EXPECT_EQ(table.count(row, "age"), static_cast<std::size_t>(individual.age));
    EXPECT_EQ(table.count(row, "cells"), individual.phenotype.body.count());
    EXPECT_EQ(table.text(row, "phenotype"), phenotype_key(individual.phenotype));
    for (const int level : plan.levels()) {
      const std::string name = "level_" + std::to_string(level) + "_";
      const auto found =
          archive.evaluation({design_hash(individual.phenotype, level), level, io::content_hash(evaluator.physics())});
      if (!found) {
        ++without;
        EXPECT_EQ(table.text(row, name + "status"), "") << "selection did not need it";
        continue;
      }
      EXPECT_EQ(table.text(row, name + "status"), io::to_string(found->result.status));
      if (!found->result.displacement_m) {
        ++failed;
        EXPECT_EQ(table.text(row, name + "dx_m"), "");
        continue;
      }
      EXPECT_EQ(table.number(row, name + "dx_m"), found->result.displacement_m->at(0));
      EXPECT_EQ(table.number(row, name + "dz_m"), found->result.displacement_m->at(2));
    }
  }
  EXPECT_GT(without, 0U);
  EXPECT_GT(failed, 0U);
  for (const PoolMember& member : archive.survivors(plan.generations)) {
    if (!member.fitness) continue;
    EXPECT_EQ(table.number(member.id, "fitness_body_lengths"), *member.fitness);
  }
}

TEST(GenerationSummary, CountsEvaluationsOutsideTheRangeInAllScenarios) {
  const tests::TestFolder folder;
  RunArchive archive = RunArchive::open(folder / "run.sqlite", "a study", 1);
  const auto add = [&](const std::string& design, const std::string& physics, int generation, const std::string& outside) {
    Evaluation result;
    result.outside_validity = outside;
    archive.add_evaluation({design, 1, io::content_hash(physics)}, {generation, result});
  };
  add("a", "smooth", 1, "7 kPa");
  add("a", "rough", 1, "7 kPa");
  add("b", "rough", 1, "");
  add("c", "rough", 0, "7 kPa");
  add("d", "surrogate", 1, "7 kPa");
  const RunView run{.archive = &archive, .plan = {}, .physics = "smooth", .scenario_physics = {"smooth", "rough"}};
  EXPECT_EQ(evaluations_outside_validity(run, 0), 1U);
  EXPECT_EQ(evaluations_outside_validity(run, 1), 2U);
}

}  // namespace
}  // namespace menger::evolution
