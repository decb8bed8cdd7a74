#pragma once

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/search/search.h"
#include "evolution/search/search_plan.h"
#include "io/text/run_status.h"

namespace menger::evolution {

/// Runs a search in which no robot waits for another one, from where the archive stops until plan.generations are done, or
/// options.ends_with ends it. For a plan with SelectionTime::steady_state, see run_search.
///
/// Robots are numbered by birth. As many are under way as the stream has threads, each at one level at a time. A robot ends when
/// all its levels are known: then it joins the population, of which select_survivors leaves one out if there are more than
/// plan.survivors, and others are born until all threads have a robot again. A robot is a child of a member of the population,
/// each with the same chance; of every mutants + newcomers births the last `newcomers` are random, and so is one that is born
/// before a robot has ended.
///
/// A generation is a stretch of results: the first plan.survivors, then mutants + newcomers each. A robot belongs to that in
/// which it ended. Its age is the number of results since its first ancestor was born, over those of a generation, as a whole
/// number.
///
/// All that happens follows from the plan and the order of births and ends, which the archive has (RunArchive::events). Robot n
/// draws all its random numbers, that of its parent as well, from a stream that depends on the seed and n alone. A search that
/// was stopped repeats what its archive has, and goes on. One with options.replayed follows that order: its archive has the same
/// content, whatever workers it has.
///
/// @param evaluator with one scenario @param archive of this plan and evaluator
/// @return completed, or stopped
/// @throws io::InputError if the constraints of the plan cannot be met, the archive cannot be written, or its order or
/// options.replayed is not that of a search of this plan
io::RunStatus run_steady_search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                                const SearchOptions& options);

}  // namespace menger::evolution
