#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "evolution/archive/pool_member.h"

namespace menger::evolution {

/// Whether selection from a partly evaluated pool is settled, and which evaluations it still needs.
struct SelectionOutlook {
  /// Returns whether selection is settled: the survivors and the random numbers drawn for them depend on nothing that is still
  /// unknown.
  [[nodiscard]] bool certain() const { return blocking.empty(); }

  /// Ids of the undecided individuals on which selection still depends, in the order in which to evaluate them: by lower bound of
  /// the level ascending, fitness bound descending, age ascending, newest first. It is enough to evaluate these.
  std::vector<std::uint64_t> blocking;

  /// Those of `blocking` whose next evaluation should run now, in the same order: those without any evaluation, and those that
  /// stay blocking whatever the evaluations of the others give. Not empty if `blocking` is not.
  std::vector<std::uint64_t> run_now;
};

/// Finds out whether the result of select_survivors is already settled for a partly evaluated pool, and if not, what to evaluate
/// next.
///
/// The level of an individual i (see domination_levels) is at least low(i): the number of individuals that dominate it for
/// certain, plus 2N if it has failed, with N survivors. An undecided j dominates only failed individuals for certain. A decided j
/// dominates an undecided i for certain if it dominates i at i's bound. Let l be the least level for which at least N individuals
/// have low <= l, and let S be these individuals. Selection is certain when S has no undecided member. Proof:
///
/// First, the levels of the members of S are exact. Suppose that an undecided j might dominate a decided i of S. Then everyone
/// who dominates j for certain also dominates i for certain, so low(j) <= low(i), and j is in S: a contradiction.
///
/// Second, all others have a level above l. So the levels up to l consist of members of S, whose levels, fitness and ages are
/// known. Since S has N members, selection ends within these levels. The survivors, their order and the random numbers drawn are
/// therefore those of the full evaluation.
///
/// Later results can only raise low and l. So i leaves S only by its own evaluation, or if undecided individuals turn out to
/// dominate it that are no older than i and whose bound is at least that of i. If there are too few of these to raise low(i)
/// above l, this proof cannot save the evaluation of i, and it runs now. Hence, apart from first evaluations, evaluating
/// `run_now` until selection is certain makes no evaluation that another order among the `blocking` ones would save.
SelectionOutlook outlook(std::span<const PoolMember> pool, std::size_t survivors);

}  // namespace menger::evolution
