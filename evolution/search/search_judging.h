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
#include "evolution/evaluation/design_judge.h"
#include "evolution/search/discrepancy.h"
#include "evolution/search/search_plan.h"

namespace menger::evolution {

/// How an individual stands after what was judged.
struct CorrectedScore {
  Knowledge knowledge = Knowledge::evaluated;  ///< or failed
  std::optional<double> fitness;
};

/// Judgements with what is learnt from them: the fitness that a score of the evaluator stands for.
///
/// A robot that was judged has the judge's score, or none if the judge failed, in all its poses; any other the score that
/// Discrepancy expects of the judge.
class CorrectedFitness {
 public:
  /// @param judgements up to a generation
  CorrectedFitness(const Distinction& distinction, std::span<const Judgement> judgements);

  /// @param body basal @param surrogate its score by the evaluator
  [[nodiscard]] CorrectedScore score(const meshes::Polycube& body, double surrogate) const;

  /// What was found of a robot of this shape, if it was judged.
  [[nodiscard]] const Judgement* judgement_of(const meshes::Polycube& body) const;

  [[nodiscard]] const Discrepancy& discrepancy() const { return discrepancy_; }

 private:
  Distinction distinction_;
  std::map<std::string, Judgement> by_form_;
  Discrepancy discrepancy_;
};

/// A round of judging.
struct JudgingRound {
  int generation = 0;               ///< before which it was
  std::vector<Judgement> judged;    ///< the best first
  std::uint64_t element_steps = 0;  ///< of this and all rounds before
  bool is_exhausted = false;        ///< the budget pays for no further robot: nobody was judged
  bool is_made = false;             ///< now, not found from an interrupted run
};

/// A survivor as a candidate for judging.
struct Nominee {
  std::uint64_t individual = 0;
  int age = 0;
  const Phenotype* phenotype = nullptr;
  std::optional<double> surrogate;  ///< its score by the evaluator
  std::optional<double> fitness;    ///< as it is known before the round
};

/// The judge's part in a search.
class SearchJudging {
 public:
  /// @param plan with a plan of judging @param archive of the search; what it holds of judging is taken up
  SearchJudging(const SearchPlan& plan, DesignJudge& judge, RunArchive& archive);

  /// Whether a generation begins with judging.
  [[nodiscard]] bool is_due(int generation) const;

  /// Judges, before a generation, the best distinct survivors that were not judged yet and that nothing stands against, as many
  /// as the plan says and the budget pays for, and adds them to the archive. What is there of this round is not judged again.
  ///
  /// How much a robot takes is known afterwards only: a round may judge as many as the dearest so far would fit into what is left
  /// of the budget; the first round judges all it may if there is any budget.
  /// @return nothing if `stop` became true
  [[nodiscard]] std::optional<JudgingRound> judge(int generation, std::span<const Nominee> nominees,
                                                  const std::atomic<bool>* stop);

  [[nodiscard]] const CorrectedFitness& fitness() const { return fitness_; }

 private:
  [[nodiscard]] std::vector<Nominee> chosen(std::span<const Nominee> nominees, std::size_t count) const;
  [[nodiscard]] std::size_t affordable() const;
  [[nodiscard]] Judgement judgement(int generation, std::size_t place, const Nominee& nominee, const JudgeResult& result) const;

  const SearchPlan* plan_;
  DesignJudge* judge_;
  RunArchive* archive_;
  std::vector<Judgement> judgements_;
  CorrectedFitness fitness_;
};

/// Element-steps of judgements.
std::uint64_t element_steps_of(std::span<const Judgement> judgements);

}  // namespace menger::evolution
