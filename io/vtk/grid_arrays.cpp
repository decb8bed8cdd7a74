#include "io/vtk/grid_arrays.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>

namespace menger::io {

void add_floats(vtkDataSetAttributes& data, const char* name, std::span<const double> values, int components) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::transform(values.begin(), values.end(), array->GetPointer(0), [](double value) { return static_cast<float>(value); });
  data.AddArray(array);
}

void add_field_values(vtkUnstructuredGrid& grid, const char* name, std::span<const double> values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  grid.GetFieldData()->AddArray(array);
}

void add_names(vtkUnstructuredGrid& grid, const char* name, const std::vector<std::string>& names) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& each : names) array->InsertNextValue(each);
  grid.GetFieldData()->AddArray(array);
}

}  // namespace menger::io
