#pragma once

#include "fem/elements/pack_laws.h"
#include "fem/thin_walls/thin_wall_kernel.h"

namespace menger::fem::detail {

/// The shear factor k of a plate.
inline constexpr double shear_factor = 5.0 / 6.0;

/// Elements and their material as kernels take it; the law by index and address, so that files of one instruction set need not
/// visit variants.
template <class Number>
struct ThinWallTask {
  LawReference law;
  double shear_modulus_Pa;  ///< mu, of the law at rest
  double bulk_modulus_Pa;
  double wall_penalty_Pa;     ///< kappa'
  double block_stiffness_Pa;  ///< lambda
  double viscosity_Pa_s;      ///< 0 where there are no velocities
  double viscous_time_s;      ///< viscosity_Pa_s / shear_modulus_Pa
  double branch_modulus_Pa;   ///< of all branches
  double branch_ratio;        ///< branch_modulus_Pa / shear_modulus_Pa
  std::size_t branch_count;
  std::array<double, most_branches> branch_moduli_Pa;  ///< of each branch
  std::array<double, most_branches> branch_ratios;
  std::array<double, most_branches> shares;  ///< of the way to rest that each goes before they act, in [0, 1]
  std::size_t sets_apart;                    ///< see ThinWallBranches
  const Number* branch;                      ///< the first set; nullptr: none
  Number* relaxing;                          ///< the same where they go a part of the way
  ThinWallBatches<Number> batches;
  ThinWallMotion<Number> motion;
};

/// Returns the task of computing elements, which keeps references to the material. @param branches do not relax
template <class Number>
ThinWallTask<Number> task_of(const ThinWallMaterial& material, const ThinWallBatches<Number>& batches,
                             const ThinWallMotion<Number>& motion, const ThinWallBranches<const Number>& branches);

/// The functions of one instruction set.
template <class Number>
struct ThinWallTable {
  std::string_view instruction_set;
  std::size_t width;
  LanePlaces lane_places;
  ThinWallOutcome (*forces)(const ThinWallTask<Number>& task, Number* slots_N);
  void (*energies)(const ThinWallTask<Number>& task, Number* energies_J, Number* smallest_ratios);
  void (*rest_branches)(const ThinWallTask<Number>& task, Number* branch);
};

template <class Number>
const ThinWallTable<Number>& scalar_thin_walls();
template <class Number>
const ThinWallTable<Number>& baseline_thin_walls();
template <class Number>
const ThinWallTable<Number>& avx2_thin_walls();
template <class Number>
const ThinWallTable<Number>& avx512_thin_walls();

}  // namespace menger::fem::detail
