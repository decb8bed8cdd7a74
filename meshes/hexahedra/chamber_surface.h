#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Returns a point in the plane of a cap. Triangles from this point to the edges of the rim cover the cap. It is the middle of
/// the rim. If the rim is open because it ends in coordinate planes (planes of symmetry), the point is moved into these planes,
/// so that the whole remaining part of the cap is covered.
Point cap_apex(const HexahedralMesh& mesh, const Cap& cap);

/// Returns the volume of the air in a chamber, computed from its surface: -1/3 of the integral of x . n over its faces (n points
/// out of the solid) plus 1/3 of that over its caps. Planes of symmetry through the origin contribute nothing. The volume is
/// negative if the faces enclose solid.
double enclosed_volume(const HexahedralMesh& mesh, const Chamber& chamber);

/// Returns the edges at which the surface of a chamber ends, including its caps. Each edge has the direction of the rim of a cap
/// that would close it.
std::vector<std::array<std::size_t, 2>> open_edges(const HexahedralMesh& mesh, const Chamber& chamber);

/// Checks that every chamber is a closed air space. Its faces and caps may leave gaps only along faces in a coordinate plane
/// whose label begins with "symmetry". Its volume must be positive, and no label may bound two chambers.
/// @param source text at the start of messages, such as the name of the file
/// @throws io::InputError naming the chamber and the place where it is open
void require_closed_chambers(const HexahedralMesh& mesh, const std::string& source);

}  // namespace menger::meshes
