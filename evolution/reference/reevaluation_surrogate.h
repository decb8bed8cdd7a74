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

/// Returns a basal body as a design with the cell edge of the search.
meshes::Design design_of(const ReevaluationStudy& study, const meshes::Polycube& body);

/// Returns how the design is made hollow for finite elements: walls, chambers and level.
meshes::HollowBodyOptions casting_of(const ReevaluationStudy& study, const LocomotionOptions& elements);

/// Returns why finite elements cannot evaluate a body: it cannot be cast, its chambers cannot be driven as the search drives its
/// voxels, or it is outside of the calibration. Empty if they can. @param body basal, standing
std::string obstacle_to_reference(const ReevaluationStudy& study, const meshes::Polycube& body);

/// Returns the displacements in the whole periods of a trajectory that begins at time 0, linear between its points.
PeriodDisplacements period_displacements_m(const voxel::Trajectory& trajectory, double period_s, double duration_s);

/// The motion of a body in the model of the search, computed as the search does it: on the surrogate, or on its finite elements.
struct SurrogateWalk {
  Evaluation result;
  voxel::Trajectory trajectory;  ///< at every multiple of the record interval, and at the end
  /// At every multiple of the frame interval, if asked for; finite elements give none.
  std::vector<voxel::Frame> frames;
};

/// Moves a body in the model of the search. Deterministic and thread-safe. Precondition: obstacle_to_reference returns an empty
/// text.
SurrogateWalk surrogate_walk(const ReevaluationStudy& study, const meshes::Polycube& body, bool with_frames,
                             const std::atomic<bool>* stop);

}  // namespace menger::evolution
