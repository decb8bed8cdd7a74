#pragma once

#include <string>

#include "voxel/model/parameters.h"

namespace menger::voxel {

/// Why the scales of a physics cannot be computed with, or an empty text: a mass, stiffness or time step that leaves the range of
/// the number type, or more steps than can be counted. Every value may be within its own range and yet meet another badly (E =
/// 1e200 Pa squared overflows).
/// Of a calibrated body the stiffnesses are those of its beams in stretch, bending, shear and torsion and of the ground; masses
/// and with them the step are judged by a voxel with one wall. Nor may a beam or the middle of a wall of any class grow or shrink
/// by more than a hundred edges at the pressures of the drive, as far as its law has a value there.
/// @param cell_edge_m > 0 @param duration_s simulated time that is wanted, >= 0
std::string unusable_scales(const Physics& physics, double cell_edge_m, double duration_s);

}  // namespace menger::voxel
