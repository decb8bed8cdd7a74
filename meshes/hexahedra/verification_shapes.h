#pragma once

#include <array>
#include <cstddef>

#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::meshes {

/// Bodies whose solution is known, or for which others have published computed results. All have the region "wall". Lengths are
/// in metres and > 0, numbers of elements at least 1 (asserted).

/// Returns a box from the origin to `size` in nx * ny * nz equal elements. Its six sides have the labels "x min", ..., "z max".
HexahedralMesh box(const Point& size, const std::array<std::size_t, 3>& elements);

/// Returns Cook's membrane: the plane trapezium with the corners (0, 0), (48, 44), (48, 60) and (0, 44) units, one or more
/// elements thick. Labels are those of a box: "x min" is the clamped end, "x max" the loaded end, "z min" and "z max" are the two
/// faces.
/// @param elements numbers along x, along y, through the thickness
HexahedralMesh cooks_membrane(double unit_m, double thickness_m, const std::array<std::size_t, 3>& elements);

/// Returns one octant (x, y, z >= 0) of a thick sphere about the origin, in three blocks that meet along its diagonal.
///
/// Labels: "symmetry x" (the plane x = 0), "symmetry y", "symmetry z", "chamber 0" (inside), "outer". There is one chamber.
/// @param radial elements through the wall, equal in radius
/// @param tangential elements along each side of a block; a quarter of a circle has twice as many
HexahedralMesh thick_sphere_octant(double inner_radius_m, double outer_radius_m, std::size_t radial, std::size_t tangential);

/// Returns one quarter (x, y >= 0) of a thick cylinder about the z axis, from z = 0 to `length_m`.
///
/// Labels: "symmetry x", "symmetry y", "symmetry z" (the plane z = 0), "end" (at z = length), "chamber 0" (inside), "outer".
/// There is one chamber, closed at the end by a cap whose rim is a quarter of a circle.
/// @param elements numbers along the radius, along the quarter of the circle, along z
HexahedralMesh thick_cylinder_quarter(double inner_radius_m, double outer_radius_m, double length_m,
                                      const std::array<std::size_t, 3>& elements);

/// Returns one quarter (x, y >= 0) of the hollow cube. Its axis is the z axis and it stands on z = 0. Elements are cubes of edge
/// wall / n, or slightly smaller if that does not divide the chamber.
///
/// Labels: "symmetry x", "symmetry y", "ground", "outer", "chamber 0". There is one chamber.
/// @param wall_m smaller than half the edge (asserted)
HexahedralMesh hollow_cube_quarter(double edge_m, double wall_m, std::size_t elements_through_wall);

}  // namespace menger::meshes
