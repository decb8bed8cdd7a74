#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/evaluation/workers.h"
#include "io/ranks/rank_team.h"

namespace menger::evolution {

/// The evaluators that every rank of a search has, made from the same study in the same order. A task names them by their place.
class SharedEvaluators {
 public:
  /// Adds an evaluator that outlives this object.
  void add(const DesignEvaluator& evaluator);

  /// Returns the physics of all scenarios of all evaluators: it decides all results.
  [[nodiscard]] const std::string& physics() const { return physics_; }

  /// Returns an evaluator and its scenario with this physics. Precondition: there is one.
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(const std::string& physics) const;

  /// Evaluates the bodies of a message; see io::RankWork.
  [[nodiscard]] std::string evaluate(const std::string& task, const std::atomic<bool>& stop, const ThreadsNow& threads) const;

 private:
  std::vector<const DesignEvaluator*> evaluators_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> places_;  ///< by physics
  std::string physics_;
};

/// Lets all ranks evaluate bodies; the only one may be this process. Every result equals that of threads of this process.
class RankWorkers final : public Workers, public TaskStream {
 public:
  /// @param team whose work is SharedEvaluators::evaluate @param shared as on the other ranks; both outlive this object
  RankWorkers(io::RankTeam& team, const SharedEvaluators& shared) : team_(team), shared_(shared) {}

  /// @param evaluator whose scenarios are among those that the ranks share
  [[nodiscard]] io::RunStatus run(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                                  const std::atomic<bool>* stop, const Workers::Finished& finished) const override;

  /// @param evaluator as for run()
  [[nodiscard]] io::RunStatus run_stream(const DesignEvaluator& evaluator, std::vector<EvaluationTask> tasks,
                                         const std::atomic<bool>* stop, const TaskStream::Finished& finished) const override;
  [[nodiscard]] int threads() const override { return team_.threads(); }

 private:
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> places_of(const DesignEvaluator& evaluator) const;

  io::RankTeam& team_;
  const SharedEvaluators& shared_;
};

}  // namespace menger::evolution
