#pragma once

// The steps of one robot by a block of threads, which is a block of CUDA or a lone thread (see io::LoneThread). The physics are
// the laws and steps of the other rooms, for a plain number.

#include <algorithm>
#include <array>
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
/// @tparam Variety of the beams, as in LaunchShape
/// @tparam Gathers how loads of beams come to voxels. true: beams write theirs, and voxels add up those of their own beams; that
/// takes memory, and one wait. false: beams add theirs to voxels, which takes a wait for each end of each axis
template <bool Velocity, BeamVariety Variety, bool Gathers, class Real, class Thread>
class RobotStepper {
  static constexpr bool Uniform = Variety == BeamVariety::uniform;
  static constexpr bool Calibrated = Variety == BeamVariety::own_lengths;

 public:
  /// @param lines of the robot, with its state; loads need not be set
  MENGER_HOST_DEVICE RobotStepper(const Thread& thread, const RobotData<Real>& robot, const BatchArrays<Real>& arrays,
                                  const SharedLines<Real>& lines)
      : thread_(thread), robot_(robot), arrays_(arrays), lines_(lines) {}

  /// Makes up to `count` steps.
  MENGER_HOST_DEVICE RobotOutcome advance(std::uint32_t count) {
    RobotOutcome outcome;
    const bool collides = robot_.surface_voxels > 0;
    if constexpr (!Gathers) {
      for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) reset_load(i);
    }
    if constexpr (Calibrated) set_responses(arrays_.drives[robot_.drives - 1]);
    thread_.wait();
    if (collides && thread_.any(!list_partners())) outcome.end = RobotEnd::crowded;
    while (outcome.end == RobotEnd::completed && outcome.steps < count) {
      const Real rate_scale = robot_.is_first_step && outcome.steps == 0 ? Real(0) : robot_.rate_scale;
      const bool in_range = Gathers ? write_beam_loads(rate_scale) : add_beam_loads(rate_scale);
      if (thread_.any(!in_range || !is_valid_)) {
        outcome.end = thread_.any(!in_range) ? RobotEnd::strained : RobotEnd::outside;
      } else {
        if constexpr (Gathers) gather_loads();
        if constexpr (!Uniform) {
          if (robot_.has_coupling) add_coupling_loads();
        }
        if (collides) {
          add_contact_loads();
          thread_.wait();
        }
        const DriveMoment& drive = arrays_.drives[robot_.drives + outcome.steps];
        if constexpr (Calibrated) {
          if (robot_.calibrated.has_feet) add_foot_loads();
          thread_.wait();
          set_responses(drive);
          thread_.wait();
        }
        const bool is_slow = move_voxels(drive);
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
    if constexpr (Calibrated) outcome.strains = strains_of_all();
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
                                                Real rate_scale, bool& in_range) {
    const auto pose = [&](std::size_t voxel) {
      return permuted_line(lines_.pose, voxel, order, slot::x, slot::qx, slot::size, slot::qw);
    };
    const auto motion = [&](std::size_t voxel) {
      return permuted_line(lines_.motion, voxel, order, slot::px, slot::hx, slot::size_rate, slot::is_static);
    };
    const BeamCoefficients<Real> c = beam_coefficients(beam);
    BeamEnds<Real> ends = beam_ends<0>(pose(lower), pose(upper));
    [[maybe_unused]] OwnLength own;
    if constexpr (Calibrated) {
      own = own_length(beam);
      ends.rest_length = own.length;
    }
    if (robot_.single_precision_rest_lengths) ends.rest_length = rounded_to_single(ends.rest_length);
    if constexpr (Calibrated) {
      if (robot_.calibrated.has_kinks) kink(ends, own.half_kink[0], own.half_kink[1]);
    }
    const auto rates = [&] {
      const VoxelCoefficients<Real> at_lower = voxel_coefficients(lower);
      const VoxelCoefficients<Real> at_upper = voxel_coefficients(upper);
      const EndInertias<Real> inverse = {at_lower.inverse_mass, at_upper.inverse_mass, at_lower.inverse_inertia,
                                         at_upper.inverse_inertia};
      BeamEndRates<Real> rate = beam_end_rates<0>(inverse, motion(lower), motion(upper));
      if constexpr (Calibrated) {
        rate.rest_length_rate = own.rate;
        if (robot_.calibrated.has_kinks) add_kink_rate(rate, ends, own.half_kink[2], own.half_kink[3]);
      }
      return rate;
    };
    const BeamStep<Real> step = step_of_beam<Velocity, Calibrated, Real>(rate_scale, robot_.balances_moments, c, ends, rates,
                                                                         arrays_.state + robot_.history + beam, robot_.beams());
    in_range = in_range && is_strain_in_range(step.state.deformation, ends.rest_length, robot_.strain_limit);
    if constexpr (Calibrated) note_strain(step.state.deformation.displacement.x / ends.rest_length);
    return to_world(step.state.frame, loads_of(robot_, step, ends.rest_length));
  }

  /// Writes the loads of all beams, component by component: those on the upper ends, then those on the lower ones.
  /// @return false if a strain of a beam of this thread is out of range
  MENGER_HOST_DEVICE bool write_beam_loads(Real rate_scale) {
    bool in_range = true;
    for (std::size_t beam = thread_.index(); beam < robot_.beams(); beam += thread_.count()) {
      const std::uint32_t axis = (beam < robot_.beam_begin[1] ? 0U : 1U) + (beam < robot_.beam_begin[2] ? 0U : 1U);
      const AxisOrder order{{axis, (axis + 1) % 3, (axis + 2) % 3}};
      const BeamLoads<Real> loads =
          beam_loads(beam, index(robot_.lower, beam), index(robot_.upper, beam), order, rate_scale, in_range);
      const auto write = [&](std::size_t first, const Vector3<Real>& v) {
        const auto at = [&](std::size_t k) -> Real& { return beam_load(first + order.axis[k], beam); };
        at(0) = v.x;
        at(1) = v.y;
        at(2) = v.z;
      };
      write(0, Uniform ? -loads.lower_force : loads.upper_force);
      write(3, loads.upper_moment);
      write(numbers_of_load, loads.lower_force);
      write(numbers_of_load + 3, loads.lower_moment);
    }
    return in_range;
  }

  MENGER_HOST_DEVICE Real& beam_load(std::size_t component, std::size_t beam) const {
    return arrays_.loads[robot_.beam_loads + robot_.beams() * component + beam];
  }

  /// Sets the loads of the voxels of this thread to those of their beams, added up in the order of add_beam_loads.
  MENGER_HOST_DEVICE void gather_loads() const {
    for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) {
      Real sum[numbers_of_load];
      for (std::size_t k = 0; k < numbers_of_load; ++k)
        sum[k] = robot_.has_external ? arrays_.constants[robot_.external + robot_.stride * k + i] : Real(0);
      for (std::size_t end = 0; end < ends_of_voxel; ++end) {
        const std::int32_t beam = arrays_.indices[robot_.beams_of_voxel + robot_.stride * end + i];
        if (beam < 0) continue;
        const std::size_t first = end % 2 == 0 ? 0 : numbers_of_load;
        for (std::size_t k = 0; k < numbers_of_load; ++k) sum[k] += beam_load(first + k, static_cast<std::size_t>(beam));
      }
      for (std::size_t k = 0; k < numbers_of_load; ++k) lines_.load[robot_.stride * k + i] = sum[k];
    }
  }

