#pragma once

// The steps of one robot by a block of threads, which is a block of CUDA or a lone thread (see io::LoneThread). The physics are
// the laws and steps of the other rooms, for a plain number.

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "voxel/device/robot_data.h"
#include "voxel/kernels/beam_step.h"
#include "voxel/kernels/voxel_step.h"
#include "voxel/laws/voxel_contact.h"

namespace menger::voxel {

/// What the threads of a block share: poses, motions and loads of the voxels, component by component.
template <class Real>
struct SharedLines {
  Real* pose;
  Real* motion;
  Real* load;
};

/// The steps of one robot.
/// @tparam Velocity damping is from velocities, see DampingMode
/// @tparam Uniform all beams and voxels have one set of coefficients
template <bool Velocity, bool Uniform, class Real, class Thread>
class RobotStepper {
 public:
  /// @param lines of the robot, with its state; loads need not be set
  MENGER_HOST_DEVICE RobotStepper(const Thread& thread, const RobotData<Real>& robot, const BatchArrays<Real>& arrays,
                                  const SharedLines<Real>& lines)
      : thread_(thread), robot_(robot), arrays_(arrays), lines_(lines) {}

  /// Makes up to `count` steps.
  MENGER_HOST_DEVICE RobotOutcome advance(std::uint32_t count) {
    RobotOutcome outcome;
    const bool collides = robot_.surface_voxels > 0;
    for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) reset_load(i);
    thread_.wait();
    if (collides && thread_.any(!list_partners())) outcome.end = RobotEnd::crowded;
    while (outcome.end == RobotEnd::completed && outcome.steps < count) {
      const bool in_range = add_beam_loads(robot_.is_first_step && outcome.steps == 0 ? Real(0) : robot_.rate_scale);
      if (thread_.any(!in_range)) {
        outcome.end = RobotEnd::strained;
      } else {
        if (collides) {
          add_contact_loads();
          thread_.wait();
        }
        const bool is_slow = move_voxels(arrays_.drives[robot_.drives + outcome.steps]);
        if (thread_.any(!is_slow || (collides && !(path_m_ <= robot_.half_skin)))) {
          if (thread_.any(!is_slow)) {
            outcome.end = RobotEnd::too_fast;
          } else if (thread_.any(!list_partners())) {
            outcome.end = RobotEnd::crowded;
          }
        }
      }
      ++outcome.steps;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0.0;
      for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count())
        sum += static_cast<double>(lines_.pose[robot_.stride * axis + i]);
      outcome.middle_m[axis] = thread_.sum(sum) / static_cast<double>(robot_.voxels);
    }
    return outcome;
  }

 private:
  /// The components of a vector in the order in which an axis comes first.
  struct AxisOrder {
    std::uint32_t axis[3];
  };

  MENGER_HOST_DEVICE Lines<Real> line(const Real* values, std::size_t voxel) const {
    Lines<Real> line;
    for (std::size_t k = 0; k < line_size; ++k) line.value[k] = values[robot_.stride * k + voxel];
    return line;
  }

  MENGER_HOST_DEVICE void store(Real* values, std::size_t voxel, const Lines<Real>& line) const {
    for (std::size_t k = 0; k < line_size; ++k) values[robot_.stride * k + voxel] = line.value[k];
  }

  /// Returns the line of a voxel with its vectors in axes permuted as in BeamEnds.
  /// @param first, second where the two vectors of the line begin, @param number, other where its two numbers are
  MENGER_HOST_DEVICE Lines<Real> permuted_line(const Real* values, std::size_t voxel, const AxisOrder& order, int first,
                                               int second, int number, int other) const {
    Lines<Real> line;
    const auto value = [&](std::size_t slot) { return values[robot_.stride * slot + voxel]; };
    for (int k = 0; k < 3; ++k) {
      line.value[first + k] = value(static_cast<std::size_t>(first) + order.axis[k]);
      line.value[second + k] = value(static_cast<std::size_t>(second) + order.axis[k]);
    }
    line.value[number] = value(static_cast<std::size_t>(number));
    line.value[other] = value(static_cast<std::size_t>(other));
    return line;
  }

  MENGER_HOST_DEVICE VoxelCoefficients<Real> voxel_coefficients(std::size_t voxel) const {
    if constexpr (Uniform) {
      return robot_.voxel;
    } else {
      const Real* row = arrays_.constants + robot_.voxel_table + line_size * index(robot_.voxel_class, voxel);
      return voxel_coefficients_from<Real>([row](int k) { return row[k]; });
    }
  }

  MENGER_HOST_DEVICE BeamCoefficients<Real> beam_coefficients(std::size_t beam) const {
    if constexpr (Uniform) {
      return robot_.beam;
    } else {
      const Real* row = arrays_.constants + robot_.beam_table + line_size * index(robot_.beam_class, beam);
      return beam_coefficients_from<Real>([row](int k) { return row[k]; });
    }
  }

  MENGER_HOST_DEVICE std::size_t index(std::size_t begin, std::size_t position) const {
    return static_cast<std::size_t>(arrays_.indices[begin + position]);
  }

  MENGER_HOST_DEVICE void reset_load(std::size_t voxel) const {
    for (std::size_t k = 0; k < numbers_of_load; ++k) {
      const std::size_t at = robot_.stride * k + voxel;
      lines_.load[at] = robot_.has_external ? arrays_.constants[robot_.external + at] : Real(0);
    }
  }

  /// Adds a force to the load of a voxel, or with first = 3 a moment.
  MENGER_HOST_DEVICE void add(std::size_t voxel, const AxisOrder& order, std::uint32_t first, const Vector3<Real>& v) const {
    const auto at = [&](std::size_t k) -> Real& {
      return lines_.load[robot_.stride * std::size_t{first + order.axis[k]} + voxel];
    };
    at(0) += v.x;
    at(1) += v.y;
    at(2) += v.z;
  }

  MENGER_HOST_DEVICE void add_load(std::size_t voxel, const AxisOrder& order, const Vector3<Real>& force,
                                   const Vector3<Real>& moment) const {
    add(voxel, order, 0, force);
    add(voxel, order, 3, moment);
  }

  /// Returns the loads of a beam in the world (permuted axes).
  MENGER_HOST_DEVICE BeamLoads<Real> beam_loads(std::size_t beam, std::size_t lower, std::size_t upper, const AxisOrder& order,
                                                Real rate_scale, bool& in_range) const {
    const auto pose = [&](std::size_t voxel) {
      return permuted_line(lines_.pose, voxel, order, slot::x, slot::qx, slot::size, slot::qw);
    };
    const auto motion = [&](std::size_t voxel) {
      return permuted_line(lines_.motion, voxel, order, slot::px, slot::hx, slot::size_rate, slot::is_static);
    };
    const BeamCoefficients<Real> c = beam_coefficients(beam);
    BeamEnds<Real> ends = beam_ends<0>(pose(lower), pose(upper));
    if (robot_.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
    const auto rates = [&] {
      const VoxelCoefficients<Real> at_lower = voxel_coefficients(lower);
      const VoxelCoefficients<Real> at_upper = voxel_coefficients(upper);
      const EndInertias<Real> inverse = {at_lower.inverse_mass, at_upper.inverse_mass, at_lower.inverse_inertia,
                                         at_upper.inverse_inertia};
      return beam_end_rates<0>(inverse, motion(lower), motion(upper));
    };
    const BeamStep<Real> step =
        step_of_beam<Velocity, false, Real>(rate_scale, c, ends, rates, arrays_.state + robot_.history + beam, robot_.beams());
    in_range = in_range && is_strain_in_range(step.state.deformation, ends.rest_length, robot_.strain_limit);
    return to_world(step.state.frame, step.elastic + step.damping);
  }

  /// Adds the loads of all beams. Threads wait so that every voxel gets its loads in the order in which the sweeps of other rooms
  /// add them: along one axis after the other, first as the upper, then as the lower end. Along an axis it is either end of one
  /// beam at most, and of the two the one of which it is the upper end comes first.
  /// @return false if a strain of a beam of this thread is out of range
  MENGER_HOST_DEVICE bool add_beam_loads(Real rate_scale) const {
    bool in_range = true;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const AxisOrder order{{axis, (axis + 1) % 3, (axis + 2) % 3}};
      const std::size_t end = robot_.beam_begin[axis + 1];
      for (std::size_t first = robot_.beam_begin[axis]; first < end; first += thread_.count()) {
        const std::size_t beam = first + thread_.index();
        std::size_t lower = 0;
        BeamLoads<Real> loads;
        if (beam < end) {
          lower = index(robot_.lower, beam);
          const std::size_t upper = index(robot_.upper, beam);
          loads = beam_loads(beam, lower, upper, order, rate_scale, in_range);
          add_load(upper, order, Uniform ? -loads.lower_force : loads.upper_force, loads.upper_moment);
        }
        thread_.wait();
        if (beam < end) add_load(lower, order, loads.lower_force, loads.lower_moment);
      }
      thread_.wait();
    }
    return in_range;
  }

  /// Moves the voxels of this thread.
  /// @return false if one is too fast, or not finite
  MENGER_HOST_DEVICE bool move_voxels(const StepDrive& drive) {
    using std::sqrt;
    StepConstants<Real> constants = static_cast<const StepConstants<Real>&>(robot_);
    constants.next_sine = static_cast<Real>(drive.sine);
    constants.next_cosine = static_cast<Real>(drive.cosine);
    bool is_slow = true;
    Real largest2 = Real(0);
    for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) {
      Lines<Real> pose = line(lines_.pose, i);
      Lines<Real> motion = line(lines_.motion, i);
      Lines<Real> load;
      for (std::size_t k = 0; k < 3; ++k) {
        load.value[static_cast<std::size_t>(slot::fx) + k] = lines_.load[robot_.stride * k + i];
        load.value[static_cast<std::size_t>(slot::mx) + k] = lines_.load[robot_.stride * (k + 3) + i];
      }
      const VoxelStep<Real> step =
          voxel_step<true, true>(constants, robot_.floor_depth, voxel_coefficients(i), pose, motion, load);
      if constexpr (sizeof(Real) == sizeof(float)) {
        Real* at = arrays_.state + robot_.residual + i;
        Real residual[3] = {at[0], at[robot_.stride], at[std::size_t{2} * robot_.stride]};
        put_step(step, pose, motion, residual);
        for (std::size_t k = 0; k < 3; ++k) at[robot_.stride * k] = residual[k];
      } else {
        put_step<Real>(step, pose, motion, nullptr);
      }
      const Real* parts = arrays_.constants + robot_.size_parts + i;
      const Real base = parts[0], sine_part = parts[robot_.stride], cosine_part = parts[std::size_t{2} * robot_.stride];
      if (robot_.size_drive == SizeDrive::sine) {
        put_size(constants, base, sine_part, cosine_part, pose, motion);
      } else {
        put_shaped_size<Real>(drive.sine, drive.cosine, drive.sine_rate, drive.cosine_rate, base, sine_part, cosine_part,
                              pose.value[slot::size], motion.value[slot::size_rate]);
      }
      store(lines_.pose, i, pose);
      store(lines_.motion, i, motion);
      reset_load(i);
      const Real displacement2 = dot(step.displacement, step.displacement);
      is_slow = is_slow && displacement2 <= robot_.displacement_limit2;
      largest2 = displacement2 > largest2 ? displacement2 : largest2;
    }
    path_m_ += sqrt(largest2);
    return is_slow;
  }

  MENGER_HOST_DEVICE Vector3<Real> place(std::size_t voxel) const {
    const Real* pose = lines_.pose + voxel;
    return {pose[0], pose[robot_.stride], pose[std::size_t{2} * robot_.stride]};
  }

  /// Whether a surface voxel may collide with another one.
  /// @param position of the first among the surface voxels
  MENGER_HOST_DEVICE bool may_collide(std::size_t position, std::size_t other) const {
    std::size_t begin = index(robot_.exclusion_begin, position);
    std::size_t end = index(robot_.exclusion_begin, position + 1);
    while (begin < end) {
      const std::size_t middle = (begin + end) / 2;
      const std::size_t excluded = index(robot_.exclusions, middle);
      if (excluded == other) return false;
      if (excluded < other) {
        begin = middle + 1;
      } else {
        end = middle;
      }
    }
    return true;
  }

  /// Lists for every surface voxel of this thread the others that may touch it before a voxel has moved by half_skin, ascending.
  /// Each pair is in two lists. All pairs are looked at: that is rare, and cheaper than a grid for most robots.
  /// @return false if there are more than the lists hold
  MENGER_HOST_DEVICE bool list_partners() {
    path_m_ = Real(0);
    bool fits = true;
    for (std::size_t s = thread_.index(); s < robot_.surface_voxels; s += thread_.count()) {
      const Vector3<Real> here = place(index(robot_.surface, s));
      std::int32_t* list = arrays_.partners + robot_.partners + s;
      std::uint32_t count = 0;
      for (std::size_t t = 0; t < robot_.surface_voxels; ++t) {
        const std::size_t other = index(robot_.surface, t);
        const Vector3<Real> apart = place(other) - here;
        if (!(dot(apart, apart) < robot_.list_reach2) || t == s || !may_collide(s, other)) continue;
        if (count == most_partners) {
          fits = false;
          break;
        }
        ++count;
        list[std::size_t{count} * robot_.surface_voxels] = static_cast<std::int32_t>(other);
      }
      list[0] = static_cast<std::int32_t>(count);
    }
    return fits;
  }

  MENGER_HOST_DEVICE ContactEnd<Real> contact_end(std::size_t voxel) const {
    const VoxelCoefficients<Real> c = voxel_coefficients(voxel);
    const Real* motion = lines_.motion + voxel;
    const Vector3<Real> momentum = {motion[robot_.stride * std::size_t{slot::px}], motion[robot_.stride * std::size_t{slot::py}],
                                    motion[robot_.stride * std::size_t{slot::pz}]};
    return {c.inverse_mass * momentum, c.floor.stiffness, c.floor.damping};
  }

  /// Adds the contact forces on every surface voxel of this thread, in the order of their partners. This is the order in which
  /// add_contact_loads goes through the pairs. Every force is computed twice, once for either voxel.
  MENGER_HOST_DEVICE void add_contact_loads() const {
    for (std::size_t s = thread_.index(); s < robot_.surface_voxels; s += thread_.count()) {
      const std::int32_t* list = arrays_.partners + robot_.partners + s;
      const std::int32_t count = list[0];
      if (count == 0) continue;
      const std::size_t voxel = index(robot_.surface, s);
      const Vector3<Real> here = place(voxel);
      const Real size = size_of(voxel);
      for (std::int32_t n = 1; n <= count; ++n) {
        const auto other = static_cast<std::size_t>(list[static_cast<std::size_t>(n) * robot_.surface_voxels]);
        const Vector3<Real> apart = place(other) - here;
        const Real distance2 = dot(apart, apart);
        const Real reach = constant<Real>(collision_radius_fraction) * (size + size_of(other));
        if (!spheres_overlap(distance2, reach)) continue;
        Vector3<Real> force;
        if (voxel < other) {
          force = -contact_force(apart, distance2, reach, contact_end(voxel), contact_end(other));
        } else {
          force = contact_force(-apart, distance2, reach, contact_end(other), contact_end(voxel));
        }
        add(voxel, AxisOrder{{0, 1, 2}}, 0, force);
      }
    }
  }

  MENGER_HOST_DEVICE Real size_of(std::size_t voxel) const {
    return lines_.pose[robot_.stride * std::size_t{slot::size} + voxel];
  }

  Thread thread_;
  const RobotData<Real>& robot_;
  const BatchArrays<Real>& arrays_;
  SharedLines<Real> lines_;
  Real path_m_ = Real(0);  ///< bound on how far the voxels of this thread have moved since the partners were listed
};

}  // namespace menger::voxel
