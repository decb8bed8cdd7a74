#include "evolution/evaluation/evaluator.h"

namespace menger::evolution {

std::vector<Evaluation> DesignEvaluator::evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                           const std::atomic<bool>& stop, const ThreadsNow& /*threads*/) const {
  std::vector<Evaluation> results;
  results.reserve(tasks.size());
  for (const EvaluationTask* task : tasks) results.push_back(evaluate(task->body, task->level, stop));
  return results;
}

std::vector<std::vector<std::size_t>> DesignEvaluator::groups(std::span<const EvaluationTask> tasks, int /*workers*/) const {
  std::vector<std::vector<std::size_t>> alone;
  alone.reserve(tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) alone.push_back({i});
  return alone;
}

}  // namespace menger::evolution