  /// Adds the loads of all beams. Threads wait so that every voxel gets its loads in the order in which the sweeps of other rooms
  /// add them: along one axis after the other, first as the upper, then as the lower end. Along an axis it is either end of one
  /// beam at most, and of the two the one of which it is the upper end comes first.
  /// @return false if a strain of a beam of this thread is out of range
  MENGER_HOST_DEVICE bool add_beam_loads(Real rate_scale) {
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

  /// Rest length of a beam of a calibrated body (m) with its rate (m/s), and half its kink with its rates, see BeamAxisData.
  struct OwnLength {
    Real length, rate;
    Real half_kink[4];
  };

  MENGER_HOST_DEVICE const WallResponse& response(std::size_t number) const {
    return arrays_.responses[robot_.calibrated.responses + number];
  }

  /// Returns what PressureDrive sets for a beam.
  MENGER_HOST_DEVICE OwnLength own_length(std::size_t beam) const {
    const CalibratedData& c = robot_.calibrated;
    const WallResponse& lower = response(index(c.beam_halves, beam));
    const WallResponse& upper = response(index(c.beam_halves, robot_.beams() + beam));
    double length = lower.half_length_m + upper.half_length_m;
    double rate = lower.half_length_rate_m_s + upper.half_length_rate_m_s;
    double half_kink[4] = {};
    const std::size_t first = index(c.entry_begin, beam);
    const std::size_t last = index(c.entry_begin, beam + 1);
    if (first < last) {
      const double per_edge = 1.0 / c.edge_m;
      const double strain = per_edge * length - 1.0;
      const double strain_rate = per_edge * rate;
      for (std::size_t n = first; n < last; ++n) {
        const NeckOrElbow& entry = arrays_.necks_and_elbows[c.necks_and_elbows + n];
        const WallResponse& wall = response(entry.bulge);
        length += entry.lift * wall.bulge_peak_m;
        rate += entry.lift * wall.bulge_peak_rate_m_s;
        add_half_kink(half_kink, entry, wall, per_edge, strain, strain_rate);
      }
    }
    OwnLength own{};
    for (std::size_t k = 0; k < 4; ++k) own.half_kink[k] = static_cast<Real>(half_kink[k]);
    own.length = static_cast<Real>(length);
    own.rate = static_cast<Real>(rate);
    return own;
  }

  /// Evaluates the laws of the walls for a moment of the drive.
  MENGER_HOST_DEVICE void set_responses(const DriveMoment& drive) const {
    const CalibratedData& c = robot_.calibrated;
    for (std::size_t r = thread_.index(); r < law_class_count * c.phases; r += thread_.count()) {
      const double* phase = arrays_.phases + c.phase_table + 2 * (r / law_class_count);
      arrays_.responses[c.responses + r] =
          wall_response(c.edge_m, arrays_.walls[c.walls + r % law_class_count], c.wave.value(drive, phase[0], phase[1]),
                        c.wave.rate(drive, phase[0], phase[1]));
    }
  }

  /// Widens the range of strains of this thread.
  MENGER_HOST_DEVICE void note_strain(Real strain) {
    const CalibratedData& c = robot_.calibrated;
    smallest_strain_ = strain < smallest_strain_ ? strain : smallest_strain_;
    largest_strain_ = strain > largest_strain_ ? strain : largest_strain_;
    if (c.refuses &&
        (static_cast<double>(smallest_strain_) < c.smallest_strain || static_cast<double>(largest_strain_) > c.largest_strain)) {
      is_valid_ = false;
    }
  }

  MENGER_HOST_DEVICE StrainRange strains_of_all() const {
    double* ranges = arrays_.ranges + robot_.calibrated.ranges;
    ranges[2 * thread_.index()] = static_cast<double>(smallest_strain_);
    ranges[2 * thread_.index() + 1] = static_cast<double>(largest_strain_);
    thread_.wait();
    StrainRange strains;
    for (std::size_t n = 0; n < thread_.count(); ++n) {
      if (ranges[2 * n] < strains.smallest) strains.smallest = ranges[2 * n];
      if (ranges[2 * n + 1] > strains.largest) strains.largest = ranges[2 * n + 1];
    }
    return strains;
  }

  /// Adds the loads of the feet of the voxels of this thread, as FootContact does.
  MENGER_HOST_DEVICE void add_foot_loads() const {
    const CalibratedData& c = robot_.calibrated;
    GroundReach reach{c.ground_m, 0.0, 0.0};
    for (std::size_t n = 0; n < c.lengths_in_use_count; ++n)
      reach.half_length_m = std::max(reach.half_length_m, response(index(c.lengths_in_use, n)).half_length_m);
    for (std::size_t n = 0; n < c.bulges_in_use_count; ++n)
      reach.bulge_m = std::max(reach.bulge_m, response(index(c.bulges_in_use, n)).bulge_peak_m);
    const double highest_m = reach.highest_m();
    for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) press_voxel(i, reach, highest_m);
  }

