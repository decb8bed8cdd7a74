#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "evolution/worker_pool.h"
#include "meshes/reference_shapes.h"
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
    const auto status = WorkerPool(evaluator, threads).run(tasks, never, [&](std::size_t task, const Evaluation& result) {
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
  ASSERT_EQ(WorkerPool(evaluator, 1).run(bars(5), never, [&](std::size_t task, const Evaluation&) { order.push_back(task); }),
            io::RunStatus::completed);
  EXPECT_EQ(order, (std::vector<std::size_t>{4, 3, 2, 1, 0}));
}

TEST(WorkerPool, HasAsManyWorkersAsAskedFor) {
  // Every evaluation waits for three others, so fewer workers would never end.
  std::barrier meeting(4);
  FakeEvaluator::Options options;
  options.before_result = [&](std::uint64_t) { meeting.arrive_and_wait(); };
  const FakeEvaluator evaluator(options);
  EXPECT_EQ(WorkerPool(evaluator, 4).run(bars(8), never, [](std::size_t, const Evaluation&) {}), io::RunStatus::completed);
}

TEST(WorkerPool, StopsSoonAndHandsOverNothingStopped) {
  const FakeEvaluator evaluator;
  std::atomic<bool> stop{false};
  int finished = 0;
  const auto status = WorkerPool(evaluator, 1).run(bars(10), stop, [&](std::size_t, const Evaluation& result) {
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
    // Tasks as short as this fake's could all be done while the exception is on its way.
    if (call > 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  };
  const FakeEvaluator evaluator(options);
  EXPECT_THROW((void)WorkerPool(evaluator, 2).run(bars(100), never, [](std::size_t, const Evaluation&) {}), std::runtime_error);
  EXPECT_LT(evaluator.calls(), 100U);
}

TEST(WorkerPool, IsDoneAtOnceWithoutTasks) {
  const FakeEvaluator evaluator;
  EXPECT_EQ(WorkerPool(evaluator, 2).run({}, never, [](std::size_t, const Evaluation&) { FAIL(); }), io::RunStatus::completed);
}

}  // namespace
}  // namespace menger::evolution
