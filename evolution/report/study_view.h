#pragma once

#include "evolution/archive/run_archive.h"
#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"
#include "evolution/study/voxel_evaluator.h"

namespace menger::evolution {

/// Returns the evaluator of a study.
VoxelEvaluator evaluator_of(const Study& study);

/// Returns the evaluator of a study with half its time step.
VoxelEvaluator half_step_evaluator_of(const Study& study);

/// Returns an archive together with everything that tables need of its study. @param archive outlives the view
RunView view_of(const RunArchive& archive, const Study& study);

}  // namespace menger::evolution