  MENGER_HOST_DEVICE void press_voxel(std::size_t voxel, const GroundReach& reach, double highest_m) const {
    const CalibratedData& c = robot_.calibrated;
    const std::size_t first = c.feet + index(c.foot_begin, voxel);
    const std::size_t count = c.feet + index(c.foot_begin, voxel + 1) - first;
    std::uint32_t& touches = arrays_.touches[c.touches + voxel];
    const auto vector_at = [&](const Real* values, int slot) {
      const Real* at = values + robot_.stride * static_cast<std::size_t>(slot) + voxel;
      return Vector3<double>{static_cast<double>(at[0]), static_cast<double>(at[robot_.stride]),
                             static_cast<double>(at[std::size_t{2} * robot_.stride])};
    };
    const Vector3<double> place = vector_at(lines_.pose, slot::x) + Vector3<double>{c.origin_m[0], c.origin_m[1], c.origin_m[2]};
    if (place.z > highest_m) {
      for (std::size_t n = 0; touches != 0 && n < count; ++n) arrays_.grips[first + n].lift();
      touches = 0;
      return;
    }
    const VoxelCoefficients<double>& ground = arrays_.grounds[c.grounds + index(robot_.voxel_class, voxel) / 2];
    const Vector3<double> axis = vector_at(lines_.pose, slot::qx);
    const Quaternion<double> orientation{static_cast<double>(lines_.pose[robot_.stride * std::size_t{slot::qw} + voxel]), axis.x,
                                         axis.y, axis.z};
    const FootBody body{place, ground.inverse_mass * vector_at(lines_.motion, slot::px),
                        ground.inverse_inertia * vector_at(lines_.motion, slot::hx), matrix(orientation)};
    std::array<double, 3> half_lengths_m{};
    for (std::size_t k = 0; k < 3; ++k)
      half_lengths_m[k] = response(index(c.voxel_halves, robot_.stride * k + voxel)).half_length_m;
    const FeetState state = press_feet(
        count, [&](std::size_t n) -> const DeviceFoot& { return arrays_.feet[first + n]; },
        [&](std::size_t n) -> FootGrip& { return arrays_.grips[first + n]; }, body, ground.floor, half_lengths_m, reach,
        [&](std::int32_t number, std::uint32_t) {
          const WallResponse& wall = response(static_cast<std::size_t>(number));
          return WallBulge{wall.bulge_m, wall.bulge_peak_m};
        });
    touches = (state.touches ? touches_ground : 0U) | (state.sticks ? sticks_to_ground : 0U);
    const Vector3<double> force = state.pressing.force + state.friction.force;
    const Vector3<double> moment = state.pressing.moment + state.friction.moment;
    add_load(voxel, AxisOrder{{0, 1, 2}}, {static_cast<Real>(force.x), static_cast<Real>(force.y), static_cast<Real>(force.z)},
             {static_cast<Real>(moment.x), static_cast<Real>(moment.y), static_cast<Real>(moment.z)});
  }

