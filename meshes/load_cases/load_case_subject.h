#pragma once

#include <string>

#include "meshes/load_cases/load_case.h"

namespace menger::meshes {

/// Returns the subject of a load case as a line of text: its kind and the body, "inflation of 3x1x1:111, level 1". The name of
/// the case does not matter. Cases with equal subjects apply the same kind of load to the same body, possibly at other pressures
/// or imposed values.
///
/// Bodies count as the same if they differ only in
/// - the empty cells around them (at level 1 only; at higher levels these are gaps between modules),
/// - their materials, if all cells of a module form one chamber,
/// - which of the two phases is called 1,
/// - a rotation by quarter turns about axes that do not change the load: any axis for inflation; x for blocked, stretch, torsion
///   and modes; z for press.
///
/// A body that is rotated in another way, shifted within a module or mirrored counts as another body. The silicone, the cell edge
/// and the wall thickness are not part of the subject.
std::string subject_of(const LoadCase& load_case);

}  // namespace menger::meshes
