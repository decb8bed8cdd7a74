#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace menger::meshes {

using Point = std::array<double, 3>;

/// The eight corners of an element. Corner c is at (c & 1, c >> 1 & 1, c >> 2 & 1) of the reference cube, x fastest.
using ElementCorners = std::array<std::size_t, 8>;

/// The shape of elements between their corners, for elements of higher degree and for refinement.
enum class Geometry {
  straight,    ///< trilinear elements
  spherical,   ///< concentric spheres about the origin
  cylindrical  ///< coaxial cylinders about the z axis
};

/// A quadrilateral of the boundary. The order of its corners is such that (corner 1 - corner 0) x (corner 3 - corner 0) points
/// out of the solid.
struct BoundaryFace {
  std::array<std::size_t, 4> corners;
  std::size_t label;  ///< index into label_names
};

/// A plane patch without elements that closes a chamber, such as the mouth of a tube hole. Pressure acts on it and is carried to
/// its rim, and it bounds the volume of the chamber.
struct Cap {
  /// The edges of the rim, from corner to corner. With c inside the rim, (first - c) x (second - c) points out of the air of the
  /// chamber.
  std::vector<std::array<std::size_t, 2>> rim;
};

/// A closed hollow in the silicone, filled with air.
struct Chamber {
  std::string name;                 ///< "chamber 0", ...
  std::vector<std::size_t> labels;  ///< boundary labels that bound it, together with the caps and planes of symmetry
  std::vector<Cap> caps;
  std::size_t plenum = 0;  ///< index into plenum_names; chambers of one plenum share their air
};

/// A mesh of labelled hexahedra of a body with chambers, in metres. The solid is connected and its elements conform.
struct HexahedralMesh {
  std::vector<Point> points;
  std::vector<ElementCorners> elements;
  std::vector<std::size_t> regions;       ///< per element, index into region_names
  std::vector<BoundaryFace> faces;        ///< every boundary face of the solid, each with one label
  std::vector<std::string> region_names;  ///< "wall", "lid", ...
  std::vector<std::string> label_names;   ///< "outer", "ground", "chamber 0", "tube", "symmetry x", ...
  std::vector<std::string> plenum_names;  ///< one per plenum
  std::vector<Chamber> chambers;
  Geometry geometry = Geometry::straight;
};

}  // namespace menger::meshes
