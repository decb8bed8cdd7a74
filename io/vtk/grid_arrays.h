#pragma once

#include <vtkDataSetAttributes.h>
#include <vtkUnstructuredGrid.h>

#include <span>
#include <string>
#include <vector>

namespace menger::io {

/// Adds an array in single precision, for values that are shown and not computed with. @param values components of the tuples
void add_floats(vtkDataSetAttributes& data, const char* name, std::span<const double> values, int components = 1);

/// Adds numbers that belong to the whole grid to its field data. The one named TimeValue is the time that ParaView shows.
void add_field_values(vtkUnstructuredGrid& grid, const char* name, std::span<const double> values);

/// Adds names to the field data of a grid.
void add_names(vtkUnstructuredGrid& grid, const char* name, const std::vector<std::string>& names);

}  // namespace menger::io
