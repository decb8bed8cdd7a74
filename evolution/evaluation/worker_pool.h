#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>

#include "evolution/evaluation/evaluator.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Workers that evaluate bodies in parallel.
///
/// A worker that finds no group of tasks left lends its thread to the others, which read their number of threads from ThreadsNow.
/// Lending never makes more threads work than the machine has cores.
///
/// Tasks and results are plain data, so workers need not share memory with the caller: other processes with threads of their own
/// could implement the same interface.
class WorkerPool {
 public:
  /// @param evaluator outlives the pool
  /// @param threads >= 1; may be more than the machine has cores
  WorkerPool(const DesignEvaluator& evaluator, int threads);

  /// Receives the position of a task and its result.
  using Finished = std::function<void(std::size_t task, const Evaluation& result)>;

  /// Evaluates all tasks in the evaluator's groups, the costliest group first. Calls `finished` with every result that is not
  /// `stopped`, one call at a time, in the order in which results arrive. An exception of an evaluation or of `finished` ends the
  /// rest and is thrown again.
  /// @param stop may be null: then nothing stops it
  /// @return completed, or stopped if `stop` was set before all were done
  [[nodiscard]] io::RunStatus run(std::span<const EvaluationTask> tasks, const std::atomic<bool>* stop,
                                  const Finished& finished) const;

 private:
  const DesignEvaluator* evaluator_;
  int threads_;
};

}  // namespace menger::evolution
