#pragma once

#include <cmath>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// Stiffness and damping of a beam between two voxels, in SI units.
///
/// For a beam between solid voxels, with E the harmonic mean of their two moduli and L the voxel edge:
///
///   axial = E L^2,  twist = E L^3 / (12 (1 + nu)) at nu = 0,  shear = E L,  bend = E L^2 / 2,  turn = E L^3 / 6
///
/// The members named root enter the damping, see beam_damping. @cite hiller2014dynamic
///
/// turn_difference and its root are zero unless the beam shears (Timoshenko); see beam_coefficients of a section.
template <class T>
struct BeamCoefficients {
  T axial;          ///< N, force per axial strain
  T twist;          ///< N m / rad
  T shear;          ///< N / m
  T bend;           ///< N / rad
  T turn;           ///< N m / rad
  T axial_root;     ///< sqrt(E L)
  T shear_root;     ///< sqrt(shear)
  T bend_root;      ///< sqrt(bend L / 2)
  T turn_root;      ///< sqrt(turn L^2 / 6)
  T twist_root;     ///< sqrt(twist L^2 / 6)
  T damping_lower;  ///< zeta sqrt(m) of the voxel at the lower end
  T damping_upper;  ///< zeta sqrt(m) of the voxel at the upper end

  /// N m / rad, moment on each end against its rotation relative to the other end; >= 0
  T turn_difference;
  T turn_difference_root;  ///< damping that belongs to turn_difference, >= 0
};

/// Poses of the two ends of a beam. The axes are permuted so that the undeformed beam points along +x, from its lower to its
/// upper end.
template <class T>
struct BeamEnds {
  Vector3<T> separation;  ///< upper minus lower position, m, world
  Quaternion<T> lower;    ///< orientations, body to world
  Quaternion<T> upper;
  T rest_length;  ///< m
};

/// Velocities of the two ends of a beam, in world axes permuted as in BeamEnds. Used only for damping from velocities.
template <class T>
struct BeamEndRates {
  Vector3<T> lower_velocity, upper_velocity;  ///< m/s
  Vector3<T> lower_spin, upper_spin;          ///< rad/s
  T rest_length_rate;                         ///< m/s
};

/// Turns the ends of a beam that has a kink in its middle while no load acts on it, as a limb on a sloping plate has. To a beam
/// that is straight between its ends, the kink is half a turn of each end, outwards at the upper and inwards at the lower one.
/// @param half_y, half_z half the rotation vector of the upper end against the lower one, rad, in the axes of the ends
template <class T>
MENGER_HOST_DEVICE inline void kink(BeamEnds<T>& ends, const T& half_y, const T& half_z) {
  const Quaternion<T> half = quaternion_of(Vector3<T>{constant<T>(0.0), half_y, half_z});
  ends.lower = ends.lower * half;
  ends.upper = times_inverse_turn(ends.upper, half);
}

/// Adds the rate of a kink to the spins of the ends that kink has turned.
template <class T>
MENGER_HOST_DEVICE inline void add_kink_rate(BeamEndRates<T>& rates, const BeamEnds<T>& ends, const T& half_y_rate,
                                             const T& half_z_rate) {
  const Vector3<T> rate = {constant<T>(0.0), half_y_rate, half_z_rate};
  rates.lower_spin = rates.lower_spin + rotate(matrix(ends.lower), rate);
  rates.upper_spin = rates.upper_spin - rotate(matrix(ends.upper), rate);
}

/// Deformation of a beam in its own frame.
///
/// In the small-angle state the frame is that of the lower end, and lower_angle is zero. In the large-angle state the x axis of
/// the frame joins the two ends, so that displacement has no transverse part. lower_angle.x is zero in both states and is not
/// stored.
template <class T>
struct BeamDeformation {
  Vector3<T> displacement;  ///< m: extension, transverse displacement of the upper end
  T lower_angle_y;          ///< rad
  T lower_angle_z;
  Vector3<T> upper_angle;  ///< rad
};

/// State of a beam that is kept from one step to the next.
template <class T>
struct BeamHistory {
  BeamDeformation<T> deformation;
  T small;  ///< 1 in the small-angle state, 0 in the large-angle state
};

/// Deformation of a beam in one step, with the frame that it is measured in.
template <class T>
struct BeamState {
  BeamDeformation<T> deformation;
  Rotation<T> frame;  ///< beam to world (permuted axes)
  MaskOf<T> small;    ///< whether the beam is in the small-angle state
  /// Whether the state changed in this step. Damping from increments is then zero, see rate_from_increments.
  MaskOf<T> state_changed;
};

/// Forces (N) and moments (N m) on the ends of a beam.
template <class T>
struct BeamLoads {
  Vector3<T> lower_force, lower_moment, upper_force, upper_moment;
};

