#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/design_judge.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/search/search_judging.h"
#include "evolution/search/search_plan.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// How far the evaluations of the present generation are.
struct SearchProgress {
  int generation = 0;
  std::size_t finished = 0;   ///< evaluations of this generation that are done
  std::size_t requested = 0;  ///< evaluations of this generation so far: more may follow
};

/// How a search is run, never what comes out of it.
struct SearchOptions {
  int threads = 1;                          ///< >= 1
  const std::atomic<bool>* stop = nullptr;  ///< ends the search soon; evaluations under way are given up
  std::function<void(const GenerationRecord&)> generation_done;
  std::function<void(const SearchProgress&)> progress;

  /// Called after every round of judging, with what was learnt so far.
  std::function<void(const JudgingRound&, const Discrepancy&)> judged{};
  std::function<void(std::size_t count)> after_commit;  ///< called when the archive has grown for the count-th time, from 1
};

/// Age-fitness Pareto search, from where the archive stops until plan.generations are done.
///
/// Generation 0: random individuals, all evaluated in full, all survive. Every later one: the survivors grow older by 1; each of
/// them, in random order, has a child of its age; random newcomers of age 0 join; survivors are selected from all
/// (select_survivors). The fitness is the least score over the levels; an individual with an evaluation that did not complete has
/// none. Results are shared by equal designs. With plan.pruning, levels of later generations are evaluated from the smallest on
/// and only as long as outlook() asks for them.
///
/// What is decided depends on results only between batches of evaluations, never on their order within one: the archive's content
/// does not depend on the number of threads, nor on where the search was interrupted.
///
/// With plan.judging a generation that is due begins with a round of judging (SearchJudging): the best distinct survivors of the
/// generation before are judged by a dearer model, all survivors are scored again with what was learnt (CorrectedFitness), and
/// the new individuals' scores go through the same correction. Once the budget is spent, the search goes on with the correction
/// learnt. The fitness that the archive keeps of a contender is the corrected one; scores of the evaluator stay as they are.
/// Pruning needs no change: with the one level that judging allows, a score is either unknown, without a bound, or final, and
/// corrected as soon as it is known; outlook() never sees a bound that a correction could lift.
///
/// With plan.step_checks the elites of every generation that is due are evaluated again with half the time step before the
/// generation is finished (StepChecking). What is found changes nothing else.
///
/// @param archive of this plan and evaluator @param judge exactly with plan.judging, whose protocol is the judge's
/// @param half_step exactly with plan.step_checks: the evaluator with half its time step
/// @return completed, or stopped
/// @throws io::InputError if the constraints of the plan cannot be met or the archive cannot be written
io::RunStatus run_search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                         const SearchOptions& options, DesignJudge* judge = nullptr, const DesignEvaluator* half_step = nullptr);

}  // namespace menger::evolution
