#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fem/boxes/box_mesh.h"
#include "fem/boxes/explicit_kernel.h"
#include "fem/explicit/explicit_elements.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Trilinear elements with mean dilatation (Q1/P0), which are boxes in the reference configuration. Walls of any thickness can be
/// cut into any number of layers. One layer is too stiff or, on fine meshes, too soft where a wall bends.
class ThreeFieldElements final : public ExplicitElements {
 public:
  /// @throws io::InputError for elements that are no boxes along the axes
  ThreeFieldElements(const meshes::HexahedralMesh& mesh, std::vector<ExplicitRegion> regions, const ExplicitKernels& kernels);

  [[nodiscard]] std::string text() const override;
  [[nodiscard]] double contact_modulus_Pa() const override;
  [[nodiscard]] bool take_pressure() const override { return false; }
  [[nodiscard]] std::size_t lane_count() const override { return kernels_.width; }
  [[nodiscard]] std::unique_ptr<ElementForces> make_forces() const override;
  [[nodiscard]] BranchNumbers branches_at_rest(std::span<const double> displacements_m) const override;
  [[nodiscard]] double strain_energy_J(std::span<const double> displacements_m, const BranchNumbers& branches) const override;
  [[nodiscard]] std::optional<FailedElement> failed_element(std::span<const double> displacements_m) const override;

  [[nodiscard]] const BoxMesh& boxes() const { return boxes_; }
  [[nodiscard]] std::size_t plenum_count() const { return plenum_count_; }

  /// Computes the forces of some batches and writes them to their slots in an array of 24 width numbers per batch (see
  /// ExplicitKernels::forces).
  /// @param branch of all batches
  ElementsOutcome forces(const NodalMotion& motion, IndexRange batches, const BranchTensors& branch, double* slots_N) const;
  /// See BranchTensors.
  [[nodiscard]] std::size_t sets_apart() const { return branch_position(boxes_.batch_count()); }

 private:
  struct LaneEnergies {
    AlignedNumbers energies_J;  ///< per lane
    AlignedNumbers smallest_ratios;
  };
  [[nodiscard]] LaneEnergies lane_energies(std::span<const double> displacements_m, const AlignedNumbers& branch) const;
  [[nodiscard]] std::size_t branch_position(std::size_t batch) const { return branch_numbers_per_lane * boxes_.width() * batch; }

  ExplicitKernels kernels_;
  std::vector<ExplicitRegion> regions_;
  BoxMesh boxes_;
  std::vector<meshes::Point> points_;
  std::size_t plenum_count_;
};

}  // namespace menger::fem
