#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/evaluation/workers.h"
#include "evolution/search/screening.h"
#include "evolution/search/search_plan.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Progress of the evaluations of the present generation.
struct SearchProgress {
  int generation = 0;
  std::size_t finished = 0;   ///< evaluations of this generation that are done; in a steady-state search, robots
  std::size_t requested = 0;  ///< evaluations of this generation so far; more may follow
};

/// Options that decide how a search runs. They do not change its results, but for ends_with, and in a steady-state search the
/// number of threads and the order in `replayed`.
struct SearchOptions {
  int threads = 1;                          ///< >= 1, of this process if it has no other workers
  const std::atomic<bool>* stop = nullptr;  ///< when set, the search ends soon and drops the evaluations that are running
  std::function<void(const GenerationRecord&)> generation_done;
  std::function<void(const SearchProgress&)> progress;

  /// Asked after every finished generation: whether the search ends with it, although the plan has more. None: it does not.
  std::function<bool(int generation)> ends_with{};

  /// Called after every screening of new individuals.
  std::function<void(const ScreeningRound&)> screened{};
  std::function<void(std::size_t count)> after_commit;  ///< called when the archive has grown for the count-th time, from 1

  const Workers* workers = nullptr;  ///< who evaluates; null: `threads` of this process

  const TaskStream* stream = nullptr;   ///< who evaluates in a steady-state search; given for such a one
  std::vector<SearchEvent> replayed{};  ///< the order that a steady-state search follows before it goes its own way

  /// Lets the workers evaluate tasks, see Workers::run.
  [[nodiscard]] io::RunStatus evaluate(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                                       const Workers::Finished& finished) const;
};

/// Runs an age-fitness Pareto search, from where the archive stops until plan.generations are done, or options.ends_with ends it.
///
/// Generation 0 consists of random individuals; all are evaluated in full, and all survive. In every later generation the
/// survivors grow older by 1. Each of them, in random order, has a child of its age. Random newcomers of age 0 join. Survivors
/// are then selected from all of these (select_survivors). The fitness is the least score over the levels, each that of its worst
/// scenarios (known_score); an individual with an evaluation that did not complete has none. Equal designs share their results.
/// With plan.pruning, levels of later generations are evaluated from the smallest on, and scenario by scenario, only as long as
/// outlook() asks for them.
///
/// With SelectionTime::steady_state, survivors are selected as soon as a robot is evaluated; see run_steady_search, which this
/// calls. The following is about other searches.
///
/// With plan.map_elites, the fittest of every niche survives instead, from generation 0 on (Selection), and each child has a
/// parent that is drawn from the survivors.
///
/// Decisions use results only between batches of evaluations, and never the order of results within a batch. The content of the
/// archive therefore does not depend on the number of threads, nor on where the search was interrupted.
///
/// With plan.screening, new individuals are first evaluated by a surrogate (Screening). Those that it ranks low, and that are not
/// drawn, have no fitness. Only results of the evaluator decide survival.
///
/// With plan.step_checks, the elites of every generation that is due are evaluated again with half the time step before the
/// generation is finished (StepChecking). The outcome changes nothing else.
///
/// @param evaluator with as many scenarios as the plan
/// @param archive of this plan and evaluator
/// @param half_step given exactly if there is a plan.step_checks: the evaluator with half its time step
/// @param surrogate given exactly if there is a plan.screening
/// @return completed, or stopped
/// @throws io::InputError if the constraints of the plan cannot be met or the archive cannot be written
io::RunStatus run_search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                         const SearchOptions& options, const DesignEvaluator* half_step = nullptr,
                         const DesignEvaluator* surrogate = nullptr);

}  // namespace menger::evolution
