#pragma once

#include <cmath>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// The floor seen by one voxel.
template <class T>
struct FloorCoefficients {
  T stiffness;         ///< 2 E L, N/m
  T damping;           ///< 2 zeta_c sqrt(m E L), N s/m
  T static_friction;   ///< mu_s
  T kinetic_friction;  ///< mu_k
};

/// What the floor does to a voxel in one step.
template <class T>
struct FloorContact {
  MaskOf<T> touches;         ///< penetration >= 0
  MaskOf<T> is_static;       ///< in static friction
  T normal_force;            ///< N, elastic and damping part, upwards
  T friction_x, friction_y;  ///< N, kinetic friction
};

/// Contact of a voxel with the floor at z = -floor_depth (half an edge of the lowest layer), before the momentum is updated.
///
/// With p = s/2 - floor_depth - z the normal force is 2 E L p - 2 zeta_c sqrt(m E L) v_z for p >= 0. A voxel in static friction
/// leaves it without a force in this step when the horizontal force exceeds mu_s 2 E L p; a sliding one is slowed by mu_k 2 E L p
/// against its velocity; a voxel that does not touch is not in static friction. @cite hiller2014dynamic
template <class T>
inline FloorContact<T> floor_contact(const FloorCoefficients<T>& c, const T& floor_depth, const T& size, const T& z,
                                     const Vector3<T>& velocity, const Vector3<T>& force, const MaskOf<T>& was_static) {
  using std::sqrt;
  const T zero = constant<T>(0.0);
  const T penetration = constant<T>(0.5) * size - floor_depth - z;
  FloorContact<T> contact;
  contact.touches = penetration >= zero;
  if (!any(contact.touches)) return {contact.touches, contact.touches, zero, zero, zero};
  const T pressing = c.stiffness * penetration;
  contact.normal_force = select(contact.touches, pressing - c.damping * velocity.z, zero);
  const T hold = c.static_friction * pressing;
  // Written so that a force that is not finite breaks the hold instead of vanishing in it.
  const MaskOf<T> holds = force.x * force.x + force.y * force.y <= hold * hold;
  contact.is_static = contact.touches && was_static && holds;
  const T speed2 = velocity.x * velocity.x + velocity.y * velocity.y;
  const MaskOf<T> slides = contact.touches && !was_static && (speed2 > zero);
  const T slowing = select(slides, c.kinetic_friction * pressing / sqrt(select(slides, speed2, constant<T>(1.0))), zero);
  contact.friction_x = -(slowing * velocity.x);
  contact.friction_y = -(slowing * velocity.y);
  return contact;
}

/// Whether a voxel that touches the floor comes to static friction in this step: its horizontal kinetic energy would be used up
/// by the work of the friction, 1/2 |P_xy|^2 / m + f · displacement <= 0, P and displacement after the update.
template <class T>
inline MaskOf<T> floor_stops(const FloorContact<T>& contact, const Vector3<T>& momentum, const Vector3<T>& displacement,
                             const T& inverse_mass) {
  const T zero = constant<T>(0.0);
  const T kinetic = constant<T>(0.5) * inverse_mass * (momentum.x * momentum.x + momentum.y * momentum.y);
  const T work = contact.friction_x * displacement.x + contact.friction_y * displacement.y;
  return contact.touches && (kinetic + work <= zero);
}

}  // namespace menger::voxel
