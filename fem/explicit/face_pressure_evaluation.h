#pragma once

// The pressure on faces for one type of packs. Included only by the files face_pressure_kernel_<instruction set>.cpp, each
// compiled for its own.

#include "fem/explicit/face_pressure_table.h"
#include "fem/thin_walls/pack_gather.h"
#include "fem/thin_walls/pack_scatter.h"

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
FaceField<T> face_field(const std::array<Vector3<T>, 4>& values) {
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

/// The sum of the lanes, in double precision.
template <class T>
double lane_sum(const T& values) {
  alignas(64) std::array<NumberOf<T>, Lanes<T>::count> lanes;
  Lanes<T>::store(values, lanes.data());
  std::array<double, Lanes<T>::count> sums;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) sums[lane] = static_cast<double>(lanes[lane]);
  for (std::size_t half = lanes.size() / 2; half > 0; half /= 2)
    for (std::size_t lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
  return sums[0];
}

/// The volume that a face has swept along the normal of its corners' order: int_0^1 int u . n dA dtau over the faces between the
/// one at rest, tau = 0, and the present one. With A = A0 + first, C = C0 + second and twist = k, the area vector on the way is
/// (A0 + tau (first + eta k)) x (C0 + tau (second + xi k)), and the integral
/// 4 middle . (A0 x C0 + (A0 x second + first x C0)/2 + first x second/3) + 2/3 (first . (A0 x k) + second . (k x C0)).
template <class T>
[[gnu::always_inline]] inline T swept_volume(const FaceField<T>& u, const Vector3<T>& A0, const Vector3<T>& C0) {
  Vector3<T> area = cross(A0, C0);
  add(area, T(0.5), cross(A0, u.second));
  add(area, T(0.5), cross(u.first, C0));
  add(area, T(1.0 / 3.0), cross(u.first, u.second));
  const T of_twist = dot(u.first, cross(A0, u.twist)) + dot(u.second, cross(u.twist, C0));
  return fma(T(4.0), dot(u.middle, area), T(2.0 / 3.0) * of_twist);
}

/// int N_a x_xi x x_eta dxi deta over the bilinear face: with the tangents A and C in the middle and the twist k, the integrand
/// is (A + eta k) x (C + xi k) = A x C + xi A x k + eta k x C, and N_a = (1 +- xi)(1 +- eta)/4, which gives A x C +- A x k/3 +- k
/// x C/3.
template <class T>
void face_pressure_forces(const FaceBatches<NumberOf<T>>& batches, const NumberOf<T>* values_m, NumberOf<T>* slots_N) {
  constexpr std::size_t width = Lanes<T>::count;
  const T none(0.0);
  for (std::size_t batch = 0; batch < batches.count; ++batch) {
    const std::uint32_t* nodes = batches.first_components + 4 * width * batch;
    std::array<Vector3<T>, 4> values;
    for (std::size_t c = 0; c < 4; ++c) values[c] = CornerGather<T, 4>::gather(nodes + c, values_m);
    const FaceField<T> u = face_field(values);
    Vector3<T> A0{none, none, none};
    Vector3<T> C0{none, none, none};
    if (batches.half_edges_m != nullptr) {
      const NumberOf<T>* edges = batches.half_edges_m + half_edge_numbers_per_face * width * batch;
      for (std::size_t i = 0; i < 3; ++i) {
        A0[i] = Lanes<T>::load(edges + i * width);
        C0[i] = Lanes<T>::load(edges + (3 + i) * width);
      }
    }
    Vector3<T> A = A0;
    Vector3<T> C = C0;
    add(A, T(1.0), u.first);
    add(C, T(1.0), u.second);
    const Vector3<T> total = scaled(T(-batches.pressure_Pa), cross(A, C));
    const Vector3<T> along_first = scaled(T(-batches.pressure_Pa / 3.0), cross(A, u.twist));
    const Vector3<T> along_second = scaled(T(-batches.pressure_Pa / 3.0), cross(u.twist, C));
    NumberOf<T>* slots = slots_N + slot_numbers_per_face * width * batch;
    const auto store = [&](std::size_t corner, double xi, double eta) {
      Vector3<T> force = total;
      add(force, T(xi), along_first);
      add(force, T(eta), along_second);
      CornerScatter<T>::scatter(force, slots + 4 * width * corner);
    };
    store(0, -1.0, -1.0);
    store(1, 1.0, -1.0);
    store(2, 1.0, 1.0);
    store(3, -1.0, 1.0);
    if (batches.volumes_m3 != nullptr) batches.volumes_m3[batch] = -lane_sum(swept_volume(u, A0, C0));
  }
}

template <class T>
const FacePressureTable<NumberOf<T>>& face_pressure_table(const char* instruction_set) {
  static const FacePressureTable<NumberOf<T>> table{instruction_set, Lanes<T>::count, lane_places<T>(), face_pressure_forces<T>};
  return table;
}

}  // namespace menger::fem::detail
