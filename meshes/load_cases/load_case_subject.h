#pragma once

#include <string>

#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// What a load case is about as a line of text, whatever it is called: its kind and the body, "inflation of 3x1x1:111, level 1".
/// Cases of equal subject ask the same question of the same body, if at other pressures or imposed values.
///
/// Equal are bodies that differ in the empty cells around them (at level 1; between modules they are gaps), in materials where
/// all cells of a module form one chamber, in which of two phases is called 1, and in turns about axes that the load does not
/// tell apart: any for inflation, x for blocked, stretch, torsion and modes, z for press. A body that is turned otherwise,
/// shifted within a module or mirrored counts as another. Neither the silicone nor the lengths of the cell are part of it.
std::string subject_of(const LoadCase& load_case);

}  // namespace menger::meshes
