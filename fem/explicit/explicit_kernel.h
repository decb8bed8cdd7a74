#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fem/elements/volumetric_law.h"
#include "fem/explicit/maxwell_branch.h"
#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {

/// What elements of explicit dynamics are made of: P = d psi/dF of the law with the mean dilatation of the element, plus the
/// stress of a Maxwell branch, plus a viscous stress.
///
/// The viscous Kirchhoff stress is 2 eta dev(d), d the rate of deformation: objective, without pressure, and never a source of
/// energy.
struct ExplicitMaterial {
  materials::HyperelasticLaw law;
  VolumetricLaw volume;
  double viscosity_Pa_s = 0.0;  ///< eta >= 0; 0: none
  MaxwellBranch branch{};
};

/// Batches of trilinear elements of equal material that are boxes along the axes in the reference configuration. Lanes without an
/// element repeat another one.
struct BoxBatches {
  std::size_t count = 0;
  /// Per lane eight corners in the order of meshes::ElementCorners: three times the index of the node; corner c of lane l of
  /// batch b at 8 (b width + l) + c.
  const std::uint32_t* first_components = nullptr;
  const double* inverse_edges_per_m = nullptr;  ///< per batch 1/h along x, y, z, interleaved: entry i of lane l at i width + l
  const double* volumes_m3 = nullptr;           ///< per batch and lane
};

/// Where a body is; component i of node a at 3 a + i.
struct NodalMotion {
  const double* displacements_m = nullptr;
  const double* velocities_m_per_s = nullptr;  ///< read where there is a viscosity; nullptr: no viscous force
};

/// Of the tensors of a lane: six components at eight points.
inline constexpr std::size_t branch_numbers_per_lane = 48;

/// Tensors A of the branches (see MaxwellBranch) of batches: per batch 48 width numbers, component c (xx, yy, zz, yz, xz, xy) of
/// point q of lane l at (6 q + c) width + l; aligned to 64 bytes.
struct BranchTensors {
  double* values = nullptr;  ///< nullptr: no branch acts
  /// >= 0, the time by which they relax at the deformation that is given; forces are those of the mean of before and after, as
  /// central differences want them at the end of one spring and the beginning of another.
  double relaxed_s = 0.0;
};

/// What elements say besides their forces.
struct ElementsOutcome {
  double smallest_ratio = 1.0;  ///< of the volume, over all points and elements; not positive where the law has no answer
  double dissipated_W = 0.0;    ///< by the viscous stress, >= 0
  double relaxed_J = 0.0;       ///< what the branches' energy fell by while they relaxed, >= 0 up to rounding
};

/// What bounds of the eigenvalues need of elements. Arrays hold numbers per batch and are aligned to 64 bytes.
struct ElementBounds {
  double* volume_gradients_m2;  ///< 24 width: d(volume)/du, in the order of the forces
  double* bulk_moduli_Pa;       ///< width: U'' at the mean dilatation
  double* deviatoric_squares;   ///< width: largest |dev sym(G F^-1)|^2 over |G| = 1 and the points; 1 at rest
  /// width: not less than half the largest second derivative of the branch's energy over its modulus, over |G| = 1 and the
  /// points; 1 at rest, 0 without a branch
  double* branch_squares;
};

namespace detail {
struct ExplicitKernelTable;
}

/// Internal forces of eight-point Q1/P0 elements with mean dilatation, for explicit dynamics; one instruction set.
///
/// The energy is that of `Formulation::three_field` of degree 1: forces agree with the residual of ElementKernels to rounding.
/// Results of two instruction sets differ by rounding.
class ExplicitKernels {
 public:
  explicit ExplicitKernels(const detail::ExplicitKernelTable& table);

  std::string_view instruction_set;  ///< "baseline", "avx2", "avx512"
  std::size_t width;                 ///< lanes: elements computed at once

  /// @param branch changed where they relax @param forces_N per batch 24 width numbers, aligned to 64 bytes: d(energy)/du plus
  /// the viscous force, component i of corner c of lane l at (3 c + i) width + l; to be subtracted from what accelerates the
  /// nodes
  ElementsOutcome forces(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion,
                         const BranchTensors& branch, double* forces_N) const;

  /// Strain energy of each lane of each batch, J, with that of its branches, and its smallest volume ratio, as above; both
  /// aligned to 64 bytes. @param branch values as of BranchTensors, nullptr: without them
  void energies(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion, const double* branch,
                double* energies_J, double* smallest_ratios) const;

  /// @param branch as above
  void bounds(const ExplicitMaterial& material, const BoxBatches& batches, const NodalMotion& motion, const double* branch,
              const ElementBounds& bounds) const;

 private:
  const detail::ExplicitKernelTable* table_;
};

/// The kernels of the widest instruction set that this machine has.
ExplicitKernels best_explicit_kernels();

/// All kernels that this machine can run, the portable ones first.
std::vector<ExplicitKernels> available_explicit_kernels();

}  // namespace menger::fem
