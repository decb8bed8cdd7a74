#include "evolution/evaluation/scenario_evaluator.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "io/text/joined_text.h"

namespace menger::evolution {

ScenarioEvaluator::ScenarioEvaluator(std::vector<std::unique_ptr<DesignEvaluator>> scenarios) : scenarios_(std::move(scenarios)) {
  assert(!scenarios_.empty());
}

Evaluation ScenarioEvaluator::evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const {
  return scenarios_.front()->evaluate(body, level, stop);
}

std::vector<Evaluation> ScenarioEvaluator::evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                             const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  const auto scenario_of = [](const EvaluationTask* task) { return task->scenario; };
  std::vector<Evaluation> results;
  results.reserve(tasks.size());
  for (auto begin = tasks.begin(); begin != tasks.end();) {
    const auto end = std::find_if(begin, tasks.end(), [&](const auto* task) { return task->scenario != scenario_of(*begin); });
    std::vector<Evaluation> of_one = scenarios_.at(scenario_of(*begin))->evaluate_together({begin, end}, stop, threads);
    std::ranges::move(of_one, std::back_inserter(results));
    begin = end;
  }
  return results;
}

std::vector<std::vector<std::size_t>> ScenarioEvaluator::groups(std::span<const EvaluationTask> tasks, int workers) const {
  std::vector<std::vector<std::size_t>> all;
  for (std::size_t scenario = 0; scenario < scenarios_.size(); ++scenario) {
    std::vector<EvaluationTask> own;
    std::vector<std::size_t> places;
    for (std::size_t n = 0; n < tasks.size(); ++n) {
      if (tasks[n].scenario != scenario) continue;
      own.push_back(tasks[n]);
      places.push_back(n);
    }
    if (own.empty()) continue;
    for (std::vector<std::size_t>& group : scenarios_[scenario]->groups(own, workers)) {
      for (std::size_t& place : group) place = places[place];
      all.push_back(std::move(group));
    }
  }
  return all;
}

std::string ScenarioEvaluator::physics() const { return scenarios_.front()->physics(); }

std::vector<std::string> ScenarioEvaluator::scenarios() const {
  std::vector<std::string> all;
  all.reserve(scenarios_.size());
  for (const auto& scenario : scenarios_) all.push_back(scenario->physics());
  return all;
}

std::string ScenarioEvaluator::remark() const {
  std::vector<std::string> all;
  for (std::size_t n = 0; n < scenarios_.size(); ++n) {
    const std::string one = scenarios_[n]->remark();
    if (!one.empty()) all.push_back("in scenario " + std::to_string(n + 1) + ": " + one);
  }
  return io::joined(all, "; ");
}

double ScenarioEvaluator::cost(const meshes::Polycube& body, int level) const { return scenarios_.front()->cost(body, level); }

}  // namespace menger::evolution
