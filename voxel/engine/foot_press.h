#pragma once

// The contact of one voxel's feet with the ground, for FootContact and for graphics processors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "voxel/laws/ground.h"
#include "voxel/laws/rotation.h"
#include "voxel/model/wall_feet.h"

namespace menger::voxel {

/// What a foot remembers from one step to the next.
struct FootGrip {
  bool touches = false;
  bool slides = false;
  double anchor[2] = {0.0, 0.0};  ///< m, in the world

  MENGER_HOST_DEVICE void lift() { touches = slides = false; }
};

/// What the ground exerts on a voxel: a force (N) and a moment (N m) about its centre, both along the axes of the world.
struct FootLoad {
  Vector3<double> force{0.0, 0.0, 0.0};
  Vector3<double> moment{0.0, 0.0, 0.0};
};

/// The contact of a voxel in a step.
struct FeetState {
  FootLoad pressing, friction;
  bool touches = false;
  bool sticks = false;  ///< all feet that touch stick
};

/// Position, motion and orientation of a voxel, in the world.
struct FootBody {
  Vector3<double> place, velocity, spin;
  Rotation<double> turn;
};

/// Heights (m) that decide which feet are far above the ground.
struct GroundReach {
  double ground_m;       ///< of the ground in the world
  double bulge_m;        ///< largest bulge of any wall
  double half_length_m;  ///< largest of any voxel

  [[nodiscard]] MENGER_HOST_DEVICE double highest_m() const { return ground_m + bulge_m + std::sqrt(3.0) * half_length_m; }
};

/// Computes the contact of a foot and adds its loads to those of its voxel.
/// @param share of a foot, see WallFoot
/// @param arm from the centre of the voxel to the foot
MENGER_HOST_DEVICE inline void press_foot(FootGrip& foot, double share, FeetState& state, const FootBody& body,
                                          const FloorCoefficients<double>& floor, double ground_m, const Vector3<double>& arm) {
  const Vector3<double> place = body.place + arm;
  const double depth = ground_m - place.z;
  if (depth < 0.0) {
    foot.lift();
    return;
  }
  const Vector3<double> velocity = body.velocity + cross(body.spin, arm);
  const double stiffness = share / feet_of_a_wall * floor.stiffness;
  const double damping = share / feet_of_a_wall * floor.damping;
  const Vector3<double> push{0.0, 0.0, std::max(stiffness * depth - damping * velocity.z, 0.0)};
  if (!foot.touches) {
    foot.anchor[0] = place.x;
    foot.anchor[1] = place.y;
  }
  const Vector3<double> spring{stiffness * (foot.anchor[0] - place.x), stiffness * (foot.anchor[1] - place.y), 0.0};
  const Vector3<double> drag = damping * Vector3<double>{velocity.x, velocity.y, 0.0};
  Vector3<double> hold = spring - drag;
  const double wanted = std::sqrt(dot(hold, hold));
  // Written, like the push, so that a force that is not finite is passed on instead of vanishing.
  foot.slides = !(wanted <= (foot.slides ? floor.kinetic_friction : floor.static_friction) * push.z);
  if (foot.slides) {
    hold = (wanted > 0.0 ? floor.kinetic_friction * push.z / wanted : 0.0) * hold;
    foot.anchor[0] = place.x + (hold.x + drag.x) / stiffness;
    foot.anchor[1] = place.y + (hold.y + drag.y) / stiffness;
  }
  foot.touches = true;
  state.sticks = (state.sticks || !state.touches) && !foot.slides;
  state.touches = true;
  state.pressing = {state.pressing.force + push, state.pressing.moment + cross(arm, push)};
  state.friction = {state.friction.force + hold, state.friction.moment + cross(arm, hold)};
}

/// Returns the contact of all feet of a voxel that is not above GroundReach::highest_m.
/// @param foot_of (number of the foot) -> WallFoot or its like; grip_of (number) -> FootGrip&
/// @param bulge_of see stands_out_m
template <class FootOf, class GripOf, class BulgeOf>
MENGER_HOST_DEVICE FeetState press_feet(std::size_t count, const FootOf& foot_of, const GripOf& grip_of, const FootBody& body,
                                        const FloorCoefficients<double>& floor, const std::array<double, 3>& half_lengths_m,
                                        const GroundReach& reach, const BulgeOf& bulge_of) {
  FeetState state;
  // Most feet are far above the ground whatever their wall does.
  const double heights_m[3] = {body.turn.row_z.x * half_lengths_m[0], body.turn.row_z.y * half_lengths_m[1],
                               body.turn.row_z.z * half_lengths_m[2]};
  const double clearance_m = reach.ground_m + reach.bulge_m - body.place.z;
  for (std::size_t n = 0; n < count; ++n) {
    const auto& foot = foot_of(n);
    FootGrip& grip = grip_of(n);
    if (foot.signs[0] * heights_m[0] + foot.signs[1] * heights_m[1] + foot.signs[2] * heights_m[2] > clearance_m) {
      grip.lift();
      continue;
    }
    const double out = stands_out_m(foot, bulge_of);
    press_foot(grip, foot.share, state, body, floor, reach.ground_m, rotate(body.turn, place_of(foot, half_lengths_m, out)));
  }
  return state;
}

}  // namespace menger::voxel
