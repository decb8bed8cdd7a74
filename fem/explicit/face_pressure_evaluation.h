#pragma once

// The pressure on faces for one type of packs. Included only by the files face_pressure_kernel_<instruction set>.cpp, each
// compiled for its own.

#include "fem/explicit/face_forces.h"
#include "fem/explicit/face_pressure_table.h"
#include "fem/thin_walls/pack_gather.h"
#include "fem/thin_walls/pack_scatter.h"

namespace menger::fem::detail {

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

/// See FacePressureKernels.
template <class T>
void face_pressure_forces(const FaceBatches<NumberOf<T>>& batches, const NumberOf<T>* values_m, NumberOf<T>* slots_N) {
  constexpr std::size_t width = Lanes<T>::count;
  const T none(0.0);
  for (std::size_t batch = 0; batch < batches.count; ++batch) {
    const std::uint32_t* nodes = batches.first_components + 4 * width * batch;
    std::array<Vector3<T>, 4> values;
    for (std::size_t c = 0; c < 4; ++c) values[c] = CornerGather<T, 4>::gather(nodes + c, values_m);
    Vector3<T> A0{none, none, none};
    Vector3<T> C0{none, none, none};
    if (batches.half_edges_m != nullptr) {
      const NumberOf<T>* edges = batches.half_edges_m + half_edge_numbers_per_face * width * batch;
      for (std::size_t i = 0; i < 3; ++i) {
        A0[i] = Lanes<T>::load(edges + i * width);
        C0[i] = Lanes<T>::load(edges + (3 + i) * width);
      }
    }
    const FaceForces<T> forces = face_forces(values, A0, C0, T(-batches.pressure_Pa), T(-batches.pressure_Pa / 3.0));
    NumberOf<T>* slots = slots_N + slot_numbers_per_face * width * batch;
    for (std::size_t c = 0; c < 4; ++c) CornerScatter<T>::scatter(forces.corners[c], slots + 4 * width * c);
    if (batches.volumes_m3 != nullptr) batches.volumes_m3[batch] = lane_sum(forces.swept);
  }
}

template <class T>
const FacePressureTable<NumberOf<T>>& face_pressure_table(const char* instruction_set) {
  static const FacePressureTable<NumberOf<T>> table{instruction_set, Lanes<T>::count, lane_places<T>(), face_pressure_forces<T>};
  return table;
}

}  // namespace menger::fem::detail
