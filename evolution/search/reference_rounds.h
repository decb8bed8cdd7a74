#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/reference_evaluator.h"
#include "evolution/search/discrepancy.h"
#include "evolution/search/search_plan.h"
#include "evolution/search/survivor.h"

namespace menger::evolution {

/// The fitness of an individual after correction by reference evaluations.
struct CorrectedScore {
  Knowledge knowledge = Knowledge::evaluated;  ///< or failed
  std::optional<double> fitness;
};

/// Turns a score by the surrogate into a fitness, by what reference evaluations have shown so far.
///
/// A robot that has a reference evaluation gets the score of the reference evaluator, or none if that failed, whatever its pose.
/// Any other robot gets the score that Discrepancy predicts for the reference evaluator.
class CorrectedFitness {
 public:
  /// @param distinction what makes two bodies different robots
  /// @param evaluations all reference evaluations of the search so far
  CorrectedFitness(const Distinction& distinction, std::span<const ReferenceEvaluation> evaluations);

  /// Returns the corrected fitness of a robot. @param body its basal body @param surrogate its score by the evaluator of the
  /// search
  [[nodiscard]] CorrectedScore score(const meshes::Polycube& body, double surrogate) const;

  /// Returns the reference evaluation of this robot in any pose, or null if there is none.
  [[nodiscard]] const ReferenceEvaluation* reference_evaluation_of(const meshes::Polycube& body) const;

  [[nodiscard]] const Discrepancy& discrepancy() const { return discrepancy_; }

 private:
  Distinction distinction_;
  std::map<std::string, ReferenceEvaluation> by_form_;
  Discrepancy discrepancy_;
};

/// One round of reference evaluations.
struct ReferenceRound {
  int generation = 0;                          ///< the generation that begins with it
  std::vector<ReferenceEvaluation> evaluated;  ///< the best robot first
  std::uint64_t element_steps = 0;             ///< of this round and all earlier ones
  bool is_exhausted = false;                   ///< the rest of the budget is too small for a robot: none was evaluated
  bool is_made = false;                        ///< robots were evaluated now, not in an earlier run that was interrupted
};

/// Makes the rounds of reference evaluations of a search and learns from them.
class ReferenceRounds {
 public:
  /// @param plan has a plan.reference
  /// @param archive of the search; reference evaluations in it are used, not made again
  ReferenceRounds(const SearchPlan& plan, ReferenceEvaluator& reference, RunArchive& archive);

  /// Returns whether a generation begins with a round of reference evaluations.
  [[nodiscard]] bool is_due(int generation) const;

  /// Makes the round at the beginning of a generation and adds it to the archive. A round that the archive already has is not
  /// made again.
  ///
  /// The round evaluates the best distinct survivors that have no reference evaluation yet and that the reference evaluator can
  /// evaluate, as many as the plan says and the budget pays for. The cost of a robot is known only afterwards. A round may
  /// therefore evaluate as many robots as would fit into the rest of the budget if each cost as much as the most expensive one so
  /// far. The first round evaluates all that the plan allows if there is any budget.
  /// @return nothing if `stop` became true
  [[nodiscard]] std::optional<ReferenceRound> evaluate(int generation, std::span<const Survivor> survivors,
                                                       const std::atomic<bool>* stop);

  [[nodiscard]] const CorrectedFitness& fitness() const { return fitness_; }

 private:
  [[nodiscard]] std::vector<const Survivor*> chosen(std::span<const Survivor> survivors, std::size_t count) const;
  [[nodiscard]] std::size_t affordable() const;
  [[nodiscard]] ReferenceEvaluation evaluation(int generation, std::size_t place, const Survivor& survivor,
                                               const ReferenceResult& result) const;

  const SearchPlan* plan_;
  ReferenceEvaluator* reference_;
  RunArchive* archive_;
  std::vector<ReferenceEvaluation> evaluations_;
  CorrectedFitness fitness_;
};

/// Returns the sum of the element-steps of reference evaluations.
std::uint64_t element_steps_of(std::span<const ReferenceEvaluation> evaluations);

}  // namespace menger::evolution