template <class T>
MENGER_HOST_DEVICE inline BeamLoads<T> operator+(const BeamLoads<T>& a, const BeamLoads<T>& b) {
  return {a.lower_force + b.lower_force, a.lower_moment + b.lower_moment, a.upper_force + b.upper_force,
          a.upper_moment + b.upper_moment};
}

/// Returns the deformation of a beam in a given state. state_changed is false.
/// @param lower_frame matrix of ends.lower
/// @param d separation of the ends in the frame of the lower end
/// @param small mask: small-angle state where it holds, large-angle state elsewhere
template <class T>
MENGER_HOST_DEVICE inline BeamState<T> beam_in_state(const BeamEnds<T>& ends, const Rotation<T>& lower_frame, const Vector3<T>& d,
                                                     const MaskOf<T>& small) {
  using std::sqrt;
  const T zero = constant<T>(0.0);
  BeamState<T> state;
  state.frame = lower_frame;
  state.small = small;
  state.state_changed = nowhere<T>();
  const Quaternion<T> relative = seen_from(ends.lower, ends.upper);
  state.deformation.displacement = {d.x - ends.rest_length, d.y, d.z};
  state.deformation.lower_angle_y = zero;
  state.deformation.lower_angle_z = zero;
  Quaternion<T> upper = relative;
  const MaskOf<T> large = !small;
  if (any(large)) {
    const Quaternion<T> turn = rotation_onto_x(d);
    const Vector3<T> angle = rotation_vector(turn);
    upper = select<T>(large, turn_times(turn, relative), relative);
    state.deformation.lower_angle_y = select(large, angle.y, zero);
    state.deformation.lower_angle_z = select(large, angle.z, zero);
    const T length = sqrt(dot(d, d));
    state.deformation.displacement =
        select<T>(large, Vector3<T>{length - ends.rest_length, zero, zero}, state.deformation.displacement);
    const Rotation<T> turned = matrix(times_inverse_turn(ends.lower, turn));
    state.frame = {select<T>(large, turned.row_x, state.frame.row_x), select<T>(large, turned.row_y, state.frame.row_y),
                   select<T>(large, turned.row_z, state.frame.row_z)};
  }
  state.deformation.upper_angle = rotation_vector(upper);
  return state;
}

/// Returns the deformation of a beam with the moments that Voxelyze published, and switches between the small- and the
/// large-angle state.
///
/// Let d be the separation of the ends in the frame of the lower end. A beam enters the small-angle state when
/// (|d_y| + |d_z|) / d_x < 0.05 and |1 - d_x / rest length| < 0.5. It leaves that state beyond 0.06 or 0.6. @cite
/// hiller2014dynamic
template <class T>
MENGER_HOST_DEVICE inline BeamState<T> published_state(const BeamEnds<T>& ends, const T& was_small) {
  using std::abs;
  const Rotation<T> frame = matrix(ends.lower);
  const Vector3<T> d = rotate_back(frame, ends.separation);
  const T across = abs(d.y) + abs(d.z);
  const T stretch = abs(ends.rest_length - d.x);
  const MaskOf<T> was = was_small > constant<T>(0.5);
  const MaskOf<T> enters = (across < constant<T>(0.05) * d.x) && (stretch < constant<T>(0.5) * ends.rest_length);
  const MaskOf<T> leaves = (across > constant<T>(0.06) * d.x) || (stretch > constant<T>(0.6) * ends.rest_length);
  const MaskOf<T> small = (was && !leaves) || (!was && enters);
  BeamState<T> state = beam_in_state(ends, frame, d, small);
  state.state_changed = (was && !small) || (!was && small);
  return state;
}

/// Returns the elastic loads of a beam, in its frame. Their moments balance their forces only where the beam has the length that
/// its coefficients were made for; see balanced. @cite hiller2014dynamic
/// @tparam Shears false leaves out the terms of turn_difference, for Euler-Bernoulli beams, which have none
template <bool Shears = true, class T>
MENGER_HOST_DEVICE inline BeamLoads<T> beam_elastic_loads(const BeamCoefficients<T>& c, const BeamDeformation<T>& e,
                                                          const T& rest_length) {
  const T sum_y = e.lower_angle_y + e.upper_angle.y;
  const T sum_z = e.lower_angle_z + e.upper_angle.z;
  const T bend_y = c.bend * e.displacement.y;
  const T bend_z = c.bend * e.displacement.z;
  BeamLoads<T> loads;
  loads.lower_force = {c.axial * (e.displacement.x / rest_length), c.shear * e.displacement.y - c.bend * sum_z,
                       c.shear * e.displacement.z + c.bend * sum_y};
  loads.upper_force = -loads.lower_force;
  const T twist = c.twist * e.upper_angle.x;
  loads.lower_moment = {twist, -bend_z - c.turn * (e.lower_angle_y + sum_y), bend_y - c.turn * (e.lower_angle_z + sum_z)};
  loads.upper_moment = {-twist, -bend_z - c.turn * (e.upper_angle.y + sum_y), bend_y - c.turn * (e.upper_angle.z + sum_z)};
  if constexpr (Shears) {
    const T difference_y = c.turn_difference * (e.upper_angle.y - e.lower_angle_y);
    const T difference_z = c.turn_difference * (e.upper_angle.z - e.lower_angle_z);
    loads.lower_moment = loads.lower_moment + Vector3<T>{constant<T>(0.0), difference_y, difference_z};
    loads.upper_moment = loads.upper_moment - Vector3<T>{constant<T>(0.0), difference_y, difference_z};
  }
  return loads;
}