  /// A beam as LateralCoupling sees it.
  struct CoupledBeam {
    Vector3<Real> direction;  ///< from the lower to the upper end
    Real extension;           ///< m
    Real root;                ///< of its spring stiffness
  };

  MENGER_HOST_DEVICE CoupledBeam coupled_beam(std::size_t beam, std::size_t lower, std::size_t upper) const {
    using std::sqrt;
    CoupledBeam coupled;
    coupled.direction = place(upper) - place(lower);
    const Real length = sqrt(dot(coupled.direction, coupled.direction));
    const auto share = [length](Real component) { return length > Real(0) ? component / length : Real(0); };
    coupled.direction = {share(coupled.direction.x), share(coupled.direction.y), share(coupled.direction.z)};
    Real rest_length = Real(0.5) * (size_of(lower) + size_of(upper));
    if constexpr (Calibrated) rest_length = own_length(beam).length;
    if (robot_.single_precision_rest_lengths) rest_length = rounded_to_single(rest_length);
    coupled.root = sqrt(arrays_.constants[robot_.axial + beam] / rest_length);
    coupled.extension = length - rest_length;
    return coupled;
  }

  /// Calls a function for every beam along an axis, in the order of add_beam_loads: for the upper end of the beam of every
  /// thread, and then for its lower end.
  /// @param at_end (end, CoupledBeam, lower, upper) -> void
  template <class AtEnd>
  MENGER_HOST_DEVICE void visit_coupled(std::uint32_t axis, const AtEnd& at_end) const {
    const std::size_t end = robot_.beam_begin[axis + 1];
    for (std::size_t first = robot_.beam_begin[axis]; first < end; first += thread_.count()) {
      const std::size_t beam = first + thread_.index();
      CoupledBeam coupled{};
      std::size_t lower = 0;
      std::size_t upper = 0;
      if (beam < end) {
        lower = index(robot_.lower, beam);
        upper = index(robot_.upper, beam);
        coupled = coupled_beam(beam, lower, upper);
        at_end(true, coupled, lower, upper);
      }
      thread_.wait();
      if (beam < end) at_end(false, coupled, lower, upper);
    }
    thread_.wait();
  }

