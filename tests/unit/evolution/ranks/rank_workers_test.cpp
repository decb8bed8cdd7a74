#include "evolution/ranks/rank_workers.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "evolution/evaluation/scenario_evaluator.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/fake_evaluator.h"

namespace menger::evolution {
namespace {

using test_support::FakeEvaluator;

const std::atomic<bool> never{false};

/// A search of one rank with two evaluators, one of them in two scenarios.
class OneRank : public testing::Test {
 protected:
  OneRank() {
    shared_.add(first_);
    shared_.add(scenarios_);
  }

  static std::unique_ptr<DesignEvaluator> fake(const std::string& scenario) {
    return std::make_unique<FakeEvaluator>(FakeEvaluator::Options{.failing = 0.0, .scenario = scenario, .before_result = {}});
  }
  static std::vector<std::unique_ptr<DesignEvaluator>> two() {
    std::vector<std::unique_ptr<DesignEvaluator>> both;
    both.push_back(fake("ice"));
    both.push_back(fake("sand"));
    return both;
  }

  FakeEvaluator first_;
  ScenarioEvaluator scenarios_{two()};
  SharedEvaluators shared_;
  io::RankSession session_;
  io::RankTeam team_{session_,
                     [this](const std::string& task, const std::atomic<bool>& stop, const ThreadsNow& threads) {
                       return shared_.evaluate(task, stop, threads);
                     },
                     {io::facts_of(session_, 2, {})},
                     {.threads = 2}};
  RankWorkers workers_{team_, shared_};
};

TEST_F(OneRank, EvaluatesEachTaskByItsEvaluatorAndScenario) {
  // Of another object than that which the ranks share, as walks on finer elements are: the physics says which it is.
  std::vector<std::unique_ptr<DesignEvaluator>> sand;
  sand.push_back(fake("sand"));
  const ScenarioEvaluator only_sand(std::move(sand));
  std::vector<EvaluationTask> tasks;
  for (int length = 1; length <= 9; ++length) tasks.push_back({meshes::bar(length), 1, 0});
  std::vector<int> times(tasks.size(), 0);
  const auto status = workers_.run(only_sand, tasks, nullptr, [&](std::size_t task, const Evaluation& result) {
    ++times[task];
    EXPECT_EQ(result.displacement_m, fake("sand")->evaluate(tasks[task].body, 1, never).displacement_m);
  });
  EXPECT_EQ(status, io::RunStatus::completed);
  EXPECT_EQ(times, std::vector<int>(tasks.size(), 1));

  for (std::size_t n = 0; n < tasks.size(); ++n) tasks[n].scenario = n % 2;
  (void)workers_.run(scenarios_, tasks, nullptr, [&](std::size_t task, const Evaluation& result) {
    EXPECT_EQ(result.displacement_m, fake(task % 2 == 0 ? "ice" : "sand")->evaluate(tasks[task].body, 1, never).displacement_m);
  });
}

TEST_F(OneRank, IsToldThatItStopped) {
  std::atomic<bool> stop{false};
  int handed_over = 0;
  const std::vector<EvaluationTask> tasks(500, EvaluationTask{meshes::bar(3), 1});
  const auto status = workers_.run(first_, tasks, &stop, [&](std::size_t, const Evaluation& result) {
    EXPECT_NE(result.status, io::RunStatus::stopped);
    if (++handed_over == 3) stop = true;
  });
  EXPECT_EQ(status, io::RunStatus::stopped);
  EXPECT_LT(handed_over, 500);
}

TEST_F(OneRank, KnowsTheDecidingPhysicsOfAllEvaluators) {
  for (const char* part : {"ice", "sand"}) EXPECT_NE(shared_.physics().find(part), std::string::npos);
}

}  // namespace
}  // namespace menger::evolution
