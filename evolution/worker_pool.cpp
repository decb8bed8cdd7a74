#include "evolution/worker_pool.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <mutex>
#include <numeric>
#include <vector>

namespace menger::evolution {

namespace {

/// Positions of the tasks, the costliest first.
std::vector<std::size_t> costliest_first(std::span<const EvaluationTask> tasks, const DesignEvaluator& evaluator) {
  std::vector<double> costs;
  for (const EvaluationTask& task : tasks) costs.push_back(evaluator.cost(task.body, task.level));
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  return order;
}

}  // namespace

WorkerPool::WorkerPool(const DesignEvaluator& evaluator, int threads) : evaluator_(&evaluator), threads_(threads) {
  assert(threads >= 1);
}

io::RunStatus WorkerPool::run(std::span<const EvaluationTask> tasks, const std::atomic<bool>& stop,
                              const Finished& finished) const {
  const std::vector<std::size_t> order = costliest_first(tasks, *evaluator_);
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::atomic<bool> failed{false};
  std::mutex finishing;
  // Each worker takes the next task from the list, which keeps the order that a division into ranges would lose.
  const auto work = [&](int) {
    try {
      for (std::size_t i = next++; i < order.size() && !stop && !failed; i = next++) {
        const std::size_t task = order[i];
        const Evaluation result = evaluator_->evaluate(tasks[task].body, tasks[task].level, stop);
        if (result.status == io::RunStatus::stopped) continue;
        const std::lock_guard guard(finishing);
        if (failed) return;
        finished(task, result);
        ++done;
      }
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
