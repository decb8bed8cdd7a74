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
    for (const WallFoot& foot : wall_feet(lattice, voxels, i)) feet_[i].push_back({.of_wall = foot, .grip = {}});
  }
  states_.resize(feet_.size());
}

template <class Real>
void FootContact<Real>::take_over(std::size_t voxel, std::span<const FootGrip> grips, bool touches, bool sticks) {
  for (std::size_t n = 0; n < grips.size(); ++n) feet_[voxel][n].grip = grips[n];
  states_[voxel] = {};
  states_[voxel].touches = touches;
  states_[voxel].sticks = sticks;
}

template <class Real>
void FootContact<Real>::add_loads(const StepData<Real>& d, const std::array<double, 3>& origin_m,
                                  const PressureDrive<Real>& drive) {
  const GroundReach reach{height_m_, drive.largest_foot_bulge_m(), drive.largest_half_length_m()};
  const double highest_m = reach.highest_m();
  const auto bulge_of = [&drive](std::size_t voxel, std::size_t axis) { return drive.wall_bulge(voxel, axis); };
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const bool touched = states_[i].touches;
    states_[i] = {};
    const Real* pose = d.pose + line_size * i;
    const Vector3<double> place = vector_at(pose) + vector_at(origin_m.data());
    if (place.z > highest_m) {
      for (std::size_t n = 0; touched && n < feet_[i].size(); ++n) feet_[i][n].grip.lift();
      continue;
    }
    const Real* motion = d.motion + line_size * i;
    const VoxelCoefficients<double>& c = coefficients_[class_of_[i]];
    const Quaternion<double> orientation{static_cast<double>(pose[slot::qw]), static_cast<double>(pose[slot::qx]),
                                         static_cast<double>(pose[slot::qy]), static_cast<double>(pose[slot::qz])};
    const FootBody body{.place = place,
                        .velocity = c.inverse_mass * vector_at(motion + slot::px),
                        .spin = c.inverse_inertia * vector_at(motion + slot::hx),
                        .turn = matrix(orientation)};
    states_[i] = press_feet(
        feet_[i].size(), [&](std::size_t n) -> const WallFoot& { return feet_[i][n].of_wall; },
        [&](std::size_t n) -> FootGrip& { return feet_[i][n].grip; }, body, c.floor, drive.half_lengths_m(i), reach, bulge_of);
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
