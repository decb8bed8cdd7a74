#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "evolution/evaluation/worker_pool.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/fake_evaluator.h"

namespace menger::evolution {
namespace {

using test_support::FakeEvaluator;

const std::atomic<bool> never{false};

std::vector<EvaluationTask> bars(int count) {
  std::vector<EvaluationTask> tasks;
  for (int i = 1; i <= count; ++i) tasks.push_back({meshes::bar(i), 1});
  return tasks;
}

TEST(WorkerPool, HandsOverEveryResultOnceUnderItsTask) {
  const FakeEvaluator evaluator;
  const std::vector<EvaluationTask> tasks = bars(40);
  for (const int threads : {1, 2, 8}) {
    std::vector<int> times(tasks.size(), 0);
    const auto status = WorkerPool(threads).run(evaluator, tasks, nullptr, [&](std::size_t task, const Evaluation& result) {
      ++times[task];
      EXPECT_EQ(result.displacement_m, evaluator.evaluate(tasks[task].body, 1, never).displacement_m);
    });
    EXPECT_EQ(status, io::RunStatus::completed);
    EXPECT_EQ(times, std::vector<int>(tasks.size(), 1));
  }
}

TEST(WorkerPool, BeginsWithTheCostliest) {
  const FakeEvaluator evaluator;
  std::vector<std::size_t> order;
  ASSERT_EQ(WorkerPool(1).run(evaluator, bars(5), nullptr, [&](std::size_t task, const Evaluation&) { order.push_back(task); }),
            io::RunStatus::completed);
  EXPECT_EQ(order, (std::vector<std::size_t>{4, 3, 2, 1, 0}));
}

TEST(WorkerPool, HasAsManyWorkersAsAskedFor) {
  // Every evaluation waits for three others, so fewer workers would never end.
  std::barrier meeting(4);
  FakeEvaluator::Options options;
  options.before_result = [&](std::uint64_t) { meeting.arrive_and_wait(); };
  const FakeEvaluator evaluator(options);
  EXPECT_EQ(WorkerPool(4).run(evaluator, bars(8), nullptr, [](std::size_t, const Evaluation&) {}), io::RunStatus::completed);
}

TEST(WorkerPool, StopsSoonAndHandsOverNothingStopped) {
  const FakeEvaluator evaluator;
  std::atomic<bool> stop{false};
  int finished = 0;
  const auto status = WorkerPool(1).run(evaluator, bars(10), &stop, [&](std::size_t, const Evaluation& result) {
    EXPECT_NE(result.status, io::RunStatus::stopped);
    stop = ++finished == 3;
  });
  EXPECT_EQ(status, io::RunStatus::stopped);
  EXPECT_EQ(finished, 3);
}

TEST(WorkerPool, PassesOnWhatAnEvaluationThrows) {
  FakeEvaluator::Options options;
  options.before_result = [](std::uint64_t call) {
    if (call == 3) throw std::runtime_error("out of chalk");
    // The tasks of this fake are so short that all could be done before the exception arrives.
    if (call > 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  const FakeEvaluator evaluator(options);
  EXPECT_THROW((void)WorkerPool(2).run(evaluator, bars(100), nullptr, [](std::size_t, const Evaluation&) {}), std::runtime_error);
  EXPECT_LT(evaluator.calls(), 100U);
}

/// Evaluates bars of even length together, and bars of odd length together.
class GroupingEvaluator final : public DesignEvaluator {
 public:
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override {
    return fake_.evaluate(body, level, stop);
  }
  [[nodiscard]] std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop,
                                                          const ThreadsNow& threads) const override {
    ++calls_;
    if (tasks.size() != 3) return DesignEvaluator::evaluate_together(tasks, stop, threads);
    std::vector<Evaluation> results = DesignEvaluator::evaluate_together(tasks, stop, threads);
    results[1] = Evaluation{};  // stopped
    return results;
  }
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks,
                                                             int /*workers*/) const override {
    std::vector<std::vector<std::size_t>> parity(2);
    for (std::size_t i = 0; i < tasks.size(); ++i) parity[tasks[i].body.count() % 2].push_back(i);
    return parity;
  }
  [[nodiscard]] std::string physics() const override { return fake_.physics(); }
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override { return fake_.cost(body, level); }
  [[nodiscard]] int calls() const { return calls_; }

 private:
  FakeEvaluator fake_;
  mutable std::atomic<int> calls_{0};
};

TEST(WorkerPool, EvaluatesAGroupAtATimeAndHandsOverEachResultUnderItsTask) {
  const GroupingEvaluator evaluator;
  const std::vector<EvaluationTask> tasks = bars(9);
  std::vector<std::size_t> order;
  const auto status = WorkerPool(1).run(evaluator, tasks, nullptr, [&](std::size_t task, const Evaluation& result) {
    order.push_back(task);
    EXPECT_EQ(result.displacement_m, evaluator.evaluate(tasks[task].body, 1, never).displacement_m);
  });
  EXPECT_EQ(status, io::RunStatus::completed);
  EXPECT_EQ(evaluator.calls(), 2);
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 2, 4, 6, 8, 1, 3, 5, 7})) << "25 cells before 20";
}

TEST(WorkerPool, HandsOverWhatOfAGroupWasDoneWhenItStopped) {
  const GroupingEvaluator evaluator;
  std::vector<std::size_t> done;
  const auto status =
      WorkerPool(1).run(evaluator, bars(5), nullptr, [&](std::size_t task, const Evaluation&) { done.push_back(task); });
  EXPECT_EQ(status, io::RunStatus::stopped);
  EXPECT_EQ(done, (std::vector<std::size_t>{0, 4, 1, 3}));
}

/// Asks for threads until there are as many as wanted, or for ten seconds.
class PatientEvaluator final : public DesignEvaluator {
 public:
  explicit PatientEvaluator(int threads) : wanted_(threads) {}
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override {
    return fake_.evaluate(body, level, stop);
  }
  [[nodiscard]] std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop,
                                                          const ThreadsNow& threads) const override {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (threads() < wanted_ && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    given_ = threads();
    return DesignEvaluator::evaluate_together(tasks, stop, threads);
  }
  [[nodiscard]] std::string physics() const override { return fake_.physics(); }
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override { return fake_.cost(body, level); }
  [[nodiscard]] int given() const { return given_; }

 private:
  FakeEvaluator fake_;
  int wanted_;
  mutable std::atomic<int> given_{0};
};

TEST(WorkerPool, GivesThreadsWithoutWorkToTheLastTask) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core";
  const PatientEvaluator evaluator(2);
  ASSERT_EQ(WorkerPool(2).run(evaluator, bars(1), nullptr, [](std::size_t, const Evaluation&) {}), io::RunStatus::completed);
  EXPECT_EQ(evaluator.given(), 2);
  const PatientEvaluator alone(1);
  ASSERT_EQ(WorkerPool(1).run(alone, bars(3), nullptr, [](std::size_t, const Evaluation&) {}), io::RunStatus::completed);
  EXPECT_EQ(alone.given(), 1);
}

TEST(WorkerPool, IsDoneAtOnceWithoutTasks) {
  const FakeEvaluator evaluator;
  EXPECT_EQ(WorkerPool(2).run(evaluator, {}, nullptr, [](std::size_t, const Evaluation&) { FAIL(); }), io::RunStatus::completed);
}

}  // namespace
}  // namespace menger::evolution
