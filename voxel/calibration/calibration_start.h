#pragma once

#include "meshes/load_cases/response_curve.h"
#include "voxel/model/surrogate_parameters.h"

namespace menger::voxel {

/// Parameters at which a fit begins, from closed forms for a square tube with the cell's edge a and wall thickness t. Young's
/// modulus is E = 3 mu of an incompressible solid, and b = a - 2 t:
/// - axial, bending and torsional modulus E (1 - (b / a)^2);
/// - extension under the pressure on the ends, b^2 / (E (a^2 - b^2));
/// - mean bulge of a clamped square plate of edge b, 0.0004 p b^4 / D with D = E t^3 / 9;
/// - ground stiffness of half a voxel in compression.
///
/// These hold for the closed cell. Other wall classes have stiffness and extension according to their share of wall, and the
/// bulge of the span that they are part of. There is no softening, no lateral coupling and no effect of joints.
/// @param provenance of any curve of the fit
SurrogateParameters rough_parameters(const meshes::CurveProvenance& provenance, int voxels_per_cell);

}  // namespace menger::voxel
