#pragma once

#include <cmath>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// Coefficients of the contact between the floor and one voxel.
template <class T>
struct FloorCoefficients {
  T stiffness;         ///< N/m; 2 E L for a solid voxel
  T damping;           ///< N s/m; 2 zeta_c sqrt(m E L) for a solid voxel
  T static_friction;   ///< mu_s
  T kinetic_friction;  ///< mu_k
};

/// Result of the contact between the floor and a voxel in one step.
template <class T>
struct FloorContact {
  MaskOf<T> touches;         ///< whether the penetration is >= 0
  MaskOf<T> is_static;       ///< whether the voxel stays in static friction
  T normal_force;            ///< N, elastic plus damping part, upwards
  T friction_x, friction_y;  ///< N, kinetic friction
};

/// Computes the contact of a voxel with the floor, before its momentum is updated. The floor lies at z = -floor_depth, which is
/// half an edge below the centres of the lowest layer.
///
/// For a solid voxel of size s with the penetration p = s/2 - floor_depth - z, the normal force is
/// 2 E L p - 2 zeta_c sqrt(m E L) v_z for p >= 0. Friction:
/// - A voxel in static friction starts to slide when the horizontal force on it exceeds mu_s 2 E L p. No friction acts on it in
///   that step.
/// - A sliding voxel is slowed by mu_k 2 E L p against its velocity.
/// - A voxel that does not touch the floor is not in static friction.
///
/// @cite hiller2014dynamic
template <class T>
MENGER_HOST_DEVICE inline FloorContact<T> floor_contact(const FloorCoefficients<T>& c, const T& floor_depth, const T& size,
                                                        const T& z, const Vector3<T>& velocity, const Vector3<T>& force,
                                                        const MaskOf<T>& was_static) {
  using std::sqrt;
  const T zero = constant<T>(0.0);
  const T penetration = constant<T>(0.5) * size - floor_depth - z;
  FloorContact<T> contact;
  contact.touches = penetration >= zero;
  if (!any(contact.touches)) return {contact.touches, contact.touches, zero, zero, zero};
  const T pressing = c.stiffness * penetration;
  contact.normal_force = select(contact.touches, pressing - c.damping * velocity.z, zero);
  const T hold = c.static_friction * pressing;
  // Written so that a force that is not finite ends static friction. Otherwise it would be hidden.
  const MaskOf<T> holds = force.x * force.x + force.y * force.y <= hold * hold;
  contact.is_static = contact.touches && was_static && holds;
  const T speed2 = velocity.x * velocity.x + velocity.y * velocity.y;
  const MaskOf<T> slides = contact.touches && !was_static && (speed2 > zero);
  const T slowing = select(slides, c.kinetic_friction * pressing / sqrt(select(slides, speed2, constant<T>(1.0))), zero);
  contact.friction_x = -(slowing * velocity.x);
  contact.friction_y = -(slowing * velocity.y);
  return contact;
}

/// Whether a voxel that touches the floor enters static friction in this step. It does when the work of the friction uses up its
/// horizontal kinetic energy: 1/2 |P_xy|^2 / m + f · displacement <= 0, with the momentum P and the displacement after the
/// update.
template <class T>
MENGER_HOST_DEVICE inline MaskOf<T> floor_stops(const FloorContact<T>& contact, const Vector3<T>& momentum,
                                                const Vector3<T>& displacement, const T& inverse_mass) {
  const T zero = constant<T>(0.0);
  const T kinetic = constant<T>(0.5) * inverse_mass * (momentum.x * momentum.x + momentum.y * momentum.y);
  const T work = contact.friction_x * displacement.x + contact.friction_y * displacement.y;
  return contact.touches && (kinetic + work <= zero);
}

}  // namespace menger::voxel
