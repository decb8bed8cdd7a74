#include "evolution/report/study_view.h"

namespace menger::evolution {

VoxelEvaluator evaluator_of(const Study& study) {
  return {study.physics, study.search.cell_edge_m, study.duration_s, study.measure_from_s};
}

VoxelEvaluator half_step_evaluator_of(const Study& study) {
  Study finer = study;
  finer.physics.integration.time_step_fraction *= 0.5;
  return evaluator_of(finer);
}

RunView view_of(const RunArchive& archive, const Study& study) {
  return {.archive = &archive,
          .plan = study.search,
          .physics = evaluator_of(study).physics(),
          .half_step_physics = half_step_evaluator_of(study).physics(),
          .distinction = distinction_of(study),
          .voxels_per_cell = voxels_in_cell(study)};
}

}  // namespace menger::evolution
