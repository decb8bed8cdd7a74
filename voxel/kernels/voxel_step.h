#pragma once

// A step of a voxel, wherever its numbers lie. Everything here is a template over the number type: sweeps take it for packs, the
// energy balance and graphics processors for plain numbers.

#include <type_traits>

#include "voxel/kernels/line.h"
#include "voxel/laws/ground.h"

namespace menger::voxel {

/// Result of a step of one voxel per lane. The sweep and the energy balance share it.
template <class T>
struct VoxelStep {
  FloorContact<T> floor;
  Vector3<T> velocity;  ///< before the step
  Vector3<T> spin;      ///< before the step
  Vector3<T> momentum;  ///< after it
  Vector3<T> spin_momentum;
  Vector3<T> displacement;
  Vector3<T> turn;  ///< rotation vector of the step
  MaskOf<T> is_static;
};

/// Computes a step of one voxel per lane (semi-implicit Euler): momentum, then displacement; moment of momentum, then turn. @cite
/// hiller2014dynamic
template <bool Floor, bool Gravity, class T>
MENGER_HOST_DEVICE inline VoxelStep<T> voxel_step(const StepConstants<RealOf<T>>& d, const T& floor_depth,
                                                  const VoxelCoefficients<T>& c, const Lines<T>& pose, const Lines<T>& motion,
                                                  const Lines<T>& load) {
  const T zero = constant<T>(0.0);
  const T time_step = T(d.time_step);
  VoxelStep<T> step;
  const Vector3<T> momentum = {motion.value[slot::px], motion.value[slot::py], motion.value[slot::pz]};
  const Vector3<T> spin_momentum = {motion.value[slot::hx], motion.value[slot::hy], motion.value[slot::hz]};
  step.velocity = c.inverse_mass * momentum;
  step.spin = c.inverse_inertia * spin_momentum;
  Vector3<T> force =
      Vector3<T>{load.value[slot::fx], load.value[slot::fy], load.value[slot::fz]} - c.global_damping * step.velocity;
  if constexpr (Gravity) force.z = force.z - c.weight;
  step.is_static = nowhere<T>();
  step.floor = {nowhere<T>(), nowhere<T>(), zero, zero, zero};
  if constexpr (Floor) {
    const MaskOf<T> was_static = motion.value[slot::is_static] > constant<T>(0.5);
    step.floor =
        floor_contact(c.floor, floor_depth, pose.value[slot::size], pose.value[slot::z], step.velocity, force, was_static);
    force = {force.x + step.floor.friction_x, force.y + step.floor.friction_y, force.z + step.floor.normal_force};
  }
  step.momentum = momentum + time_step * force;
  const T per_mass = time_step * c.inverse_mass;
  step.displacement = per_mass * step.momentum;
  if constexpr (Floor) {
    step.is_static = step.floor.is_static || floor_stops(step.floor, step.momentum, step.displacement, c.inverse_mass);
    step.momentum.x = select(step.is_static, zero, step.momentum.x);
    step.momentum.y = select(step.is_static, zero, step.momentum.y);
    step.displacement.x = select(step.is_static, zero, step.displacement.x);
    step.displacement.y = select(step.is_static, zero, step.displacement.y);
  }
  const Vector3<T> moment =
      Vector3<T>{load.value[slot::mx], load.value[slot::my], load.value[slot::mz]} - c.global_rotation_damping * step.spin;
  step.spin_momentum = spin_momentum + time_step * moment;
  if constexpr (Floor) {
    if (d.stop_rotation_in_static_friction) {
      step.spin_momentum = select<T>(step.is_static, Vector3<T>{zero, zero, zero}, step.spin_momentum);
    }
  }
  step.turn = (time_step * c.inverse_inertia) * step.spin_momentum;
  return step;
}

/// Returns the orientation of a voxel after a step.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> turned_orientation(const Lines<T>& pose, const Vector3<T>& turn) {
  Quaternion<T> turned =
      quaternion_of(turn) * Quaternion<T>{pose.value[slot::qw], pose.value[slot::qx], pose.value[slot::qy], pose.value[slot::qz]};
  if constexpr (std::is_same_v<RealOf<T>, float>) {
    // The cosine of half the angle of a step rounds to 1 in float. Without this correction the quaternion grows by 3e-4 a second.
    const T excess = constant<T>(0.5) *
                     (constant<T>(1.0) - (turned.w * turned.w + turned.x * turned.x + turned.y * turned.y + turned.z * turned.z));
    turned = {turned.w + excess * turned.w, turned.x + excess * turned.x, turned.y + excess * turned.y,
              turned.z + excess * turned.z};
  }
  return turned;
}

/// Writes the result of a step of a voxel into its lines.
/// @param residual rounding error of the positions, three numbers; float only
template <class T>
MENGER_HOST_DEVICE inline void put_step(const VoxelStep<T>& step, Lines<T>& pose, Lines<T>& motion, T* residual) {
  const Quaternion<T> turned = turned_orientation(pose, step.turn);
  const T moves[3] = {step.displacement.x, step.displacement.y, step.displacement.z};
  for (int k = 0; k < 3; ++k) {
    if constexpr (std::is_same_v<RealOf<T>, float>) {
      // Kahan's sum: at small steps a displacement is below the last digit of a float position.
      const T move = moves[k] - residual[k];
      const T sum = pose.value[k] + move;
      residual[k] = (sum - pose.value[k]) - move;
      pose.value[k] = sum;
    } else {
      pose.value[k] = pose.value[k] + moves[k];
    }
  }
  pose.value[slot::qw] = turned.w;
  pose.value[slot::qx] = turned.x;
  pose.value[slot::qy] = turned.y;
  pose.value[slot::qz] = turned.z;
  motion.value[slot::px] = step.momentum.x;
  motion.value[slot::py] = step.momentum.y;
  motion.value[slot::pz] = step.momentum.z;
  motion.value[slot::hx] = step.spin_momentum.x;
  motion.value[slot::hy] = step.spin_momentum.y;
  motion.value[slot::hz] = step.spin_momentum.z;
  motion.value[slot::is_static] = select(step.is_static, constant<T>(1.0), constant<T>(0.0));
}

/// Writes the size at the end of a step, base + sine part * sin + cosine part * cos, and its rate into the lines.
template <class T>
MENGER_HOST_DEVICE inline void put_size(const StepConstants<RealOf<T>>& d, const T& base, const T& sine_part,
                                        const T& cosine_part, Lines<T>& pose, Lines<T>& motion) {
  const T sine = T(d.next_sine);
  const T cosine = T(d.next_cosine);
  pose.value[slot::size] = base + (sine_part * sine + cosine_part * cosine);
  motion.value[slot::size_rate] = T(d.angular_frequency) * (sine_part * cosine - cosine_part * sine);
}

/// Computes the size of a voxel and its rate under a drive that is not a plain sine, see DriveMoment.
/// @param base, sine_part, cosine_part see StepData::size_base
template <class T>
MENGER_HOST_DEVICE inline void put_shaped_size(double sine, double cosine, double sine_rate, double cosine_rate, const T& base,
                                               const T& sine_part, const T& cosine_part, T& size, T& size_rate) {
  size = base + (sine_part * constant<T>(sine) + cosine_part * constant<T>(cosine));
  size_rate = sine_part * constant<T>(sine_rate) + cosine_part * constant<T>(cosine_rate);
}

}  // namespace menger::voxel
