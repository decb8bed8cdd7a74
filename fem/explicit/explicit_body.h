#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "fem/explicit/explicit_elements.h"
#include "fem/explicit/thin_wall_elements.h"
#include "fem/surfaces/support.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Options of elements with mean dilatation: the SIMD kernels that compute them. See ThreeFieldElements.
struct ThreeFieldOptions {
  ExplicitKernels kernels = best_explicit_kernels();
};

/// Which elements a body has, with their options.
using ElementOptions = std::variant<ThreeFieldOptions, ThinWallOptions>;

/// The materials, supports and elements of a body.
struct ExplicitBodyOptions {
  std::vector<ExplicitRegion> regions;       ///< one per region of the mesh
  std::vector<Support> supports;             ///< nodes of labels that are held
  std::vector<PointSupport> point_supports;  ///< single nodes that are held
  ElementOptions elements;
};

/// A body for explicit dynamics: its elements, lumped masses and supports. Values are per node a of the mesh, component i at
/// 3 a + i. Masses are row sums: each corner of an element gets an eighth of the element's exact mass.
class ExplicitBody {
 public:
  /// Makes a body from a mesh.
  /// @throws io::InputError for elements that are no boxes along the axes, elements of a region that the mesh does not have, a
  /// number of materials that is not that of the mesh's regions, nodes without an element, densities that are not positive,
  /// negative viscosities and branch moduli, and branches that never relax
  ExplicitBody(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options);

  [[nodiscard]] std::size_t node_count() const { return masses_.size(); }
  [[nodiscard]] const ExplicitElements& elements() const { return *elements_; }
  [[nodiscard]] const std::vector<double>& reference_positions_m() const { return positions_; }
  [[nodiscard]] const std::vector<double>& masses_kg() const { return masses_; }  ///< per node
  /// Inverse masses per component; 0 where the component is held.
  [[nodiscard]] const std::vector<double>& inverse_masses_per_kg() const { return inverse_masses_; }
  [[nodiscard]] double mass_kg() const;
  /// The shear modulus at rest, integrated over the volume: a measure of the body's energies.
  [[nodiscard]] double stiffness_J() const { return stiffness_J_; }
  [[nodiscard]] double smallest_density_kg_per_m3() const;                   ///< of the materials
  [[nodiscard]] double smallest_edge_m() const { return smallest_edge_m_; }  ///< of the elements

  [[nodiscard]] bool is_viscous() const;  ///< whether a region has a viscosity
  /// Returns the shortest relaxation time of all branches; empty if there are none.
  [[nodiscard]] std::optional<double> shortest_relaxation_time_s() const;

 private:
  void add_masses(const meshes::HexahedralMesh& mesh);
  void hold(const meshes::HexahedralMesh& mesh, const ExplicitBodyOptions& options);
  void hold_node(std::size_t node, const std::array<bool, 3>& held);

  std::vector<ExplicitRegion> regions_;
  std::unique_ptr<ExplicitElements> elements_;
  std::vector<double> positions_;
  std::vector<double> masses_;
  std::vector<double> inverse_masses_;
  double stiffness_J_ = 0.0;
  double smallest_edge_m_ = 0.0;
};

}  // namespace menger::fem
