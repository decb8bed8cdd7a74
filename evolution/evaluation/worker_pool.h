#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/evaluation/workers.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Threads that evaluate bodies in parallel.
///
/// A worker that finds no group of tasks left lends its thread to the others, which read their number of threads from ThreadsNow.
/// Lending never makes more threads work than the machine has cores.
class WorkerPool final : public Workers {
 public:
  /// @param threads >= 1; may be more than the machine has cores
  explicit WorkerPool(int threads);

  [[nodiscard]] io::RunStatus run(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                                  const std::atomic<bool>* stop, const Finished& finished) const override;

 private:
  int threads_;
};

/// Positions of tasks that are evaluated together.
using TaskGroup = std::vector<std::size_t>;

/// Returns the evaluator's groups of tasks, the costliest first. @param workers that share them, >= 1
std::vector<TaskGroup> costliest_groups_first(std::span<const EvaluationTask> tasks, const DesignEvaluator& evaluator,
                                              int workers);

}  // namespace menger::evolution
