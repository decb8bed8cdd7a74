#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "fem/statics/inflation_path.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// A body on a mesh, its space and its solver, and what its last path has reached.
class Model {
 public:
  Model(meshes::HexahedralMesh mesh, int degree, Body body, const EquilibriumOptions& options = {});
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Follows a path from rest; one that does not end as expected fails the test. @param observe called at every point, with its
  /// state in `state`
  const PathReport& follow(const std::vector<PlenumDrive>& drives, const PathOptions& options = {},
                           const std::function<void(const PathPoint&)>& observe = {},
                           io::RunStatus expected = io::RunStatus::completed);

  /// Displacement of the node nearest to a point of the reference configuration, m. Collective.
  [[nodiscard]] Point displacement_at(const Point& point) const;

  /// Largest difference of a displacement component from that of another model on the same space, m. Collective.
  [[nodiscard]] double distance_to(const Model& other) const;

  [[nodiscard]] double plenum_volume_ratio(std::size_t plenum) const;  ///< of the last state to the first
  [[nodiscard]] double pressure_Pa(std::size_t plenum) const { return report.points.back().pressures_Pa[plenum]; }
  [[nodiscard]] double strain_energy_J() const { return report.points.back().strain_energy_J; }

  const meshes::HexahedralMesh mesh;
  const Body body;
  const Space space;
  Equilibrium equilibrium;
  BodyState state;
  PathReport report;
};

/// A body of one region without density.
Body body_of(const materials::HyperelasticLaw& law, const VolumetricLaw& volume,
             Formulation formulation = Formulation::three_field);

/// Adds a support on the faces with a label.
void hold(Body& body, const meshes::HexahedralMesh& mesh, std::string_view label, const std::array<bool, 3>& held);

/// Adds the supports of the planes "symmetry x", "symmetry y" and "symmetry z", as far as the mesh has them.
void hold_symmetry(Body& body, const meshes::HexahedralMesh& mesh);

/// Adds the chambers and plena of the mesh.
void add_chambers(Body& body, const meshes::HexahedralMesh& mesh);

/// A path in equal steps, however many iterations they take.
PathOptions equal_steps(int count);

}  // namespace menger::fem
