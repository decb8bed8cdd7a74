#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/text/csv_table.h"
#include "meshes/hexahedra/hexahedral_mesh.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::meshes {

/// A volume of the mesh and, where one is known, its closed form.
struct MeasuredVolume {
  std::string part;  ///< "solid" or the name of a chamber
  double mesh_m3 = 0.0;
  std::optional<double> closed_form_m3;
};

/// What a hollow body is made of.
struct HollowBodyCounts {
  std::size_t modules = 1;
  std::size_t holes = 0;          ///< in joints
  std::size_t edge_contacts = 0;  ///< places where modules touch only along an edge and are not bonded
};

/// Sizes and shapes of the elements of a mesh.
struct MeshQuality {
  std::size_t points = 0;
  std::size_t elements = 0;
  std::size_t boundary_faces = 0;
  std::size_t chambers = 0;
  std::size_t plenums = 0;
  std::optional<HollowBodyCounts> body;  ///< of a hollow body, nothing for other meshes
  double scaled_jacobian_min = 0.0;      ///< see scaled_jacobian
  double scaled_jacobian_mean = 0.0;
  double aspect_ratio_max = 0.0;  ///< longest over shortest edge of an element
  double shortest_edge_m = 0.0;
  double longest_edge_m = 0.0;
  std::vector<MeasuredVolume> volumes;  ///< the solid, then every chamber
};

/// Refuses a mesh with an element whose volume ratio is not positive everywhere it is looked at (see smallest_determinant).
/// @param source what messages begin with, such as the name of the file
/// @throws io::InputError naming the number of such elements, the first of them and its place
void require_no_inverted_elements(const HexahedralMesh& mesh, const std::string& source);

/// Measures a mesh that has elements, none of them inverted (asserts the former).
MeshQuality mesh_quality(const HexahedralMesh& mesh);

/// The same with the closed forms of a hollow body.
MeshQuality mesh_quality(const HollowBody& body);

/// Columns quantity, value, closed_form; one row per quantity, its unit in its name.
io::CsvTable quality_table(const MeshQuality& quality);

/// A few lines for people, in millimetres.
std::string quality_text(const MeshQuality& quality);

}  // namespace menger::meshes
