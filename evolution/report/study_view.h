#pragma once

#include <memory>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"

namespace menger::evolution {

/// Returns the evaluator of a study.
std::unique_ptr<DesignEvaluator> evaluator_of(const Study& study);

/// Returns an evaluator for each scenario of a study on finite elements, see scenarios_of; one without scenarios.
std::vector<std::unique_ptr<DesignEvaluator>> scenario_evaluators_of(const Study& study);

/// Returns what screens the new bodies of a study, voxels or the first halves of walks; null if nothing does.
std::unique_ptr<DesignEvaluator> screening_evaluator_of(const Study& study);

/// The evaluators of a search.
struct SearchEvaluators {
  std::unique_ptr<DesignEvaluator> evaluator;
  std::unique_ptr<DesignEvaluator> screening;  ///< see screening_evaluator_of
};

/// Returns the evaluators of a search. Walks that pass the screening by their first half go on from there.
SearchEvaluators search_evaluators_of(const Study& study);

/// Returns the evaluator of a study with half its time step.
std::unique_ptr<DesignEvaluator> half_step_evaluator_of(const Study& study);

/// Returns an archive together with everything that tables need of its study. @param archive outlives the view
RunView view_of(const RunArchive& archive, const Study& study);

}  // namespace menger::evolution
