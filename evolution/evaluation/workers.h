#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Those who evaluate the bodies of a search: threads of this process (WorkerPool), or other processes as well.
class Workers {
 public:
  virtual ~Workers() = default;

  /// Receives the position of a task and its result.
  using Finished = std::function<void(std::size_t task, const Evaluation& result)>;

  /// Evaluates all tasks in the evaluator's groups, the costliest group first. Calls `finished` with every result that is not
  /// `stopped`, one call at a time, in the order in which results arrive. An exception of an evaluation or of `finished` ends the
  /// rest and is thrown again.
  /// @param stop may be null: then nothing stops it
  /// @return completed, or stopped if `stop` was set before all were done
  [[nodiscard]] virtual io::RunStatus run(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                                          const std::atomic<bool>* stop, const Finished& finished) const = 0;
};

/// Those who evaluate bodies one by one, where further bodies follow from results.
class TaskStream {
 public:
  virtual ~TaskStream() = default;

  /// Receives the position of a task and its result. Returns further tasks, whose positions follow those of all before; nothing
  /// ends the run: what is under way is dropped.
  using Finished = std::function<std::optional<std::vector<EvaluationTask>>(std::size_t task, const Evaluation& result)>;

  /// Evaluates all tasks, the first ones first, each alone. Calls `finished` as Workers::run does.
  /// @param stop may be null: then nothing stops it
  /// @return completed, also if `finished` ended it, or stopped if `stop` was set before
  [[nodiscard]] virtual io::RunStatus run_stream(const DesignEvaluator& evaluator, std::vector<EvaluationTask> tasks,
                                                 const std::atomic<bool>* stop, const Finished& finished) const = 0;

  /// Returns how many tasks are evaluated at the same time, >= 1.
  [[nodiscard]] virtual int threads() const = 0;
};

}  // namespace menger::evolution
