#pragma once

#include <string>

#include "evolution/reference/reevaluation_study.h"
#include "fem/locomotion/locomotion_study.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// A walk on finite elements that is to be made.
struct LocomotionJob {
  std::string name;            ///< for people
  fem::LocomotionStudy study;  ///< as stated, see locomotion_study
};

/// The walk of a body on finite elements: body, drive, ground and times as the search has them. What follows from these (mesh,
/// ground of that mesh, supply; see fem::prepare) is left out.
/// @param options finite elements, which may differ from those of the study
fem::LocomotionStudy locomotion_study(const ReevaluationStudy& study, const LocomotionOptions& options,
                                      const meshes::Polycube& body, bool with_frames);

/// All that decides a result beside the body, as text: equal texts mean that results of one body are equal.
std::string protocol_text(const ReevaluationStudy& study, const LocomotionOptions& options);

/// Such a walk as a job. @param name for people
LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames);

}  // namespace menger::evolution
