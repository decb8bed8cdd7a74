#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fem/surfaces/point.h"
#include "meshes/hexahedra/hexahedral_mesh.h"
#include "meshes/load_cases/body_extents.h"

namespace menger::fem {

/// How a body stands, by its six ends: see meshes::rotation_of_body.
class BodyPosture {
 public:
  /// Keeps a reference to the mesh, which describes the body at rest.
  explicit BodyPosture(const meshes::HexahedralMesh& mesh);

  /// Returns the body's own upright axis: the direction into which the rotation of the body turns the vertical. Its length is 1.
  /// @param displacements_m 3 per node of the mesh
  [[nodiscard]] Point upright_axis(std::span<const double> displacements_m) const;

 private:
  [[nodiscard]] meshes::EndPoints ends_m(std::span<const double> displacements_m) const;

  const meshes::HexahedralMesh& mesh_;
  std::array<std::array<std::vector<std::size_t>, 2>, 3> nodes_;  ///< of the ends: [axis][low, high]
  meshes::EndPoints at_rest_m_{};
};

}  // namespace menger::fem
