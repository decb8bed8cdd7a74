#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// A named quadrilateral on the boundary, its corners in either sense around it.
struct NamedFace {
  std::array<std::size_t, 4> corners;
  std::size_t label;
};

/// A patch without elements that closes a chamber, by the edges around it, each in either sense.
struct NamedCap {
  std::string name;
  std::vector<std::array<std::size_t, 2>> rim;
};

/// Hexahedra as other programs write them: points may belong to no element, corners may be numbered for a left-handed element,
/// faces may look either way, and only some of the boundary need be named.
struct NamedHexahedra {
  std::vector<Point> points;
  std::vector<ElementCorners> elements;
  std::vector<std::size_t> regions;
  std::vector<std::string> region_names;
  std::vector<NamedFace> faces;
  std::vector<std::string> label_names;
  std::vector<NamedCap> caps;
};

/// A mesh from such hexahedra.
///
/// Elements are renumbered so that neighbours agree on their sense and the volume of the whole is positive; that repairs
/// numbering and does not hide elements that are really inverted. Boundary faces without a name become "outer". Every label that
/// begins with "chamber" is a chamber with a plenum of its own, and has to be closed. A cap closes the chamber whose surface ends
/// at all edges of its rim.
/// @param source what messages begin with, such as the name of the file
/// @throws io::InputError if there are no elements, they do not hang together through faces, more than two share a face, a named
/// face does not bound the solid or is named twice, an element is inverted, a cap closes no chamber, or a chamber is open or
/// encloses solid
HexahedralMesh assemble_mesh(NamedHexahedra input, const std::string& source);

}  // namespace menger::meshes