/// Returns the elastic energy of a beam, J. Its derivatives are the elastic loads.
template <class T>
MENGER_HOST_DEVICE inline T beam_energy(const BeamCoefficients<T>& c, const BeamDeformation<T>& e, const T& rest_length) {
  const T half = constant<T>(0.5);
  const Vector3<T>& u = e.displacement;
  const Vector3<T>& a = e.upper_angle;
  const T stretch = half * c.axial * (u.x * u.x / rest_length);
  const T shear = half * c.shear * (u.y * u.y + u.z * u.z);
  const T coupling = c.bend * (u.z * (e.lower_angle_y + a.y) - u.y * (e.lower_angle_z + a.z));
  const T bending = c.turn * (e.lower_angle_y * e.lower_angle_y + e.lower_angle_y * a.y + a.y * a.y +
                              e.lower_angle_z * e.lower_angle_z + e.lower_angle_z * a.z + a.z * a.z);
  const T difference_y = a.y - e.lower_angle_y;
  const T difference_z = a.z - e.lower_angle_z;
  const T difference = half * c.turn_difference * (difference_y * difference_y + difference_z * difference_z);
  return stretch + shear + coupling + bending + half * c.twist * a.x * a.x + difference;
}

/// Returns the damping loads of a beam from the rates of its deformation, in its frame. `rate.displacement.x` is the rate of the
/// length minus the rate of the rest length.
///
/// Each end has a coefficient of its own, which depends on its mass. Equal coefficients give equal and opposite forces.
/// @tparam Shears as for beam_elastic_loads
template <bool Shears = true, class T>
MENGER_HOST_DEVICE inline BeamLoads<T> beam_damping(const BeamCoefficients<T>& c, const BeamDeformation<T>& rate) {
  const T minus_half = constant<T>(-0.5);
  const T sum_y = rate.lower_angle_y + rate.upper_angle.y;
  const T sum_z = rate.lower_angle_z + rate.upper_angle.z;
  const Vector3<T> pull = {c.axial_root * rate.displacement.x, c.shear_root * rate.displacement.y - c.bend_root * sum_z,
                           c.shear_root * rate.displacement.z + c.bend_root * sum_y};
  BeamLoads<T> loads;
  loads.lower_force = c.damping_lower * pull;
  loads.upper_force = -(c.damping_upper * pull);
  const T twist = c.twist_root * rate.upper_angle.x;
  const T bend_y = c.bend_root * rate.displacement.y;
  const T bend_z = c.bend_root * rate.displacement.z;
  Vector3<T> lower = {-twist, bend_z + c.turn_root * (rate.lower_angle_y + sum_y),
                      c.turn_root * (rate.lower_angle_z + sum_z) - bend_y};
  Vector3<T> upper = {twist, bend_z + c.turn_root * (rate.upper_angle.y + sum_y),
                      c.turn_root * (rate.upper_angle.z + sum_z) - bend_y};
  if constexpr (Shears) {
    const T difference_y = c.turn_difference_root * (rate.upper_angle.y - rate.lower_angle_y);
    const T difference_z = c.turn_difference_root * (rate.upper_angle.z - rate.lower_angle_z);
    lower = lower - Vector3<T>{constant<T>(0.0), difference_y, difference_z};
    upper = upper + Vector3<T>{constant<T>(0.0), difference_y, difference_z};
  }
  loads.lower_moment = (minus_half * c.damping_lower) * lower;
  loads.upper_moment = (minus_half * c.damping_upper) * upper;
  return loads;
}

/// Returns the rate of a deformation from its change since the last step. It is zero where the state changed in this step.
/// @param steps_per_second 1/h, or 0 in the first step, which has no last step: the rate is then zero
template <class T>
MENGER_HOST_DEVICE inline BeamDeformation<T> rate_from_increments(const BeamState<T>& state, const BeamDeformation<T>& last,
                                                                  const T& steps_per_second) {
  const T zero = constant<T>(0.0);
  const BeamDeformation<T>& e = state.deformation;
  const T scale = select(state.state_changed, zero, steps_per_second);
  return {scale * (e.displacement - last.displacement), scale * (e.lower_angle_y - last.lower_angle_y),
          scale * (e.lower_angle_z - last.lower_angle_z), scale * (e.upper_angle - last.upper_angle)};
}

