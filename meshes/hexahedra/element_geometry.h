#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "meshes/design/side.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// The positions of the corners of an element, in the order of ElementCorners.
using CornerPoints = std::array<Point, 8>;

/// The corners of the six faces of an element, in the order of Side, with the orientation that BoundaryFace requires.
inline constexpr std::array<std::array<std::size_t, 4>, 6> face_corners{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// The corners of a face, as indices of points.
using FaceCorners = std::array<std::size_t, 4>;

/// Returns the corners of a face of an element. @param side index into face_corners, < 6
FaceCorners face_of_element(const ElementCorners& element, std::size_t side);

/// Returns the corners in increasing order, by which the faces of two elements are found to be the same.
FaceCorners sorted(FaceCorners corners);

/// The corners at the ends of the twelve edges of an element: those along x, then y, then z.
inline constexpr std::array<std::array<std::size_t, 2>, 12> edge_corners{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

inline Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a);

/// Returns the largest distance at which two points count as one place, and a point as one of a coordinate plane: 1e-6 of the
/// diagonal of the box around all points. It is far above the rounding of files with single precision and far below any element.
/// @param points at least one
double coincidence_tolerance_m(std::span<const Point> points);

/// Returns whether all coordinates are finite.
bool is_finite(const Point& place);

/// Returns a position for messages: "(1, 2.5, 0) mm".
std::string millimetre_text(const Point& place);

CornerPoints corner_points(const HexahedralMesh& mesh, std::size_t element);

/// Returns the lengths of the edges along x, y and z of an element that is a box along the axes; empty if it is none.
std::optional<Point> box_edges(const CornerPoints& corners);

/// Returns the columns dx/dxi_i of the trilinear map at a point xi of the reference cube [0, 1]^3.
std::array<Point, 3> jacobian(const CornerPoints& corners, const Point& xi);

/// Returns det dx/dxi.
double jacobian_determinant(const CornerPoints& corners, const Point& xi);

/// Returns the smallest determinant at the eight corners and the eight Gauss points. A value <= 0 shows that the element is
/// inverted. A positive value does not exclude a fold between these points, but such a fold needs corners that are nearly flat.
/// Returns NaN if a determinant is NaN.
double smallest_determinant(const CornerPoints& corners);

/// Returns the volume of a trilinear element. It is exact: eight Gauss points integrate the determinant exactly.
double element_volume(const CornerPoints& corners);

/// Returns the scaled Jacobian: the smallest triple product of the unit edges at the corners and of the unit axes in the centre.
/// It is 1 for a cuboid, <= 0 for an inverted element, and -1 if an edge has no length.
double scaled_jacobian(const CornerPoints& corners);

/// Returns the lengths of the shortest and the longest of the twelve edges.
std::pair<double, double> edge_range(const CornerPoints& corners);

/// Returns the integral of x . n over a bilinear quadrilateral whose corners run around n. It is exact. A third of the sum over a
/// closed surface is the volume inside.
double flux_of_position(const std::array<Point, 4>& corners);

}  // namespace menger::meshes
