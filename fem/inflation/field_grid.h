#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <span>
#include <string>
#include <vector>

#include "fem/inflation/field_output.h"

namespace menger::fem {

/// Returns the elements of this rank as a grid with the fields of a state, as FieldSeries writes them.
vtkSmartPointer<vtkUnstructuredGrid> field_grid(const Space& space, std::span<const double> displacements,
                                                const NodalFields& fields, const FieldStep& step);

/// Returns the text of a .pvtu file that joins pieces with the arrays of a grid.
/// @param pieces names of the files beside it
std::string parallel_grid_text(vtkUnstructuredGrid& grid, const std::vector<std::string>& pieces);

}  // namespace menger::fem