/// Returns the rate of a deformation from the velocities of the ends.
///
/// In the small-angle state the frame turns with the lower end. In the large-angle state the x axis of the frame turns with the
/// line between the ends. About that line the frame turns so that the angle at the lower end keeps no twist.
template <class T>
MENGER_HOST_DEVICE inline BeamDeformation<T> rate_from_velocities(const BeamState<T>& state, const BeamEnds<T>& ends,
                                                                  const BeamEndRates<T>& rates) {
  const T zero = constant<T>(0.0);
  const BeamDeformation<T>& e = state.deformation;
  const Vector3<T> velocity = rotate_back(state.frame, rates.upper_velocity - rates.lower_velocity);
  const Vector3<T> lower_spin = rotate_back(state.frame, rates.lower_spin);
  const Vector3<T> relative_spin = rotate_back(state.frame, rates.upper_spin) - lower_spin;
  const Vector3<T> separation = {e.displacement.x + ends.rest_length, e.displacement.y, e.displacement.z};
  const Vector3<T> seen = velocity - cross(lower_spin, separation);
  BeamDeformation<T> rate = {{seen.x - rates.rest_length_rate, seen.y, seen.z}, zero, zero, relative_spin};
  const MaskOf<T> large = !state.small;
  if (any(large)) {
    // Spin of the lower end relative to the frame. In its axes the line between the ends turns with (-v_z, v_y) / length.
    const T per_length = constant<T>(1.0) / select(large, separation.x, constant<T>(1.0));
    Vector3<T> spin = {zero, lower_spin.y + velocity.z * per_length, lower_spin.z - velocity.y * per_length};
    const Vector3<T> angle = {zero, e.lower_angle_y, e.lower_angle_z};
    spin.x = constant<T>(0.5) * (angle.y * spin.z - angle.z * spin.y) /
             (constant<T>(1.0) - constant<T>(1.0 / 12.0) * dot(angle, angle));
    const Vector3<T> angle_rate = rotation_vector_rate(angle, spin);
    rate.displacement = select<T>(large, Vector3<T>{velocity.x - rates.rest_length_rate, zero, zero}, rate.displacement);
    rate.lower_angle_y = select(large, angle_rate.y, zero);
    rate.lower_angle_z = select(large, angle_rate.z, zero);
    rate.upper_angle = select<T>(large, relative_spin + spin, relative_spin);
  }
  rate.upper_angle = rotation_vector_rate(e.upper_angle, rate.upper_angle);
  return rate;
}

/// Returns the deformation of a beam with balanced moments. It is in the large-angle state at any angle, so that neither end
/// comes first and nothing jumps where the state would change. state_changed is false.
template <class T>
MENGER_HOST_DEVICE inline BeamState<T> balanced_state(const BeamEnds<T>& ends) {
  const Rotation<T> frame = matrix(ends.lower);
  return beam_in_state(ends, frame, rotate_back(frame, ends.separation), nowhere<T>());
}

/// Returns loads of a beam whose moments balance its forces at its present length: as a whole they push and turn nothing.
///
/// The transverse force is what the moments M on both ends ask for, with l the length of the beam along x:
///
///   F_y = -(M_lower + M_upper)_z / l,   F_z = (M_lower + M_upper)_y / l   on the upper end, the opposite on the lower one
///
/// Elastic loads are then the derivatives of beam_energy by the poses of both ends, to first order in the angles. The loads of
/// beam_elastic_loads are so only where l is the length that the coefficients were made for, and those of beam_damping leave half
/// of the moment of their forces at any length. What is left over turns a floating body by itself.
/// @param loads in the frame of the beam, of balanced_state, with opposite axial forces and twists on the two ends
template <class T>
MENGER_HOST_DEVICE inline BeamLoads<T> balanced(const BeamLoads<T>& loads, const BeamState<T>& state, const T& rest_length) {
  const T per_length = constant<T>(1.0) / (state.deformation.displacement.x + rest_length);
  const Vector3<T> moment = loads.lower_moment + loads.upper_moment;
  const Vector3<T> upper = {loads.upper_force.x, -(moment.z * per_length), moment.y * per_length};
  return {-upper, loads.lower_moment, upper, loads.upper_moment};
}

/// Turns loads from the beam's frame to world axes (permuted).
template <class T>
MENGER_HOST_DEVICE inline BeamLoads<T> to_world(const Rotation<T>& frame, const BeamLoads<T>& loads) {
  return {rotate(frame, loads.lower_force), rotate(frame, loads.lower_moment), rotate(frame, loads.upper_force),
          rotate(frame, loads.upper_moment)};
}

}  // namespace menger::voxel
