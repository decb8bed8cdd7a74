#include "evolution/evaluation/worker_pool.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

namespace menger::evolution {

std::vector<TaskGroup> costliest_groups_first(std::span<const EvaluationTask> tasks, const DesignEvaluator& evaluator,
                                              int workers) {
  std::vector<TaskGroup> groups = evaluator.groups(tasks, workers);
  std::vector<double> costs;
  for (const TaskGroup& group : groups) {
    double cost = 0.0;
    for (const std::size_t task : group) cost += evaluator.cost(tasks[task].body, tasks[task].level);
    costs.push_back(cost);
  }
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  std::vector<TaskGroup> ordered;
  ordered.reserve(groups.size());
  for (const std::size_t i : order) ordered.push_back(std::move(groups[i]));
  return ordered;
}

namespace {

std::vector<Evaluation> evaluated(const TaskGroup& group, std::span<const EvaluationTask> tasks, const DesignEvaluator& evaluator,
                                  const std::atomic<bool>& stop, const ThreadsNow& threads) {
  std::vector<const EvaluationTask*> together;
  together.reserve(group.size());
  for (const std::size_t task : group) together.push_back(&tasks[task]);
  return evaluator.evaluate_together(together, stop, threads);
}

}  // namespace

WorkerPool::WorkerPool(int threads) : threads_(threads) { assert(threads >= 1); }

io::RunStatus WorkerPool::run(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                              const std::atomic<bool>* stop_flag, const Finished& finished) const {
  const std::atomic<bool> never{false};
  const std::atomic<bool>& stop = stop_flag != nullptr ? *stop_flag : never;
  const std::vector<TaskGroup> groups = costliest_groups_first(tasks, evaluator, threads_);
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> failed{false};
  std::mutex finishing;
  std::atomic<int> busy{threads_};
  // Workers that still have a group share the threads of those that found none left.
  const int threads_that_run = std::min(threads_, oneapi::tbb::info::default_concurrency());
  const ThreadsNow threads = [&] { return std::max(1, threads_that_run / busy); };
  // Each worker takes the next group of the list. A division into ranges would lose the order.
  const auto work = [&](int) {
    try {
      for (std::size_t i = next++; i < groups.size() && !stop && !failed; i = next++) {
        const std::vector<Evaluation> results = evaluated(groups[i], tasks, evaluator, stop, threads);
        const std::lock_guard guard(finishing);
        for (std::size_t k = 0; k < results.size(); ++k) {
          if (results[k].status == io::RunStatus::stopped) continue;
          if (failed) return;
          finished(groups[i][k], results[k]);
          ++done;
        }
      }
      --busy;
    } catch (...) {
      failed = true;
      throw;
    }
  };
  // Without this, tbb would not start more threads than there are cores.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
  tbb::task_arena arena(threads_);
  arena.execute([&] { tbb::parallel_for(0, threads_, work, tbb::simple_partitioner{}); });
  return done == tasks.size() ? io::RunStatus::completed : io::RunStatus::stopped;
}

}  // namespace menger::evolution
