#pragma once

// The pressure on faces for one type of packs. Included only by the files face_pressure_kernel_<instruction set>.cpp, each
// compiled for its own.

#include "fem/explicit/face_pressure_table.h"
#include "fem/thin_walls/corner_gather.h"
#include "fem/thin_walls/corner_scatter.h"

namespace menger::fem::detail {

template <class T>
Vector3<T> sum(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class T>
Vector3<T> edge(const Vector3<T>& from, const Vector3<T>& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

/// int N_a x_u x x_v du dv over the bilinear face: with edges e along u (at v = 0 and 1) and along v, the integrand is
/// (e_u0 (1 - v) + e_u1 v) x (e_v0 (1 - u) + e_v1 u), and N_a is a product of 1 - u or u and 1 - v or v.
template <class T>
void face_pressure_forces(const FaceBatches& batches, const double* positions_m, double* slots_N) {
  constexpr std::size_t width = Lanes<T>::count;
  for (std::size_t batch = 0; batch < batches.count; ++batch) {
    const std::uint32_t* nodes = batches.first_components + 4 * width * batch;
    std::array<Vector3<T>, 4> x;
    for (std::size_t c = 0; c < 4; ++c) x[c] = CornerGather<T, 4>::gather(nodes + c, positions_m);
    const T share(-batches.pressures_Pa[batch] / 36.0);
    const Vector3<T> u0 = edge(x[0], x[1]);
    const Vector3<T> u1 = edge(x[3], x[2]);
    const Vector3<T> v0 = scaled(share, edge(x[0], x[3]));
    const Vector3<T> v1 = scaled(share, edge(x[1], x[2]));
    const Vector3<T> u = sum(u0, u1);
    const Vector3<T> v = sum(v0, v1);
    const Vector3<T> u_low = sum(u, u0);
    const Vector3<T> u_high = sum(u, u1);
    const Vector3<T> v_low = sum(v, v0);
    const Vector3<T> v_high = sum(v, v1);
    double* slots = slots_N + slot_numbers_per_face * width * batch;
    CornerScatter<T, slot_numbers_per_face>::scatter(cross(u_low, v_low), slots);
    CornerScatter<T, slot_numbers_per_face>::scatter(cross(u_low, v_high), slots + 4);
    CornerScatter<T, slot_numbers_per_face>::scatter(cross(u_high, v_high), slots + 8);
    CornerScatter<T, slot_numbers_per_face>::scatter(cross(u_high, v_low), slots + 12);
  }
}

template <class T>
const FacePressureTable& face_pressure_table(const char* instruction_set) {
  static const FacePressureTable table{instruction_set, Lanes<T>::count, face_pressure_forces<T>};
  return table;
}

}  // namespace menger::fem::detail
