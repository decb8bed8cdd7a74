#pragma once

#include <array>
#include <cstddef>

#include "fem/thin_walls/wall_volume.h"

namespace menger::fem {

/// Returns how far a wall stands out along its normal from the bilinear surface through its corners, m, in the mean over its
/// area: a share for each of the two axes that follow the normal in a circle. Both are parts of wall_bulge: those of its bending.
std::array<double, 2> wall_bending_rises_m(const std::array<double, 3>& edges_m, std::size_t normal,
                                           const BoxNumbers& displacements_m);

/// Returns the same for what a pressure does inside of an element, for each pascal by which it is larger behind the wall than in
/// front, m/Pa: l_i^2 / (12 k mu t) with k = 5/6, the shear of a strip that carries all of the load along one axis.
///
/// A plate carries half of it along each axis, and a point of a wall moves by half of these. Volumes take both in full: the
/// second half stands for what a plate that shears does not show, the steep rise of walls beside the inner edges of a chamber.
/// That is measured, with chambers of cubes whose walls are a tenth to three tenths of their edge.
std::array<double, 2> wall_shear_rises(const std::array<double, 3>& edges_m, std::size_t normal, double shear_modulus_Pa);

/// Returns the displacement of a point of a wall from where its corners' trilinear function has it, a parabola along each axis
/// with the given mean rises. @param place in the element, 0 to 1 along x, y and z
GradientColumn wall_rise_m(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m,
                           const std::array<double, 3>& place, const std::array<double, 2>& rises_m);

}  // namespace menger::fem
