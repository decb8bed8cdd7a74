#pragma once

#include <string>

#include "evolution/reference/reevaluation_study.h"
#include "meshes/design/polycube.h"

namespace menger::evolution {

/// A run of `menger locomote`.
struct LocomotionJob {
  std::string name;   ///< for people
  std::string study;  ///< content of its study file
  std::string design;
  std::string silicone;
};

/// The study file of a body. @param options finite elements, which may differ from those of the study
std::string locomotion_text(const ReevaluationStudy& study, const LocomotionOptions& options, bool with_frames);

/// All that decides a result beside the body, as text: locomotion_text without what is only shown, and the silicone.
std::string protocol_text(const ReevaluationStudy& study, const LocomotionOptions& options);

LocomotionJob locomotion_job(const ReevaluationStudy& study, const LocomotionOptions& options, const meshes::Polycube& body,
                             const std::string& name, bool with_frames);

}  // namespace menger::evolution
