#pragma once

#include "meshes/load_cases/response_curve.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Parameters to begin a fit with, from closed forms of a square tube of the cell's edge a and wall thickness t, with Young's
/// modulus E = 3 mu of an incompressible solid and b = a - 2 t:
/// - axial, bending and torsional modulus E (1 - (b / a)^2);
/// - extension under the pressure on the ends, b^2 / (E (a^2 - b^2));
/// - bulge of a clamped square plate of edge b, in the mean 0.0004 p b^4 / D with D = E t^3 / 9;
/// - ground stiffness of half a voxel in compression.
/// These are of the closed cell; other wall classes have stiffness and extension by their share of wall, and the bulge of the
/// span that they are part of. No softening, no lateral coupling, no effect of joints.
/// @param provenance of any curve of the fit
SurrogateParameters rough_parameters(const meshes::CurveProvenance& provenance, int voxels_per_cell);

}  // namespace menger::voxel
