#pragma once

#include "fem/elements/element_kernel.h"
#include "fem/elements/pack_laws.h"

namespace menger::fem::detail {

/// The element and the laws of a task. Laws are given by index and address, so that the files of one instruction set do not visit
/// variants.
struct ElementTask {
  int degree;
  Formulation formulation;
  LawReference law;
  LawReference volume;
};

/// The kernel functions of one instruction set.
struct KernelTable {
  std::string_view instruction_set;
  std::size_t width;
  void (*evaluate)(const ElementTask& task, const ElementBatch& batch);
  void (*predict_pressure)(const ElementTask& task, const ElementBatch& batch, const double* step, double* predicted_pressure);
  void (*evaluate_points)(const ElementTask& task, const ElementBatch& batch, const PointFields& fields);
};

const KernelTable& baseline_kernels();
const KernelTable& avx2_kernels();
const KernelTable& avx512_kernels();

}  // namespace menger::fem::detail
