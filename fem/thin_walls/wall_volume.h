#pragma once

#include <array>
#include <vector>

#include "fem/thin_walls/thin_wall_stiffness.h"

namespace menger::fem {

/// A column of a deformation gradient.
using GradientColumn = std::array<double, 3>;

/// Returns the columns of the deformation gradient at the centre of a box. @param edges_m along x, y and z
std::array<GradientColumn, 3> centre_gradient(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m);

/// Returns the change of volume of a wall as its penalty sees it, V (J - 1) with J at the centre, m^3.
///
/// The pressures p_a and p_b on its faces press a wall together. The energy -(p_a + p_b)/2 V (J - 1) cancels this (see
/// ThinWallKernels), as if half of this volume belonged to each of the chambers.
double wall_volume_change(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m);

/// Returns its gradient by the displacements, m^2.
BoxNumbers wall_volume_gradient(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m);

/// Returns its Hessian, m: 24 x 24 numbers, row by row. It is symmetric and not definite.
std::vector<double> wall_volume_hessian(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m);

/// Returns the volume between a wall and the bilinear surface through its corners, m^3, positive along the normal.
///
/// A wall with the curvatures c_i of its bending bulges by c_i l_i^2 / 12 in the mean over its area. With the stretches f_i of
/// its middle, their changes q_i from there to a face (see ThinWallKernels), the thickness t / d^(1/2) and the area d^(1/2) l1
/// l2, where d = |f1 x f2|^2, that is d l1 l2 sum l_i^2 f_i.q_i / (6 t).
double wall_bulge(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m);

/// Returns its gradient by the displacements, m^2.
BoxNumbers wall_bulge_gradient(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m);

/// Returns the further bulge of a wall for each pascal by which the pressure behind it exceeds that in front, m^3/Pa: its area at
/// rest times the sum of both wall_shear_rises.
double wall_shear_bulge(const std::array<double, 3>& edges_m, std::size_t normal, double shear_modulus_Pa);

}  // namespace menger::fem
