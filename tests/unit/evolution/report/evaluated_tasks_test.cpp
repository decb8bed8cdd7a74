#include "evolution/report/evaluated_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "evolution/search/search.h"
#include "io/text/csv_table.h"
#include "tests/support/search_fixture.h"

namespace menger::evolution {
namespace {

using test_support::FakeEvaluator;
using tests::small_plan;

/// A finished search in a folder of its own, and the evaluations that it asked for.
class EvaluatedTasks : public testing::Test {
 protected:
  /// Runs a search on one thread. @return by generation, the number of evaluations asked for so far at the start of each batch
  std::map<int, std::vector<std::size_t>> search(const SearchPlan& plan, const std::string& name = "run") {
    archive_.emplace(RunArchive::open(folder_ / (name + ".sqlite"), "a study", 1));
    std::map<int, std::vector<std::size_t>> requested;
    SearchOptions options;
    options.progress = [&](const SearchProgress& now) {
      std::vector<std::size_t>& counts = requested[now.generation];
      if (counts.empty() || counts.back() != now.requested) counts.push_back(now.requested);
    };
    EXPECT_EQ(run_search(plan, evaluator_, *archive_, options), io::RunStatus::completed);
    return requested;
  }

  [[nodiscard]] RunView view(const SearchPlan& plan) const {
    return {.archive = &*archive_, .plan = plan, .physics = evaluator_.physics()};
  }

  const tests::TestFolder folder_;
  FakeEvaluator evaluator_;
  std::optional<RunArchive> archive_;
};

TEST_F(EvaluatedTasks, AreTheBatchesThatTheSearchAskedFor) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const bool pruning : {true, false}) {
      SearchPlan plan = small_plan(seed);
      plan.pruning = pruning;
      if (seed == 5) plan.duplicates = DuplicatePolicy::culled;
      const auto requested = search(plan, std::to_string(seed) + (pruning ? "_pruned" : "_whole"));
      const RunView run = view(plan);
      for (int generation = 0; generation <= plan.generations; ++generation) {
        const std::vector<EvaluatedTask> tasks = evaluated_tasks(run, generation);
        EXPECT_EQ(tasks.size(), archive_->generation(generation).evaluations);
        // The number of evaluations asked for after each batch that was not empty.
        std::vector<std::size_t> sums;
        for (std::size_t i = 0; i < tasks.size(); ++i) {
          if (i + 1 == tasks.size() || tasks[i + 1].batch != tasks[i].batch) sums.push_back(i + 1);
        }
        std::vector<std::size_t> expected = requested.at(generation);
        std::erase(expected, 0U);
        EXPECT_EQ(sums, expected) << "seed " << seed << ", generation " << generation;
      }
    }
  }
}

TEST_F(EvaluatedTasks, HoldEveryEvaluationOnce) {
  const SearchPlan plan = small_plan();
  search(plan);
  std::set<std::pair<std::string, int>> seen;
  for (int generation = 0; generation <= plan.generations; ++generation) {
    for (const EvaluatedTask& task : evaluated_tasks(view(plan), generation)) {
      EXPECT_TRUE(seen.insert({task.design_hash, task.level}).second);
      EXPECT_EQ(task.voxels, aggregate_cell_count(archive_->individual(task.individual).phenotype, task.level));
      EXPECT_EQ(task.result.steps, 1000U);
    }
  }
  EXPECT_EQ(seen.size(), evaluator_.calls());
}

TEST_F(EvaluatedTasks, TablesAddUp) {
  const SearchPlan plan = small_plan();
  search(plan);
  const RunView run = view(plan);
  const io::CsvContents timings = io::parse_csv(timing_table(run).text(), "timings.csv");
  const io::CsvContents schedule = io::parse_csv(schedule_table(run, {1, 3}).text(), "schedule.csv");
  ASSERT_EQ(schedule.row_count(), 14U);
  for (std::size_t row = 0; row < schedule.row_count(); ++row) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < timings.row_count(); ++i) {
      if (timings.number(i, "generation") != schedule.number(row, "generation")) continue;
      sum += timings.number(i, "seconds");
      ++count;
    }
    EXPECT_EQ(schedule.number(row, "evaluations"), static_cast<double>(count));
    const double seconds = schedule.number(row, "seconds");
    EXPECT_EQ(schedule.number(row, "wall_seconds"),
              run.archive->generation(static_cast<int>(schedule.number(row, "generation"))).seconds);
    EXPECT_NEAR(schedule.number(row, "busy_seconds"), sum, 1e-12 * sum);
    // A single worker is always busy. Three workers are at most three times as fast.
    if (schedule.number(row, "workers") == 1.0) {
      EXPECT_NEAR(seconds, sum, 1e-12 * sum);
      EXPECT_NEAR(schedule.number(row, "idle_tail_seconds"), 0.0, 1e-12 * sum);
    }
    EXPECT_GE(seconds * (1.0 + 1e-12), schedule.number(row, "least_seconds"));
    EXPECT_GE(schedule.number(row, "least_seconds") * (1.0 + 1e-12), sum / schedule.number(row, "workers"));
    EXPECT_LE(schedule.number(row, "in_one_batch_seconds"), sum * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace menger::evolution
