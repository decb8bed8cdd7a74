#include "evolution/report/study_view.h"

#include <vector>

#include "evolution/evaluation/scenario_evaluator.h"
#include "evolution/study/scenarios.h"
#include "evolution/study/voxel_evaluator.h"
#include "evolution/study/walk_evaluator.h"

namespace menger::evolution {

namespace {

std::unique_ptr<DesignEvaluator> voxels_of(const Study& study) {
  return std::make_unique<VoxelEvaluator>(study.physics, study.search.cell_edge_m, study.duration_s, study.measure_from_s,
                                          measured_periods(study));
}

}  // namespace

std::vector<std::unique_ptr<DesignEvaluator>> scenario_evaluators_of(const Study& study) {
  std::vector<std::unique_ptr<DesignEvaluator>> all;
  for (const Scenario& scenario : scenarios_of(study))
    all.push_back(std::make_unique<WalkEvaluator>(in_scenario(study, scenario)));
  if (all.empty()) all.push_back(std::make_unique<WalkEvaluator>(study));
  return all;
}

std::unique_ptr<DesignEvaluator> evaluator_of(const Study& study) {
  if (study.robust) return std::make_unique<ScenarioEvaluator>(scenario_evaluators_of(study));
  if (uses_elements(study)) return std::make_unique<WalkEvaluator>(study);
  return voxels_of(study);
}

std::unique_ptr<DesignEvaluator> screening_evaluator_of(const Study& study) {
  return study.search.screening ? voxels_of(study) : nullptr;
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
          .has_elements = uses_elements(study)};
}

}  // namespace menger::evolution
