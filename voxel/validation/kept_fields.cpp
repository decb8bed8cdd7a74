#include "voxel/validation/kept_fields.h"

#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "voxel/picture/vtk_output.h"

namespace menger::voxel {

namespace {

namespace fs = std::filesystem;
using State = std::vector<double>;

/// Reads a file of fields with displacements.
vtkSmartPointer<vtkUnstructuredGrid> read_fields(const fs::path& file) {
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  if (io::is_file(file)) {
    vtkNew<vtkXMLGenericDataObjectReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutput());
  }
  if (grid == nullptr || grid->GetPointData()->GetArray("displacement_m") == nullptr)
    throw io::InputError(file.string() + ": is not a file of fields with displacement_m");
  return grid;
}

/// Whether a file is of an earlier version, whose points were those of the body at rest: its volume ratios are of points.
bool has_points_at_rest(vtkUnstructuredGrid& grid) { return grid.GetPointData()->GetArray("volume_ratio") != nullptr; }

void move_to_deformed(vtkUnstructuredGrid& grid) {
  vtkDataArray* displacement = grid.GetPointData()->GetArray("displacement_m");
  vtkPoints* points = grid.GetPoints();
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n) {
    std::array<double, 3> place{};
    points->GetPoint(n, place.data());
    for (int axis = 0; axis < 3; ++axis) place.at(static_cast<std::size_t>(axis)) += displacement->GetComponent(n, axis);
    points->SetPoint(n, place.data());
  }
}

/// For each row, the step with the nearest pressure, if it is near.
FieldsByRow nearest_in_pressure(const std::vector<fs::path>& files, const std::vector<State>& states) {
  constexpr double near_enough = 0.02;  // of the largest pressure; a smaller difference is not visible in a picture
  double largest_Pa = 0.0;
  for (const State& state : states) largest_Pa = std::max(largest_Pa, std::abs(state.front()));
  FieldsByRow by_row;
  std::vector<double> distance_Pa(states.size(), near_enough * largest_Pa);
  for (const fs::path& file : files) {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = read_fields(file);
    vtkDataArray* pressures = grid->GetFieldData()->GetArray("plenum_pressures_Pa");
    if (pressures == nullptr || pressures->GetNumberOfTuples() == 0) continue;
    for (std::size_t row = 0; row < states.size(); ++row) {
      const double distance = std::abs(pressures->GetComponent(0, 0) - states[row].front());
      if (distance > distance_Pa[row]) continue;
      distance_Pa[row] = distance;
      by_row[row] = file;
    }
  }
  return by_row;
}

}  // namespace

std::optional<fs::path> field_collection(const fs::path& curve_file, const std::string& case_name) {
  fs::path collection = curve_file.parent_path() / "fields" / case_name / "fields.pvd";
  return io::is_file(collection) ? std::optional(collection) : std::nullopt;
}

FieldsByRow fields_by_row(const fs::path& collection, const std::vector<State>& states) {
  std::vector<fs::path> files;
  for (const CollectionEntry& entry : read_collection(collection)) files.push_back(collection.parent_path() / entry.file);
  if (files.size() != states.size() && states.front().size() == 1) return nearest_in_pressure(files, states);
  FieldsByRow by_row;
  for (std::size_t row = 0; row < std::min(files.size(), states.size()); ++row) by_row[row] = files[row];
  return by_row;
}

vtkSmartPointer<vtkPolyData> deformed_surface(const fs::path& file) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_fields(file);
  if (has_points_at_rest(*grid)) move_to_deformed(*grid);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(grid);
  surface->Update();
  return surface->GetOutput();
}

}  // namespace menger::voxel
