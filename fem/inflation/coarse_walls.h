#pragma once

#include <cstddef>
#include <string>

#include "fem/inflation/inflation_study.h"

namespace menger::fem {

/// Returns the number of cells of a body that lie in no plate. A plate is a square of two by two cells of one chamber that are
/// free on the same side: there the wall spans two cells at least. The walls of other cells span one.
/// @param chambers per_phase: cells of different material lie in different chambers
std::size_t cells_outside_plates(const meshes::Polycube& body, meshes::ChamberLayout chambers);

/// Returns a note on the expected error of a study with one three-field element through walls that span single cells, with the
/// keys that mend it. Empty where walls have more elements or are thin-wall elements, where they are thin or all cells lie in
/// plates, and for mesh files, whose walls are not known.
std::string note_on_coarse_walls(const InflationStudy& study);

}  // namespace menger::fem
