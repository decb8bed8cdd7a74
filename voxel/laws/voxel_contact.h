#pragma once

#include <cmath>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// Radius of a voxel's collision sphere as a fraction of its driven size. @cite hiller2014dynamic
inline constexpr double collision_radius_fraction = 0.625;

/// What one of two voxels brings to a contact between them.
template <class T>
struct ContactEnd {
  Vector3<T> velocity;  ///< m/s
  T stiffness;          ///< 2 E L, N/m
  T damping;            ///< 2 zeta_c sqrt(m E L), N s/m
};

/// Whether two collision spheres overlap; never where the centres are the same or not finite.
/// @param reach sum of the radii, m
template <class T>
inline MaskOf<T> spheres_overlap(const T& distance2, const T& reach) {
  return (distance2 < reach * reach) && (distance2 > constant<T>(0.0));
}

/// Force (N) of the first voxel on the second, whose spheres overlap; elsewhere the value means nothing.
///
/// With n from the first to the second voxel and the overlap d = reach - |r2 - r1| > 0: f = k d + c (v1 - v2) · n, +f n on the
/// second; k is the harmonic mean of the stiffnesses, c the mean of the dampings. Zero where rounding leaves no overlap. @cite
/// hiller2014dynamic
/// @param apart r2 - r1, m @param distance2 |r2 - r1|^2
template <class T>
inline Vector3<T> contact_force(const Vector3<T>& apart, const T& distance2, const T& reach, const ContactEnd<T>& first,
                                const ContactEnd<T>& second) {
  using std::sqrt;
  const T zero = constant<T>(0.0);
  const T distance = sqrt(distance2);
  const T overlap = reach - distance;
  const T stiffness = constant<T>(2.0) * first.stiffness * second.stiffness / (first.stiffness + second.stiffness);
  const T damping = constant<T>(0.5) * (first.damping + second.damping);
  const Vector3<T> normal = (constant<T>(1.0) / distance) * apart;
  const T closing = dot(first.velocity - second.velocity, normal);
  const Vector3<T> force = (stiffness * overlap + damping * closing) * normal;
  return select<T>(overlap > zero, force, Vector3<T>{zero, zero, zero});
}

}  // namespace menger::voxel
