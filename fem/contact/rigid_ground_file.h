#pragma once

#include <optional>

#include "fem/contact/rigid_ground.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// A ground as a study gives it.
struct StudyGround {
  std::optional<double> height_m{};            ///< nothing: where the body's lowest point is
  std::optional<double> stiffness_Pa_per_m{};  ///< > 0; nothing: see ground_stiffness_Pa_per_m
  Friction friction;                           ///< its direction `forward` of any length but 0

  /// What was given, stated and unit vectors made.
  [[nodiscard]] RigidGround ground(double usual_height_m, double usual_stiffness_Pa_per_m) const;
};

/// The keys of a ground, with a table `directional` for friction that depends on the direction.
void describe(io::StudyVisitor& visitor, StudyGround& ground);

}  // namespace menger::fem
