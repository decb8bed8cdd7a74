#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fem/elements/maxwell_branch.h"
#include "fem/elements/volumetric_law.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {

/// The material of elements of explicit dynamics: P = d psi/dF of the law with the mean dilatation of the element, plus the
/// stress of Maxwell branches, plus a viscous stress.
///
/// The viscous Kirchhoff stress is 2 eta dev(d) with the rate of deformation d. It is objective, has no pressure part, and never
/// adds energy.
struct ExplicitMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume;
  double viscosity_Pa_s = 0.0;            ///< eta >= 0; 0: none
  std::vector<MaxwellBranch> branches{};  ///< at most most_branches, all with a modulus
};

/// Batches of trilinear elements of one material that are boxes along the axes in the reference configuration. Lanes without an
/// element repeat another one.
struct BoxBatches {
  std::size_t count = 0;
  /// Eight corners per lane in the order of meshes::ElementCorners, each as three times the index of its node. Corner c of lane l
  /// of batch b is at 8 (b width + l) + c.
  const std::uint32_t* first_components = nullptr;
  const double* inverse_edges_per_m = nullptr;  ///< per batch 1/h along x, y, z, interleaved: entry i of lane l at i width + l
  const double* volumes_m3 = nullptr;           ///< per batch and lane
};

/// The motion of a body's nodes; component i of node a at 3 a + i.
struct NodalMotion {
  const double* displacements_m = nullptr;
  const double* velocities_m_per_s = nullptr;  ///< read if there is a viscosity; nullptr: no viscous force
};

/// Numbers in the tensors of a lane, in one set: six components at eight points.
inline constexpr std::size_t branch_numbers_per_lane = 48;

/// The tensors A of the branches (see MaxwellBranch) of some batches: in each set (see branch_set_count) 48 width numbers per
/// batch, aligned to 64 bytes. Component c (xx, yy, zz, yz, xz, xy) of point q of lane l is at (6 q + c) width + l.
struct BranchTensors {
  double* values = nullptr;  ///< of the first set; nullptr: no branch acts
  /// >= 0: the time by which they relax at the given deformation. Forces are those of the mean of the tensors before and after.
  /// Central differences need this mean, since one spring ends and another begins at this time.
  double relaxed_s = 0.0;
  std::size_t sets_apart = 0;  ///< how far the same number of the next set is; not read for one branch
};

/// Results of elements other than their forces.
struct ElementsOutcome {
  /// The smallest volume ratio of all points and elements; not positive where the law gives no stress.
  double smallest_ratio = 1.0;
  double dissipated_W = 0.0;  ///< by the viscous stress, >= 0
  /// The decrease of the branches' energy while they relaxed, >= 0 up to rounding.
  double relaxed_J = 0.0;
};

namespace detail {
struct ExplicitKernelTable;
}

/// Kernels of one instruction set for explicit dynamics: internal forces of eight-point Q1/P0 elements with mean dilatation.
///
/// The energy is that of `Formulation::three_field` of degree 1: the forces agree with the residual of ElementKernels to
/// rounding. Results of two instruction sets differ by rounding.
class ExplicitKernels {
 public:
  explicit ExplicitKernels(const detail::ExplicitKernelTable& table);

  std::string_view instruction_set;  ///< "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: elements computed at once

  /// Computes the nodal forces of elements: d(energy)/du plus the viscous force. They have to be subtracted from the forces that
  /// accelerate the nodes.
  /// @param branch tensors, changed if they relax
  /// @param forces_N per batch 24 width numbers, aligned to 64 bytes; component i of corner c of lane l at (3 c + i) width + l
  ElementsOutcome forces(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion,
                         const BranchTensors& branch, double* forces_N) const;

  /// Computes for each lane of each batch the strain energy, J, with that of its branches, and the smallest volume ratio, as in
  /// ElementsOutcome. Both arrays are aligned to 64 bytes.
  /// @param branch values as in BranchTensors; nullptr: without branches
  /// @param sets_apart see BranchTensors
  void energies(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion, const double* branch,
                std::size_t sets_apart, double* energies_J, double* smallest_ratios) const;

 private:
  const detail::ExplicitKernelTable* table_;
};

/// Returns the kernels of the widest instruction set that this machine has.
ExplicitKernels best_explicit_kernels();

/// Returns all kernels that this machine can run, the portable ones first.
std::vector<ExplicitKernels> available_explicit_kernels();

}  // namespace menger::fem
