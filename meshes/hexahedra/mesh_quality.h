#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "meshes/hexahedra/hexahedral_mesh.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::meshes {

/// A volume of the mesh and, if known, its closed form.
struct MeasuredVolume {
  std::string part;  ///< "solid" or the name of a chamber
  double mesh_m3 = 0.0;
  std::optional<double> closed_form_m3;
};

/// The number of modules, holes and edge contacts of a hollow body.
struct HollowBodyCounts {
  std::size_t modules = 1;
  std::size_t holes = 0;          ///< holes through joints
  std::size_t edge_contacts = 0;  ///< places where modules touch only along an edge and are not bonded
};

/// The sizes and shapes of the elements of a mesh.
struct MeshQuality {
  std::size_t points = 0;
  std::size_t elements = 0;
  std::size_t boundary_faces = 0;
  std::size_t chambers = 0;
  std::size_t plenums = 0;
  std::optional<HollowBodyCounts> body;  ///< nothing for meshes that are not hollow bodies
  double scaled_jacobian_min = 0.0;      ///< see scaled_jacobian
  double scaled_jacobian_mean = 0.0;
  double aspect_ratio_max = 0.0;  ///< longest divided by shortest edge of an element
  double shortest_edge_m = 0.0;
  double longest_edge_m = 0.0;
  std::vector<MeasuredVolume> volumes;  ///< the solid, then every chamber
};

/// Refuses a mesh with an inverted element: its determinant is not positive at all points that are checked (see
/// smallest_determinant).
/// @param source text at the start of messages, such as the name of the file
/// @throws io::InputError naming the number of such elements, the first of them and its position
void require_no_inverted_elements(const HexahedralMesh& mesh, const std::string& source);

/// Measures a mesh. It must have elements (asserted), and none of them inverted.
MeshQuality mesh_quality(const HexahedralMesh& mesh);

/// Measures the mesh of a hollow body and adds the closed forms of its volumes.
MeshQuality mesh_quality(const HollowBody& body);

/// Returns a table with the columns quantity, value, closed_form: one row per quantity, with the unit in its name.
io::CsvTable quality_table(const MeshQuality& quality);

/// Returns a few lines for people, in millimetres.
std::string quality_text(const MeshQuality& quality);

}  // namespace menger::meshes
