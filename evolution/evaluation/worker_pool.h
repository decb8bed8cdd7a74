#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "evolution/evaluation/evaluator.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Workers that judge bodies side by side. One that finds no group left lends its thread to those that have one, as ThreadsNow
/// tells them, but no more threads work than the machine has cores.
///
/// Tasks and results are plain data, so that workers need not share memory with the caller: other processes could stand behind
/// the same interface, with threads of their own.
class WorkerPool {
 public:
  /// @param evaluator outlives the pool @param threads >= 1, more than the machine has cores if so asked
  WorkerPool(const DesignEvaluator& evaluator, int threads);

  /// Takes the position of a task and its result.
  using Finished = std::function<void(std::size_t task, const Evaluation& result)>;

  /// Judges all tasks in the evaluator's groups, the costliest group first, and hands every result that is not `stopped` to
  /// `finished`, one at a time, in the order in which they come.
  /// @return completed, or stopped if `stop` was set before all were done. What an evaluation or `finished` throws ends the rest
  /// and is thrown again.
  [[nodiscard]] io::RunStatus run(std::span<const EvaluationTask> tasks, const std::atomic<bool>& stop,
                                  const Finished& finished) const;

 private:
  const DesignEvaluator* evaluator_;
  int threads_;
};

}  // namespace menger::evolution
