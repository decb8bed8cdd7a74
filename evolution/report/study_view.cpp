#include "evolution/report/study_view.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "evolution/evaluation/scenario_evaluator.h"
#include "evolution/study/half_walk_evaluator.h"
#include "evolution/study/scenarios.h"
#include "evolution/study/voxel_evaluator.h"
#include "evolution/study/walk_evaluator.h"

namespace menger::evolution {

namespace {

/// Voxels that screen do not tell falls: finite elements decide whether a body has fallen.
std::unique_ptr<DesignEvaluator> voxels_of(const Study& study) {
  return std::make_unique<VoxelEvaluator>(study.physics, study.search.cell_edge_m, study.duration_s, study.measure_from_s,
                                          measured_periods(study), study.device,
                                          study.model == EvaluationModel::voxels ? study.largest_lean_deg : 180.0);
}

bool are_halved(const Study& study) { return study.search.screening && study.search.screening->by == Screener::half_walks; }

/// Returns an evaluator for each scenario. @param paused walks of the first one, which go on; may be null
std::vector<std::unique_ptr<DesignEvaluator>> scenario_evaluators(const Study& study,
                                                                  const std::shared_ptr<PausedWalks>& paused) {
  std::vector<std::unique_ptr<DesignEvaluator>> all;
  for (const Scenario& scenario : scenarios_of(study)) {
    const Study one = in_scenario(study, scenario);
    if (uses_elements(study))
      all.push_back(std::make_unique<WalkEvaluator>(one, all.empty() ? paused : nullptr));
    else
      all.push_back(voxels_of(one));
  }
  if (all.empty()) all.push_back(std::make_unique<WalkEvaluator>(study, paused));
  return all;
}

std::unique_ptr<DesignEvaluator> evaluator_with(const Study& study, const std::shared_ptr<PausedWalks>& paused) {
  if (study.robust) return std::make_unique<ScenarioEvaluator>(scenario_evaluators(study, paused));
  if (uses_elements(study)) return std::make_unique<WalkEvaluator>(study, paused);
  return voxels_of(study);
}

std::unique_ptr<DesignEvaluator> screening_with(const Study& study, const std::shared_ptr<PausedWalks>& paused) {
  if (!study.search.screening) return nullptr;
  if (!are_halved(study)) return voxels_of(study);
  return std::make_unique<HalfWalkEvaluator>(study.robust ? in_scenario(study, scenarios_of(study).front()) : study, paused);
}

}  // namespace

std::vector<std::unique_ptr<DesignEvaluator>> scenario_evaluators_of(const Study& study) {
  return scenario_evaluators(study, nullptr);
}

std::unique_ptr<DesignEvaluator> evaluator_of(const Study& study) { return evaluator_with(study, nullptr); }

std::unique_ptr<DesignEvaluator> screening_evaluator_of(const Study& study) { return screening_with(study, nullptr); }

SearchEvaluators search_evaluators_of(const Study& study) {
  std::shared_ptr<PausedWalks> paused;
  if (are_halved(study)) {
    // Each takes some megabytes. A walk that is not kept begins anew, which takes time and changes no result.
    constexpr int most_paused = 200;
    const SearchPlan& plan = study.search;
    const int born = std::max(plan.survivors, plan.mutants + plan.newcomers);
    paused = std::make_shared<PausedWalks>(static_cast<std::size_t>(std::min(born, most_paused)));
  }
  return {.evaluator = evaluator_with(study, paused), .screening = screening_with(study, paused)};
}

std::unique_ptr<DesignEvaluator> half_step_evaluator_of(const Study& study) {
  Study finer = study;
  finer.physics.integration.time_step_fraction *= 0.5;
  finer.silicone.step_safety *= 0.5;
  return evaluator_of(finer);
}

RunView view_of(const RunArchive& archive, const Study& study) {
  return {.archive = &archive,
          .plan = study.search,
          .physics = evaluator_of(study)->physics(),
          .scenario_physics = evaluator_of(study)->scenarios(),
          .screening_physics = study.search.screening ? screening_evaluator_of(study)->physics() : "",
          .half_step_physics = half_step_evaluator_of(study)->physics(),
          .voxels_per_cell = voxels_in_cell(study),
          .has_elements = uses_elements(study),
          .is_per_period = study.measure == Measure::last_periods};
}

}  // namespace menger::evolution
