#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/reference/reevaluation_study.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_options.h"
#include "meshes/design/polycube.h"
#include "voxel/engine/frame.h"
#include "voxel/scene/trajectory.h"

namespace menger::evolution {

/// A basal body as a design with the cells of the search.
meshes::Design design_of(const ReevaluationStudy& study, const meshes::Polycube& body);

/// How finite elements hollow it out.
meshes::HollowBodyOptions casting_of(const ReevaluationStudy& study, int elements_through_wall);

/// Why a body cannot be cast, or its chambers cannot be driven as the search drives its voxels; empty if nothing stands against
/// it. @param body basal, standing
std::string obstacle_to_judging(const ReevaluationStudy& study, const meshes::Polycube& body);

/// A body on the surrogate, as the search moves it.
struct SurrogateWalk {
  Evaluation result;
  voxel::Trajectory trajectory;      ///< at every multiple of the record interval, and at the end
  std::vector<voxel::Frame> frames;  ///< at every multiple of the frame interval, if asked for
};

/// Precondition: obstacle_to_judging says nothing. Deterministic and thread-safe.
SurrogateWalk surrogate_walk(const ReevaluationStudy& study, const meshes::Polycube& body, bool with_frames,
                             const std::atomic<bool>* stop);

}  // namespace menger::evolution
