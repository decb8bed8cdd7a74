#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// A named quadrilateral on the boundary, with its corners in either direction around it.
struct NamedFace {
  std::array<std::size_t, 4> corners;
  std::size_t label;
};

/// A patch without elements that closes a chamber, given by the edges around it, each in either direction.
struct NamedCap {
  std::string name;
  std::vector<std::array<std::size_t, 2>> rim;
};

/// Hexahedra as other programs write them. Points may belong to no element, corners may be numbered for a left-handed element,
/// faces may point either way, and only part of the boundary may be named.
struct NamedHexahedra {
  std::vector<Point> points;
  std::vector<ElementCorners> elements;
  std::vector<std::size_t> regions;
  std::vector<std::string> region_names;
  std::vector<NamedFace> faces;
  std::vector<std::string> label_names;
  std::vector<NamedCap> caps;
};

/// Makes a mesh from such hexahedra.
///
/// Elements are renumbered so that neighbours have the same handedness and the total volume is positive. This repairs the
/// numbering and does not hide elements that are really inverted. Boundary faces without a name become "outer". Every label that
/// begins with "chamber" is a chamber with a plenum of its own, and must be closed. A cap closes the chamber whose surface ends
/// at all edges of its rim.
/// @param source text at the start of messages, such as the name of the file
/// @throws io::InputError if there are no elements, they are not all connected through faces, more than two share a face, a named
/// face is not on the boundary of the solid or has two names, an element is inverted, a cap closes no chamber, a chamber is open
/// or encloses solid, or two faces of the boundary lie in the same place and not both have a name: a crack
HexahedralMesh assemble_mesh(NamedHexahedra input, const std::string& source);

}  // namespace menger::meshes
