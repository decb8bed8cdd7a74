#pragma once

#include <optional>

#include "fem/contact/rigid_ground.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// The ground as a study describes it.
struct StudyGround {
  std::optional<double> height_m{};            ///< nothing: the height of the body's lowest point
  std::optional<double> stiffness_Pa_per_m{};  ///< > 0; nothing: see ground_stiffness_Pa_per_m
  Friction friction;                           ///< `forward` may have any length but 0

  /// Returns the ground with the given values. Missing ones take the usual values, and `forward` becomes a unit vector.
  [[nodiscard]] RigidGround ground(double usual_height_m, double usual_stiffness_Pa_per_m) const;
};

/// Names the keys of a ground, with a table `directional` for friction that depends on the direction.
void describe(io::StudyVisitor& visitor, StudyGround& ground);

}  // namespace menger::fem
