#pragma once

#include "fem/explicit/face_pressure_kernel.h"

namespace menger::fem::detail {

/// The function of one instruction set.
template <class Number>
struct FacePressureTable {
  std::string_view instruction_set;
  std::size_t width;
  LanePlaces lane_places;
  void (*forces)(const FaceBatches<Number>& batches, const Number* values_m, Number* slots_N);
};

template <class Number>
const FacePressureTable<Number>& baseline_face_pressure();
template <class Number>
const FacePressureTable<Number>& avx2_face_pressure();
template <class Number>
const FacePressureTable<Number>& avx512_face_pressure();

template <>
const FacePressureTable<double>& baseline_face_pressure();
template <>
const FacePressureTable<float>& baseline_face_pressure();
template <>
const FacePressureTable<double>& avx2_face_pressure();
template <>
const FacePressureTable<float>& avx2_face_pressure();
template <>
const FacePressureTable<double>& avx512_face_pressure();
template <>
const FacePressureTable<float>& avx512_face_pressure();

}  // namespace menger::fem::detail
