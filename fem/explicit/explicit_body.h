#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fem/explicit/box_mesh.h"
#include "fem/explicit/explicit_kernel.h"
#include "fem/surfaces/support.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// The material of a region of a body.
struct ExplicitRegion {
  ExplicitMaterial material;
  double density_kg_per_m3 = 0.0;  ///< of the reference configuration, > 0
};

/// The materials and supports of a body.
struct ExplicitBodyOptions {
  std::vector<ExplicitRegion> regions;       ///< one per region of the mesh
  std::vector<Support> supports;             ///< nodes of labels that are held
  std::vector<PointSupport> point_supports;  ///< single nodes that are held
};

/// An element that has failed: its volume ratio is not positive, or its law gives no stress there.
struct FailedElement {
  std::size_t element;    ///< of the mesh
  Point position_m;       ///< its first corner in the reference configuration
  bool is_finite = true;  ///< whether its displacements are finite
};

/// A body for explicit dynamics: its box elements, lumped masses and supports. Values are per node a of the mesh, component i at
/// 3 a + i. Masses are row sums: each corner of an element gets an eighth of the element's exact mass.
class ExplicitBody {
 public:
  /// Makes a body from a mesh.
  /// @throws io::InputError for elements that are no boxes along the axes, elements of a region that the mesh does not have, a
  /// number of materials that is not that of the mesh's regions, nodes without an element, densities that are not positive,
  /// negative viscosities and branch moduli, and branches that never relax
  ExplicitBody(const meshes::HexahedralMesh& mesh, ExplicitBodyOptions options,
               const ExplicitKernels& kernels = best_explicit_kernels());

  [[nodiscard]] std::size_t node_count() const { return boxes_.node_count(); }
  [[nodiscard]] const BoxMesh& boxes() const { return boxes_; }
  [[nodiscard]] const ExplicitKernels& kernels() const { return kernels_; }
  [[nodiscard]] const ExplicitRegion& region(std::size_t region) const { return regions_[region]; }
  [[nodiscard]] const std::vector<double>& reference_positions_m() const { return positions_; }
  [[nodiscard]] const std::vector<double>& masses_kg() const { return masses_; }  ///< per node
  /// Inverse masses per component; 0 where the component is held.
  [[nodiscard]] const std::vector<double>& inverse_masses_per_kg() const { return inverse_masses_; }
  [[nodiscard]] double mass_kg() const;
  /// The shear modulus at rest, integrated over the volume: a measure of the body's energies.
  [[nodiscard]] double stiffness_J() const;

  /// Returns the shortest relaxation time of all branches; empty if there are none.
  [[nodiscard]] std::optional<double> shortest_relaxation_time_s() const;
  /// Returns the tensors of all batches (see BranchTensors) for branches at rest at these displacements; empty without branches.
  /// No element may have failed.
  [[nodiscard]] AlignedNumbers branches_at_rest(std::span<const double> displacements_m) const;

  /// Computes the forces of some batches and writes them to their slots in an array of 24 width numbers per batch (see
  /// ExplicitKernels::forces).
  /// @param branch of all batches
  ElementsOutcome element_forces(const NodalMotion& motion, std::size_t first_batch, std::size_t batch_count, double* slots_N,
                                 const BranchTensors& branch = {}) const;

  /// Returns the strain energy of the body.
  /// @param displacements_m 3 node_count numbers
  /// @param branch tensors of all batches; empty: without the energy of branches
  [[nodiscard]] double strain_energy_J(std::span<const double> displacements_m, std::span<const double> branch = {}) const;

  /// Returns the first element that has failed, if any.
  [[nodiscard]] std::optional<FailedElement> failed_element(std::span<const double> displacements_m) const;

  /// Returns the position of the first number of a batch in the tensors of all batches.
  [[nodiscard]] std::size_t branch_position(std::size_t batch) const { return branch_numbers_per_lane * boxes_.width() * batch; }

 private:
  struct ElementEnergies {
    AlignedNumbers energies_J;  ///< per lane
    AlignedNumbers smallest_ratios;
  };
  [[nodiscard]] ElementEnergies element_energies(std::span<const double> displacements_m, std::span<const double> branch) const;
  void hold(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options);
  void hold_node(std::size_t node, const std::array<bool, 3>& held);

  ExplicitKernels kernels_;
  std::vector<ExplicitRegion> regions_;
  BoxMesh boxes_;
  std::vector<double> positions_;
  std::vector<double> masses_;
  std::vector<double> inverse_masses_;
};

}  // namespace menger::fem
