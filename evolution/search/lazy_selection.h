#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "evolution/search/age_fitness_pareto.h"

namespace menger::evolution {

/// What is known so far of an individual whose fitness is the minimum over several evaluations.
struct PartialContestant {
  std::uint64_t id = 0;
  int age = 0;

  bool decided = false;             ///< nothing remains to be evaluated: `fitness` is the truth
  std::optional<double> fitness{};  ///< when decided: the fitness, or none if it failed

  /// When not decided: the fitness is at most this (the minimum of what was evaluated), or there will be none.
  double bound = std::numeric_limits<double>::infinity();

  /// When not decided: whether any evaluation was made.
  [[nodiscard]] bool untouched() const { return !decided && bound == std::numeric_limits<double>::infinity(); }
};

/// What selection can say of a partly evaluated pool.
struct SelectionOutlook {
  /// The survivors and the random numbers drawn for them do not depend on anything that is still unknown.
  [[nodiscard]] bool certain() const { return blocking.empty(); }

  /// Ids of the undecided individuals that stand in the way of certainty, in the order of the next ones to evaluate: lower bound
  /// of the level ascending, bound descending, age ascending, newest first. Evaluating these and no others always leads on.
  std::vector<std::uint64_t> blocking;

  /// Those of `blocking` whose next evaluation should run now: the untouched ones, and those that will still be blocking whatever
  /// the evaluations of the others give. Never empty when `blocking` is not. Same order.
  std::vector<std::uint64_t> run_now;
};

/// Decides whether select_survivors is already settled for a partly evaluated pool, and if not, what to evaluate next.
///
/// Individual i has a level (see domination_levels) that is at least low(i): the number of those that dominate it for certain,
/// plus 2N if it failed for certain (N survivors). An undecided j dominates nobody for certain but the failed; a decided j
/// dominates an undecided i for certain if it would at i's bound. Let l be the least level with at least N individuals of
/// low <= l, and S these individuals. Selection is certain when S holds no undecided one:
///
/// First, the members of S have exact levels. If an undecided j might dominate a decided i of S, then whoever dominates j for
/// certain dominates i for certain, so low(j) <= low(i) and j is in S, against the assumption.
///
/// Second, all others have a level above l. So the levels up to l consist of members of S, whose levels, fitness and ages are
/// known, and since S has N members, selection ends within these levels: the survivors, their order and the random numbers drawn
/// are those of the full evaluation.
///
/// What is learnt later only raises low and l, and i leaves S only by its own evaluation or by undecided ones of no greater age
/// whose bound is not below i's turning out to dominate it. If there are too few of those to lift low(i) above l, i's evaluation
/// cannot be saved by this proof: it runs now. Hence, first evaluations apart, evaluating `run_now` until certainty makes no
/// evaluation that another order among `blocking` ones would save.
SelectionOutlook outlook(std::span<const PartialContestant> pool, std::size_t survivors);

/// The contestants for select_survivors once the outlook is certain: undecided ones, which cannot survive, stand as failed.
///
/// Undecided ones have levels beyond those that are filled either way, so that select_survivors gives what it would give after
/// full evaluation.
std::vector<Contestant> settled(std::span<const PartialContestant> pool);

}  // namespace menger::evolution
