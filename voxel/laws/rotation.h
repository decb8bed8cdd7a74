#pragma once

#include <cmath>

#include "voxel/laws/exact_rotation.h"
#include "voxel/laws/number.h"

namespace menger::voxel {

/// A vector of three numbers.
template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
MENGER_HOST_DEVICE inline Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> operator*(const T& s, const Vector3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
MENGER_HOST_DEVICE inline T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns a where the mask holds and b elsewhere.
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> select(const MaskOf<T>& mask, const Vector3<T>& a, const Vector3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// A rotation as a unit quaternion w + xi + yj + zk.
template <class T>
struct Quaternion {
  T w, x, y, z;
};

/// Returns the product a b: the rotation b followed by the rotation a.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> operator*(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Returns conj(a) b: the rotation b in the frame of a.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> seen_from(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z, a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y,
          a.w * b.y + a.x * b.z - a.y * b.w - a.z * b.x, a.w * b.z - a.x * b.y + a.y * b.x - a.z * b.w};
}

/// Returns turn * b for a rotation `turn` about an axis perpendicular to x, as rotation_onto_x returns it. The terms with
/// turn.x = 0 are left out.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> turn_times(const Quaternion<T>& turn, const Quaternion<T>& b) {
  return {turn.w * b.w - turn.y * b.y - turn.z * b.z, turn.w * b.x + turn.y * b.z - turn.z * b.y,
          turn.w * b.y + turn.y * b.w + turn.z * b.x, turn.w * b.z - turn.y * b.x + turn.z * b.w};
}

/// Returns a times the inverse of `turn`, a rotation about an axis perpendicular to x as in turn_times.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> times_inverse_turn(const Quaternion<T>& a, const Quaternion<T>& turn) {
  return {a.w * turn.w + a.y * turn.y + a.z * turn.z, a.x * turn.w - a.y * turn.z + a.z * turn.y,
          a.x * turn.z - a.w * turn.y + a.y * turn.w, a.z * turn.w - (a.w * turn.z + a.x * turn.y)};
}

