#include "fem/thin_walls/thin_wall_kernel.h"

#include <cassert>
#include <cmath>

#include "fem/elements/instruction_sets.h"
#include "fem/thin_walls/thin_wall_kernel_table.h"

namespace menger::fem {
namespace detail {

template <class Number>
ThinWallTask<Number> task_of(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches,
                             const ThinWallMotion<Number>& motion, const ThinWallBranches<const Number>& branches) {
  const double mu = materials::shear_modulus_at_rest_Pa(material.law);
  const double viscosity_Pa_s = motion.velocities_m_per_s == nullptr ? 0.0 : material.viscosity_Pa_s;
  ThinWallTask<Number> task{.law = reference_to(material.law),
                            .shear_modulus_Pa = mu,
                            .bulk_modulus_Pa = material.bulk_modulus_Pa,
                            .wall_penalty_Pa = material.wall_penalty_ratio * mu,
                            .block_stiffness_Pa = material.block_stiffness_ratio * mu,
                            .viscosity_Pa_s = viscosity_Pa_s,
                            .viscous_time_s = viscosity_Pa_s / mu,
                            .branch_modulus_Pa = 0.0,
                            .branch_ratio = 0.0,
                            .branch_count = material.branches.size(),
                            .branch_moduli_Pa = {},
                            .branch_ratios = {},
                            .shares = {},
                            .sets_apart = branches.sets_apart,
                            .branch = material.branches.empty() ? nullptr : branches.values,
                            .relaxing = nullptr,
                            .batches = batches,
                            .motion = motion};
  assert(material.branches.size() <= most_branches);
  for (std::size_t n = 0; n < material.branches.size(); ++n) {
    task.branch_modulus_Pa += material.branches[n].shear_modulus_Pa;
    task.branch_moduli_Pa[n] = material.branches[n].shear_modulus_Pa;
    task.branch_ratios[n] = material.branches[n].shear_modulus_Pa / mu;
  }
  task.branch_ratio = task.branch_modulus_Pa / mu;
  return task;
}

template ThinWallTask<double> task_of(const ThinWallMaterial&, const ThinWallBatches<double>&, const ThinWallMotion<double>&,
                                      const ThinWallBranches<const double>&);
template ThinWallTask<float> task_of(const ThinWallMaterial&, const ThinWallBatches<float>&, const ThinWallMotion<float>&,
                                     const ThinWallBranches<const float>&);

}  // namespace detail

namespace {

using detail::task_of;
using detail::ThinWallTable;
using detail::ThinWallTask;

/// All kernels this machine can run, the widest last.
template <class Number>
const std::vector<const ThinWallTable<Number>*>& available_tables() {
  static const std::vector<const ThinWallTable<Number>*> tables = [] {
    std::vector<const ThinWallTable<Number>*> result{&detail::scalar_thin_walls<Number>(),
                                                     &detail::baseline_thin_walls<Number>()};
#ifdef MENGER_X86_KERNELS
    if (detail::has_avx2()) result.push_back(&detail::avx2_thin_walls<Number>());
#endif
#ifdef MENGER_AVX512_KERNELS
    if (detail::has_avx512()) result.push_back(&detail::avx512_thin_walls<Number>());
#endif
    return result;
  }();
  return tables;
}

}  // namespace

std::array<double, shape_numbers_per_lane> shape_of(const std::array<double, 3>& edges_m) {
  std::array<double, shape_numbers_per_lane> shape{};
  for (std::size_t i = 0; i < 3; ++i) {
    assert(edges_m[i] > 0.0);
    shape[i] = 0.25 / edges_m[i];
  }
  shape[3] = edges_m[0] * edges_m[1] * edges_m[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const double slenderness = edges_m[i] / edges_m[2];
    shape[4 + i] = 1.0 / std::sqrt(1.0 + 0.25 * detail::shear_factor * slenderness * slenderness);
  }
  return shape;
}

template <class Number>
ThinWallKernels<Number>::ThinWallKernels(const ThinWallTable<Number>& table)
    : instruction_set(table.instruction_set), width(table.width), lane_places_(table.lane_places), table_(&table) {}

template <class Number>
ThinWallOutcome ThinWallKernels<Number>::forces(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches,
                                                const ThinWallMotion<Number>& motion, const ThinWallBranches<Number>& branches,
                                                Number* slots_N) const {
  ThinWallTask<Number> task = task_of<Number>(material, batches, motion, {branches.values, 0.0, branches.sets_apart});
  if (task.branch != nullptr && branches.relaxed_s > 0.0) {
    for (std::size_t n = 0; n < material.branches.size(); ++n)
      task.shares[n] = -std::expm1(-branches.relaxed_s / material.branches[n].relaxation_time_s);
    task.relaxing = branches.values;
  }
  return table_->forces(task, slots_N);
}

template <class Number>
void ThinWallKernels<Number>::energies(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches,
                                       const ThinWallMotion<Number>& motion, const ThinWallBranches<const Number>& branches,
                                       Number* energies_J, Number* smallest_ratios) const {
  table_->energies(task_of<Number>(material, batches, motion, branches), energies_J, smallest_ratios);
}

template <class Number>
void ThinWallKernels<Number>::rest_branches(const ThinWallBatches<Number>& batches, const ThinWallMotion<Number>& motion,
                                            Number* branch) const {
  const ThinWallMaterial any{.law = materials::NeoHookean{1.0}, .bulk_modulus_Pa = 1.0};
  table_->rest_branches(task_of<Number>(any, batches, motion, {}), branch);
}

template class ThinWallKernels<double>;
template class ThinWallKernels<float>;

template <class Number>
std::vector<ThinWallKernels<Number>> available_thin_wall_kernels() {
  std::vector<ThinWallKernels<Number>> kernels;
  for (const ThinWallTable<Number>* table : available_tables<Number>()) kernels.emplace_back(*table);
  return kernels;
}

template std::vector<ThinWallKernels<double>> available_thin_wall_kernels();
template std::vector<ThinWallKernels<float>> available_thin_wall_kernels();

template <class Number>
ThinWallKernels<Number> best_thin_wall_kernels() {
  return ThinWallKernels<Number>(*available_tables<Number>().back());
}

template ThinWallKernels<double> best_thin_wall_kernels();
template ThinWallKernels<float> best_thin_wall_kernels();

}  // namespace menger::fem
