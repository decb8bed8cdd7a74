#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// A point in the plane of a cap from which its rim can be spanned by triangles: the middle of the rim, moved into those
/// coordinate planes in which an open rim ends, so that the part of a cap that symmetry left over is spanned as well.
Point cap_apex(const HexahedralMesh& mesh, const Cap& cap);

/// Volume of the air in a chamber, from its surface: -1/3 of the integral of x . n over its faces (n points out of the solid)
/// plus 1/3 of that over its caps. Planes of symmetry through the origin add nothing. Negative if the faces enclose solid.
double enclosed_volume(const HexahedralMesh& mesh, const Chamber& chamber);

/// The edges at which the surface of a chamber ends, caps included, in the direction in which the rim of a cap that closes it
/// runs.
std::vector<std::array<std::size_t, 2>> open_edges(const HexahedralMesh& mesh, const Chamber& chamber);

/// Makes sure that every chamber is an air space: its faces and caps leave no gap but along faces in a coordinate plane whose
/// label begins with "symmetry", its volume is positive, and no label bounds two chambers.
/// @param source what messages begin with, such as the name of the file
/// @throws io::InputError naming the chamber and where it is open
void require_closed_chambers(const HexahedralMesh& mesh, const std::string& source);

}  // namespace menger::meshes
