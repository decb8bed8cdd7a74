#pragma once

// The pressure on one face of each lane.

#include <array>
#include <cstddef>

#include "fem/thin_walls/lane_number.h"

namespace menger::fem::detail {

/// A field u = middle + xi first + eta second + xi eta twist on a face, -1 <= xi, eta <= 1.
template <class T>
struct FaceField {
  Vector3<T> middle;
  Vector3<T> first;
  Vector3<T> second;
  Vector3<T> twist;
};

/// @param values at the corners, which run around the face
template <class T>
MENGER_HOST_DEVICE FaceField<T> face_field(const std::array<Vector3<T>, 4>& values) {
  FaceField<T> field;
  const T quarter(0.25);
  for (std::size_t i = 0; i < 3; ++i) {
    const T low = values[0][i] + values[1][i];
    const T high = values[3][i] + values[2][i];
    const T low_change = values[1][i] - values[0][i];
    const T high_change = values[2][i] - values[3][i];
    field.middle[i] = quarter * (low + high);
    field.first[i] = quarter * (low_change + high_change);
    field.second[i] = quarter * (high - low);
    field.twist[i] = quarter * (high_change - low_change);
  }
  return field;
}

/// The volume that a face has swept along the normal of its corners' order: int_0^1 int u . n dA dtau over the faces between the
/// one at rest, tau = 0, and the present one. With A = A0 + first, C = C0 + second and twist = k, the area vector on the way is
/// (A0 + tau (first + eta k)) x (C0 + tau (second + xi k)), and the integral
/// 4 middle . (A0 x C0 + (A0 x second + first x C0)/2 + first x second/3) + 2/3 (first . (A0 x k) + second . (k x C0)).
template <class T>
MENGER_HOST_DEVICE T swept_volume(const FaceField<T>& u, const Vector3<T>& A0, const Vector3<T>& C0) {
  Vector3<T> area = cross(A0, C0);
  add(area, T(0.5), cross(A0, u.second));
  add(area, T(0.5), cross(u.first, C0));
  add(area, T(1.0 / 3.0), cross(u.first, u.second));
  const T of_twist = dot(u.first, cross(A0, u.twist)) + dot(u.second, cross(u.twist, C0));
  return fma(T(4.0), dot(u.middle, area), T(2.0 / 3.0) * of_twist);
}

/// The forces of a pressure on the corners of a face, and the volume that the face has swept against the normal of its corners'
/// order.
template <class T>
struct FaceForces {
  std::array<Vector3<T>, 4> corners;
  T swept;
};

/// int N_a x_xi x x_eta dxi deta over the bilinear face: with the tangents A and C in the middle and the twist k, the integrand
/// is (A + eta k) x (C + xi k) = A x C + xi A x k + eta k x C, and N_a = (1 +- xi)(1 +- eta)/4, which gives A x C +- A x k/3 +- k
/// x C/3.
/// @param values at the corners @param A0, C0 half edges of the face at rest where the values are displacements, else zero
/// @param minus_pressure_Pa, minus_third_Pa minus the pressure, and minus a third of it
template <class T>
MENGER_HOST_DEVICE FaceForces<T> face_forces(const std::array<Vector3<T>, 4>& values, const Vector3<T>& A0, const Vector3<T>& C0,
                                             const T& minus_pressure_Pa, const T& minus_third_Pa) {
  const FaceField<T> u = face_field(values);
  Vector3<T> A = A0;
  Vector3<T> C = C0;
  add(A, T(1.0), u.first);
  add(C, T(1.0), u.second);
  const Vector3<T> total = scaled(minus_pressure_Pa, cross(A, C));
  const Vector3<T> along_first = scaled(minus_third_Pa, cross(A, u.twist));
  const Vector3<T> along_second = scaled(minus_third_Pa, cross(u.twist, C));
  FaceForces<T> forces;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    forces.corners[corner] = total;
    add(forces.corners[corner], T(corner == 0 || corner == 3 ? -1.0 : 1.0), along_first);
    add(forces.corners[corner], T(corner < 2 ? -1.0 : 1.0), along_second);
  }
  forces.swept = -swept_volume(u, A0, C0);
  return forces;
}

}  // namespace menger::fem::detail
