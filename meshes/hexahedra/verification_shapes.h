#pragma once

#include <array>
#include <cstddef>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Bodies whose solution is known, or which others have computed. All have the region "wall"; lengths are in metres and > 0,
/// numbers of elements at least 1 (asserts).

/// A box from the origin to `size` in nx * ny * nz equal elements; its six sides have the labels "x min", ..., "z max".
HexahedralMesh box(const Point& size, const std::array<std::size_t, 3>& elements);

/// Cook's membrane: the plane trapezium with the corners (0, 0), (48, 44), (48, 60) and (0, 44) units, one element thick or more.
/// Labels as for a box: "x min" is the clamped and "x max" the loaded end, "z min" and "z max" the two faces.
/// @param elements along x, along y, through the thickness
HexahedralMesh cooks_membrane(double unit_m, double thickness_m, const std::array<std::size_t, 3>& elements);

/// One octant (x, y, z >= 0) of a thick sphere about the origin, in three blocks that meet in its diagonal.
///
/// Labels "symmetry x" (the plane x = 0), "symmetry y", "symmetry z", "chamber 0" (inside), "outer"; one chamber.
/// @param radial elements through the wall, equal in radius @param tangential elements along each side of a block: a quarter of a
/// circle has twice as many
HexahedralMesh thick_sphere_octant(double inner_radius_m, double outer_radius_m, std::size_t radial, std::size_t tangential);

/// One quarter (x, y >= 0) of a thick cylinder about the z axis, from z = 0 to `length_m`.
///
/// Labels "symmetry x", "symmetry y", "symmetry z" (the plane z = 0), "end" (at z = length), "chamber 0" (inside), "outer"; one
/// chamber, closed at the end by a cap whose rim is a quarter of a circle.
/// @param elements radial, along the quarter of the circle, along z
HexahedralMesh thick_cylinder_quarter(double inner_radius_m, double outer_radius_m, double length_m,
                                      const std::array<std::size_t, 3>& elements);

/// One quarter (x, y >= 0) of the hollow cube, whose axis is the z axis and which stands on z = 0, in cubes of edge wall / n or,
/// where that does not divide the chamber, a little less.
///
/// Labels "symmetry x", "symmetry y", "ground", "outer", "chamber 0"; one chamber.
/// @param wall_m smaller than half the edge (asserts)
HexahedralMesh hollow_cube_quarter(double edge_m, double wall_m, std::size_t elements_through_wall);

}  // namespace menger::meshes
