#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"

namespace menger::evolution {

/// Evaluates bodies in several scenarios, such as on grounds of different friction: each task in its own.
class ScenarioEvaluator final : public DesignEvaluator {
 public:
  /// @param scenarios an evaluator for each, at least one
  explicit ScenarioEvaluator(std::vector<std::unique_ptr<DesignEvaluator>> scenarios);

  /// Evaluates a body in the first scenario. The tasks that are evaluated together may have any.
  [[nodiscard]] Evaluation evaluate(const meshes::Polycube& body, int level, const std::atomic<bool>& stop) const override;
  [[nodiscard]] std::vector<Evaluation> evaluate_together(std::span<const EvaluationTask* const> tasks,
                                                          const std::atomic<bool>& stop,
                                                          const ThreadsNow& threads) const override;

  /// Divides tasks as the evaluators of their scenarios do: no group has tasks of two scenarios.
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups(std::span<const EvaluationTask> tasks, int workers) const override;

  /// Returns the physics of the first scenario.
  [[nodiscard]] std::string physics() const override;
  [[nodiscard]] std::vector<std::string> scenarios() const override;
  /// Returns the remarks of all scenarios: "in scenario 2: ...", in their order from 1.
  [[nodiscard]] std::string remark() const override;
  [[nodiscard]] double cost(const meshes::Polycube& body, int level) const override;

 private:
  std::vector<std::unique_ptr<DesignEvaluator>> scenarios_;
};

}  // namespace menger::evolution
