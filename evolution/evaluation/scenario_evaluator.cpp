#include "evolution/evaluation/scenario_evaluator.h"

#include <cassert>
#include <utility>

namespace menger::evolution {

ScenarioEvaluator::ScenarioEvaluator(std::vector<std::unique_ptr<DesignEvaluator>> scenarios) : scenarios_(std::move(scenarios)) {
  assert(!scenarios_.empty());
}

Evaluation ScenarioEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  return scenarios_.front()->evaluate(body, level, stop);
}

std::vector<Evaluation> ScenarioEvaluator::evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                             const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  std::vector<Evaluation> results;
  results.reserve(tasks.size());
  for (const EvaluationTask* const& task : tasks)
    results.push_back(scenarios_.at(task->scenario)->evaluate_together({&task, 1}, stop, threads).front());
  return results;
}

std::string ScenarioEvaluator::physics() const { return scenarios_.front()->physics(); }

std::vector<std::string> ScenarioEvaluator::scenarios() const {
  std::vector<std::string> all;
  all.reserve(scenarios_.size());
  for (const auto& scenario : scenarios_) all.push_back(scenario->physics());
  return all;
}

double ScenarioEvaluator::cost(const meshes::Polycube& body, int level) const { return scenarios_.front()->cost(body, level); }

}  // namespace menger::evolution