template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> select(const MaskOf<T>& mask, const Quaternion<T>& a, const Quaternion<T>& b) {
  return {select(mask, a.w, b.w), select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// Rows of the matrix of a rotation.
template <class T>
struct Rotation {
  Vector3<T> row_x, row_y, row_z;
};

/// Returns the matrix R of the rotation by a unit quaternion. R v is v turned by it: with the orientation of a voxel, from the
/// frame of the voxel to that of the world.
template <class T>
MENGER_HOST_DEVICE inline Rotation<T> matrix(const Quaternion<T>& q) {
  const T two = constant<T>(2.0);
  const T one = constant<T>(1.0);
  const T x2 = two * q.x, y2 = two * q.y, z2 = two * q.z;
  const T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const T xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const T wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{one - (yy + zz), xy - wz, xz + wy}, {xy + wz, one - (xx + zz), yz - wx}, {xz - wy, yz + wx, one - (xx + yy)}};
}

/// Returns R v.
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> rotate(const Rotation<T>& r, const Vector3<T>& v) {
  return {dot(r.row_x, v), dot(r.row_y, v), dot(r.row_z, v)};
}

/// Returns R^T v.
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> rotate_back(const Rotation<T>& r, const Vector3<T>& v) {
  return {r.row_x.x * v.x + r.row_y.x * v.y + r.row_z.x * v.z, r.row_x.y * v.x + r.row_y.y * v.y + r.row_z.y * v.z,
          r.row_x.z * v.x + r.row_y.z * v.y + r.row_z.z * v.z};
}

/// Returns the rotation vector (axis times angle in radians) of a unit quaternion, 2 acos(w) / sqrt(1 - w^2) (x, y, z). Angles
/// beyond pi are returned as they are.
///
/// With k = (1 - w)/2 = sin^2(angle/4) the factor is 2 sum_n k^n prod_{j<=n} 2j/(2j+1). In double precision eight terms leave a
/// relative error below 1e-16 for k <= 0.01 (angles up to 23 degrees). In single precision four terms leave 5e-9. Beyond k = 0.01
/// the C library computes the factor.
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> rotation_vector(const Quaternion<T>& q) {
  const T k = constant<T>(0.5) * (constant<T>(1.0) - q.w);
  constexpr double c1 = 2.0 / 3.0, c2 = c1 * 4.0 / 5.0, c3 = c2 * 6.0 / 7.0;
  const T k2 = k * k;
  T factor = (constant<T>(2.0) + constant<T>(2.0 * c1) * k) + (constant<T>(2.0 * c2) + constant<T>(2.0 * c3) * k) * k2;
  if constexpr (sizeof(RealOf<T>) > sizeof(float)) {
    constexpr double c4 = c3 * 8.0 / 9.0, c5 = c4 * 10.0 / 11.0, c6 = c5 * 12.0 / 13.0, c7 = c6 * 14.0 / 15.0;
    const T high = (constant<T>(2.0 * c4) + constant<T>(2.0 * c5) * k) + (constant<T>(2.0 * c6) + constant<T>(2.0 * c7) * k) * k2;
    factor = factor + high * (k2 * k2);
  }
  const MaskOf<T> far = k > constant<T>(0.01);
  if (any(far)) factor = select(far, apply_to_lanes(q.w, ExactRotationVectorFactor{}), factor);
  return {factor * q.x, factor * q.y, factor * q.z};
}

/// Returns the time derivative of a rotation vector v at the angular velocity w, both in the rotated frame:
/// w - v x w / 2 + v x (v x w) / 12. The next term has the relative size |v|^4 / 720.
template <class T>
MENGER_HOST_DEVICE inline Vector3<T> rotation_vector_rate(const Vector3<T>& v, const Vector3<T>& w) {
  const Vector3<T> across = cross(v, w);
  return w - constant<T>(0.5) * across + constant<T>(1.0 / 12.0) * cross(v, across);
}

/// Returns the unit quaternion of a rotation vector (axis times angle in radians).
///
/// With k = (angle/2)^2: w = cos(sqrt k), xyz = sin(sqrt k)/sqrt(k) v/2. In double precision Taylor sums up to k^4 leave a
/// relative error below 3e-17 for k <= 0.01 (0.2 rad in one step). In single precision sums up to k^2 leave 2e-9. Beyond k = 0.01
/// the C library computes both.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> quaternion_of(const Vector3<T>& v) {
  const T half = constant<T>(0.5);
  const Vector3<T> u = half * v;
  const T k = dot(u, u);
  const T k2 = k * k;
  T high_cosine = constant<T>(1.0 / 24.0);
  T high_sinc = constant<T>(1.0 / 120.0);
  if constexpr (sizeof(RealOf<T>) > sizeof(float)) {
    high_cosine = (high_cosine - constant<T>(1.0 / 720.0) * k) + constant<T>(1.0 / 40320.0) * k2;
    high_sinc = (high_sinc - constant<T>(1.0 / 5040.0) * k) + constant<T>(1.0 / 362880.0) * k2;
  }
  T cosine = (constant<T>(1.0) - half * k) + k2 * high_cosine;
  T sinc = (constant<T>(1.0) - constant<T>(1.0 / 6.0) * k) + k2 * high_sinc;
  const MaskOf<T> far = k > constant<T>(0.01);
  if (any(far)) {
    cosine = select(far, apply_to_lanes(k, ExactCosineOfRoot{}), cosine);
    sinc = select(far, apply_to_lanes(k, ExactSincOfRoot{}), sinc);
  }
  return {cosine, sinc * u.x, sinc * u.y, sinc * u.z};
}

/// Returns the shortest rotation that turns d onto the positive x axis. For d = (-|d|, 0, 0) it is half a turn about y. |d| > 0.
template <class T>
MENGER_HOST_DEVICE inline Quaternion<T> rotation_onto_x(const Vector3<T>& d) {
  using std::sqrt;
  const T zero = constant<T>(0.0);
  const T across2 = d.y * d.y + d.z * d.z;
  const T length = sqrt(d.x * d.x + across2);
  const T w = length + d.x;
  const T norm2 = w * w + across2;
  const MaskOf<T> is_plain = (d.x > zero) && (norm2 > zero);
  if (!any(!is_plain)) {
    const T scale = constant<T>(1.0) / sqrt(norm2);
    return {w * scale, zero, d.z * scale, -(d.y * scale)};
  }
  // |d| + d_x loses all digits for d_x < 0; across2 / (|d| - d_x) is the same number without the cancellation.
  const T exact_w = select(d.x >= zero, w, across2 / (length - d.x));
  const T exact_norm2 = exact_w * exact_w + across2;
  const MaskOf<T> opposite = exact_norm2 <= zero;
  const T scale = constant<T>(1.0) / sqrt(select(opposite, constant<T>(1.0), exact_norm2));
  return {select(opposite, zero, exact_w * scale), zero, select(opposite, constant<T>(1.0), d.z * scale),
          select(opposite, zero, -(d.y * scale))};
}

}  // namespace menger::voxel
