#include "voxel/engine/foot_contact.h"

#include <algorithm>
#include <cmath>

namespace menger::voxel {

namespace {

template <class Real>
Vector3<double> vector_at(const Real* values) {
  return {static_cast<double>(values[0]), static_cast<double>(values[1]), static_cast<double>(values[2])};
}

}  // namespace

template <class Real>
FootContact<Real>::FootContact(const Lattice& lattice, const HollowVoxels& voxels, const BodyClasses& classes, double height_m)
    : height_m_(height_m), coefficients_(classes.voxel), class_of_(classes.voxel_class), feet_(lattice.voxel_count()) {
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    for (const WallFoot& foot : wall_feet(lattice, voxels, i)) feet_[i].push_back({.of_wall = foot});
  }
  states_.resize(feet_.size());
}

/// Computes the contact of a foot and adds its loads to those of its voxel.
/// @param arm from the centre of the voxel to the foot
template <class Real>
void FootContact<Real>::press(Foot& foot, State& state, const Body& body, const FloorCoefficients<double>& floor,
                              const Vector3<double>& arm) const {
  const Vector3<double> place = body.place + arm;
  const double depth = height_m_ - place.z;
  if (depth < 0.0) {
    foot.lift();
    return;
  }
  const Vector3<double> velocity = body.velocity + cross(body.spin, arm);
  const double stiffness = foot.of_wall.share / feet_of_a_wall * floor.stiffness;
  const double damping = foot.of_wall.share / feet_of_a_wall * floor.damping;
  const Vector3<double> push{0.0, 0.0, std::max(stiffness * depth - damping * velocity.z, 0.0)};
  if (!foot.touches) foot.anchor = {place.x, place.y};
  const Vector3<double> spring{stiffness * (foot.anchor[0] - place.x), stiffness * (foot.anchor[1] - place.y), 0.0};
  const Vector3<double> drag = damping * Vector3<double>{velocity.x, velocity.y, 0.0};
  Vector3<double> hold = spring - drag;
  const double wanted = std::sqrt(dot(hold, hold));
  // Written, like the push, so that a force that is not finite is passed on instead of vanishing.
  foot.slides = !(wanted <= (foot.slides ? floor.kinetic_friction : floor.static_friction) * push.z);
  if (foot.slides) {
    hold = (wanted > 0.0 ? floor.kinetic_friction * push.z / wanted : 0.0) * hold;
    foot.anchor = {place.x + (hold.x + drag.x) / stiffness, place.y + (hold.y + drag.y) / stiffness};
  }
  foot.touches = true;
  state.sticks = (state.sticks || !state.touches) && !foot.slides;
  state.touches = true;
  state.pressing = {state.pressing.force + push, state.pressing.moment + cross(arm, push)};
  state.friction = {state.friction.force + hold, state.friction.moment + cross(arm, hold)};
}

template <class Real>
void FootContact<Real>::add_loads(const StepData<Real>& d, const std::array<double, 3>& origin_m,
                                  const PressureDrive<Real>& drive) {
  const double bulge_m = drive.largest_foot_bulge_m();
  const double highest = height_m_ + bulge_m + std::sqrt(3.0) * drive.largest_half_length_m();
  const auto bulge_of = [&drive](std::size_t voxel, std::size_t axis) { return drive.wall_bulge(voxel, axis); };
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const bool touched = states_[i].touches;
    states_[i] = {};
    const Real* pose = d.pose + line_size * i;
    const Vector3<double> place = vector_at(pose) + vector_at(origin_m.data());
    if (place.z > highest) {
      for (std::size_t n = 0; touched && n < feet_[i].size(); ++n) feet_[i][n].lift();
      continue;
    }
    const Real* motion = d.motion + line_size * i;
    const VoxelCoefficients<double>& c = coefficients_[class_of_[i]];
    const Quaternion<double> orientation{static_cast<double>(pose[slot::qw]), static_cast<double>(pose[slot::qx]),
                                         static_cast<double>(pose[slot::qy]), static_cast<double>(pose[slot::qz])};
    const Body body{.place = place,
                    .velocity = c.inverse_mass * vector_at(motion + slot::px),
                    .spin = c.inverse_inertia * vector_at(motion + slot::hx),
                    .turn = matrix(orientation)};
    const std::array<double, 3> half_lengths_m = drive.half_lengths_m(i);
    // Most feet are far above the ground whatever their wall does.
    const std::array<double, 3> heights_m{body.turn.row_z.x * half_lengths_m[0], body.turn.row_z.y * half_lengths_m[1],
                                          body.turn.row_z.z * half_lengths_m[2]};
    const double clearance_m = height_m_ + bulge_m - place.z;
    for (Foot& foot : feet_[i]) {
      const std::array<double, 3>& signs = foot.of_wall.signs;
      if (signs[0] * heights_m[0] + signs[1] * heights_m[1] + signs[2] * heights_m[2] > clearance_m) {
        foot.lift();
        continue;
      }
      const double out = stands_out_m(foot.of_wall, bulge_of);
      press(foot, states_[i], body, c.floor, rotate(body.turn, place_of(foot.of_wall, half_lengths_m, out)));
    }
    const Vector3<double> force = states_[i].pressing.force + states_[i].friction.force;
    const Vector3<double> moment = states_[i].pressing.moment + states_[i].friction.moment;
    Real* load = d.load + line_size * i;
    const std::array<double, 3> forces{force.x, force.y, force.z};
    const std::array<double, 3> moments{moment.x, moment.y, moment.z};
    for (std::size_t k = 0; k < 3; ++k) {
      load[slot::fx + k] += static_cast<Real>(forces[k]);
      load[slot::mx + k] += static_cast<Real>(moments[k]);
    }
  }
}

template class FootContact<double>;
template class FootContact<float>;

}  // namespace menger::voxel
