#pragma once

#include "evolution/archive/run_archive.h"
#include "evolution/report/generation_summary.h"
#include "evolution/study/study.h"
#include "evolution/study/voxel_evaluator.h"

namespace menger::evolution {

/// The evaluator of a study.
VoxelEvaluator evaluator_of(const Study& study);

/// The same with half its time step.
VoxelEvaluator half_step_evaluator_of(const Study& study);

/// An archive with what tables need to know of its study. @param archive outlives the view
RunView view_of(const RunArchive& archive, const Study& study);

}  // namespace menger::evolution