  /// Adds the tensions of the lateral coupling, as LateralCoupling does.
  MENGER_HOST_DEVICE void add_coupling_loads() const {
    Real* const sums = arrays_.loads + robot_.coupling_sums;
    const auto sum = [&](std::size_t axis, std::size_t voxel) -> Real& { return sums[robot_.stride * axis + voxel]; };
    for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count())
      for (std::size_t axis = 0; axis < 3; ++axis) sum(axis, i) = Real(0);
    thread_.wait();
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      visit_coupled(axis, [&](bool is_upper, const CoupledBeam& beam, std::size_t lower, std::size_t upper) {
        sum(axis, is_upper ? upper : lower) += Real(0.5) * beam.root * beam.extension;
      });
    }
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::size_t b = (axis + 1) % 3;
      const std::size_t c = (axis + 2) % 3;
      visit_coupled(axis, [&](bool is_upper, const CoupledBeam& beam, std::size_t lower, std::size_t upper) {
        const Real tension =
            robot_.half_coupling * beam.root * ((sum(b, lower) + sum(c, lower)) + (sum(b, upper) + sum(c, upper)));
        const Vector3<Real> force = tension * beam.direction;
        add(is_upper ? upper : lower, AxisOrder{{0, 1, 2}}, 0, is_upper ? -force : force);
      });
    }
  }

  /// Moves the voxels of this thread.
  /// @return false if one is too fast, or not finite
  MENGER_HOST_DEVICE bool move_voxels(const DriveMoment& drive) {
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
      if constexpr (Calibrated) {
        pose.value[slot::size] = static_cast<Real>(
            2.0 * response(index(robot_.calibrated.voxel_halves, robot_.stride * std::size_t{2} + i)).half_length_m);
      } else {
        set_size(constants, drive, i, pose, motion);
      }
      store(lines_.pose, i, pose);
      store(lines_.motion, i, motion);
      if constexpr (!Gathers) reset_load(i);
      const Real displacement2 = dot(step.displacement, step.displacement);
      is_slow = is_slow && displacement2 <= robot_.displacement_limit2;
      largest2 = displacement2 > largest2 ? displacement2 : largest2;
    }
    path_m_ += sqrt(largest2);
    return is_slow;
  }

  /// Sets the size of a solid voxel to the drive at the end of the step.
  MENGER_HOST_DEVICE void set_size(const StepConstants<Real>& constants, const DriveMoment& drive, std::size_t voxel,
                                   Lines<Real>& pose, Lines<Real>& motion) const {
    const Real* parts = arrays_.constants + robot_.size_parts + voxel;
    const Real base = parts[0], sine_part = parts[robot_.stride], cosine_part = parts[std::size_t{2} * robot_.stride];
    if (robot_.size_drive == SizeDrive::sine) {
      put_size(constants, base, sine_part, cosine_part, pose, motion);
    } else {
      put_shaped_size<Real>(drive.sine, drive.cosine, drive.sine_rate, drive.cosine_rate, base, sine_part, cosine_part,
                            pose.value[slot::size], motion.value[slot::size_rate]);
    }
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

  /// Writes the corners of the boxes that hold chunks of surface voxels.
  MENGER_HOST_DEVICE void box_chunks() const {
    for (std::size_t c = thread_.index(); c < robot_.chunks(); c += thread_.count()) {
      const std::size_t end = std::min<std::size_t>((c + 1) * voxels_of_chunk, robot_.surface_voxels);
      Vector3<Real> low = place(index(robot_.surface, c * voxels_of_chunk));
      Vector3<Real> high = low;
      for (std::size_t t = c * voxels_of_chunk + 1; t < end; ++t) {
        const Vector3<Real> at = place(index(robot_.surface, t));
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
      }
      Real* const box = arrays_.loads + robot_.boxes + numbers_of_box * c;
      box[0] = low.x;
      box[1] = low.y;
      box[2] = low.z;
      box[3] = high.x;
      box[4] = high.y;
      box[5] = high.z;
    }
  }

  /// Whether a voxel of a chunk may be as near as partners are.
  MENGER_HOST_DEVICE bool is_near_chunk(const Vector3<Real>& here, std::size_t chunk) const {
    const Real* const box = arrays_.loads + robot_.boxes + numbers_of_box * chunk;
    const auto outside = [](Real at, Real low, Real high) { return std::max(Real(0), std::max(low - at, at - high)); };
    const Vector3<Real> apart = {outside(here.x, box[0], box[3]), outside(here.y, box[1], box[4]),
                                 outside(here.z, box[2], box[5])};
    // What is not a number is near, as it is among the partners' distances.
    return !(dot(apart, apart) >= robot_.list_reach2);
  }

  /// Lists for every surface voxel of this thread the others that may touch it before a voxel has moved by half_skin, ascending.
  /// Each pair is in two lists. Chunks of voxels that are far away as a whole are passed over.
  /// @return false if there are more than the lists hold
  MENGER_HOST_DEVICE bool list_partners() {
    path_m_ = Real(0);
    box_chunks();
    thread_.wait();
    bool fits = true;
    for (std::size_t s = thread_.index(); s < robot_.surface_voxels; s += thread_.count()) {
      const Vector3<Real> here = place(index(robot_.surface, s));
      std::int32_t* list = arrays_.partners + robot_.partners + s;
      std::uint32_t count = 0;
      for (std::size_t c = 0; c < robot_.chunks() && count <= most_partners; ++c) {
        if (!is_near_chunk(here, c)) continue;
        const std::size_t end = std::min<std::size_t>((c + 1) * voxels_of_chunk, robot_.surface_voxels);
        for (std::size_t t = c * voxels_of_chunk; t < end; ++t) {
          const std::size_t other = index(robot_.surface, t);
          const Vector3<Real> apart = place(other) - here;
          if (!(dot(apart, apart) < robot_.list_reach2) || t == s || !may_collide(s, other)) continue;
          if (++count > most_partners) break;
          list[std::size_t{count} * robot_.surface_voxels] = static_cast<std::int32_t>(other);
        }
      }
      if (count > most_partners) {
        count = most_partners;
        fits = false;
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

  /// Adds the contact forces on the surface voxels. A voxel whose load was gathered is that of the same thread here.
  MENGER_HOST_DEVICE void add_contact_loads() const {
    if constexpr (Gathers) {
      for (std::size_t i = thread_.index(); i < robot_.voxels; i += thread_.count()) {
        const std::int32_t position = arrays_.indices[robot_.surface_position + i];
        if (position >= 0) add_contact_loads_of(static_cast<std::size_t>(position));
      }
    } else {
      for (std::size_t s = thread_.index(); s < robot_.surface_voxels; s += thread_.count()) add_contact_loads_of(s);
    }
  }

  /// Adds the contact forces on a surface voxel, in the order of its partners. This is the order in which the engine goes through
  /// the pairs. Every force is computed twice, once for either voxel.
  MENGER_HOST_DEVICE void add_contact_loads_of(std::size_t s) const {
    const std::int32_t* list = arrays_.partners + robot_.partners + s;
    const std::int32_t count = list[0];
    if (count == 0) return;
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

  MENGER_HOST_DEVICE Real size_of(std::size_t voxel) const {
    return lines_.pose[robot_.stride * std::size_t{slot::size} + voxel];
  }

  Thread thread_;
  const RobotData<Real>& robot_;
  const BatchArrays<Real>& arrays_;
  SharedLines<Real> lines_;
  Real smallest_strain_ = Real(0), largest_strain_ = Real(0);  ///< of the beams of this thread
  bool is_valid_ = true;                                       ///< these strains are in the range of validity
  Real path_m_ = Real(0);  ///< bound on how far the voxels of this thread have moved since the partners were listed
};

}  // namespace menger::voxel
