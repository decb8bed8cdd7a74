#pragma once

#include <string>

#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Returns why a physics cannot be computed in its number type, or an empty text. Reasons are a mass, moment of inertia,
/// stiffness, time step or speed limit that leaves the range of the type, or more steps than can be counted. Values that are each
/// in their own range may still be unusable together (E = 1e200 Pa squared overflows).
///
/// For a calibrated body the stiffnesses are those of its beams in stretch, bending, shear and torsion, and of the ground. The
/// check is to the order of magnitude: a voxel with one wall, which is among the lightest, stands for all masses, and so decides
/// the step. Growth is checked at the pressures of the drive: for no wall class may a beam, or a wall in the mean or in its
/// middle, grow or shrink by more than a hundred voxel edges. Where the law of extension or of bulge has no value at a pressure,
/// it is not checked.
/// @param cell_edge_m > 0; a calibrated body has its own
/// @param duration_s simulated time that is wanted, >= 0
std::string unusable_scales(const Physics& physics, double cell_edge_m, double duration_s);

}  // namespace menger::voxel
