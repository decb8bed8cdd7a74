#pragma once

#include <cmath>

#include "voxel/laws/rotation.h"

namespace menger::voxel {

/// Radius of a voxel's collision sphere as a fraction of its driven size. @cite hiller2014dynamic
inline constexpr double collision_radius_fraction = 0.625;

/// Velocity and contact coefficients of one of two voxels in contact.
template <class T>
struct ContactEnd {
  Vector3<T> velocity;  ///< m/s
  T stiffness;          ///< N/m; 2 E L for a solid voxel
  T damping;            ///< N s/m; 2 zeta_c sqrt(m E L) for a solid voxel
};

/// Whether two collision spheres overlap. False where their centres coincide or are not finite.
/// @param distance2 square of the distance of the centres, m^2
/// @param reach sum of the radii, m
template <class T>
MENGER_HOST_DEVICE inline MaskOf<T> spheres_overlap(const T& distance2, const T& reach) {
  return (distance2 < reach * reach) && (distance2 > constant<T>(0.0));
}

/// Returns the contact force (N) of the first voxel on the second. The value is meaningful only where their spheres overlap.
///
/// Let n be the unit vector from the first to the second voxel and d = reach - |r2 - r1| > 0 the overlap. The force on the second
/// voxel is f n with f = k d + c (v1 - v2) · n. k is the harmonic mean of the stiffnesses, c the mean of the dampings. The force
/// is zero where rounding leaves no overlap. @cite hiller2014dynamic
/// @param apart r2 - r1, m
/// @param distance2 |r2 - r1|^2
/// @param reach sum of the radii, m
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> contact_force(const Vector3<T>& apart, const T& distance2, const T& reach,
                                                   const ContactEnd<T>& first, const ContactEnd<T>& second) {
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
