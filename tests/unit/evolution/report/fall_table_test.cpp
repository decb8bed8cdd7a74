#include "evolution/report/fall_table.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

/// A fake evaluator with which bodies fall that would have diverged. They go by 0.06 m.
class FallingEvaluator final : public DesignEvaluator {
 public:
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override {
    Evaluation result = walking_.evaluate(body, level, stop);
    if (result.status != io::RunStatus::diverged) return result;
    result.status = io::RunStatus::fell;
    result.left_out_m = {0.0, -0.06, 0.01};
    return result;
  }
  [[nodiscard]] std::string physics() const override { return "falling"; }
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override { return walking_.cost(body, level); }

 private:
  test_support::FakeEvaluator walking_{{.failing = 0.4, .before_result = {}}};
};

TEST(FallTable, HasARowForEveryBodyThatFell) {
  const tests::TestFolder folder;
  const FallingEvaluator evaluator;
  SearchPlan plan = tests::small_plan();
  plan.offspring.constraints.levels = {1};
  RunArchive archive = RunArchive::open(folder / "run.sqlite", "a study", 1);
  ASSERT_EQ(run_search(plan, evaluator, archive, {}), io::RunStatus::completed);
  const RunView run{.archive = &archive, .plan = plan, .physics = evaluator.physics()};
  const io::CsvContents table = io::parse_csv(fall_table(run).text(), "falls.csv");
  std::set<std::string> fallen;  // bodies
  for (int generation = 0; generation <= plan.generations; ++generation) {
    for (const PoolMember& member : archive.pool(generation)) {
      const Phenotype body = archive.individual(member.id).phenotype;
      const auto found = archive.evaluation({design_hash(body, 1), 1, io::content_hash(evaluator.physics())});
      if (found && found->result.status == io::RunStatus::fell) {
        fallen.insert(phenotype_key(body));
        EXPECT_FALSE(member.fitness) << "it is no walker";
      }
    }
  }
  ASSERT_GT(fallen.size(), 3U);
  ASSERT_EQ(table.row_count(), fallen.size());
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const Individual individual = archive.individual(static_cast<std::uint64_t>(table.number(row, "individual")));
    EXPECT_EQ(fallen.erase(phenotype_key(individual.phenotype)), 1U);
    EXPECT_EQ(table.number(row, "generation"), individual.generation);
    EXPECT_EQ(table.number(row, "scenario"), 1.0);
    EXPECT_EQ(table.number(row, "dy_m"), -0.06);
    EXPECT_NEAR(table.number(row, "body_lengths"), 2.0, 1e-12);
    EXPECT_NE(table.text(row, "reason").find("of design"), std::string::npos);
  }
}

}  // namespace
}  // namespace menger::evolution
