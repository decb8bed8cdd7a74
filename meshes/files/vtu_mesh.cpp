#include "meshes/files/vtu_mesh.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <string>
#include <vector>

#include "io/vtk/grid_arrays.h"
#include "io/vtk/vtk_file.h"
#include "meshes/hexahedra/circular_corners.h"

namespace menger::meshes {
namespace {

/// Adds rows of `width` integers. An array without rows is left out, because not every reader accepts one.
void add_rows(vtkUnstructuredGrid& grid, const char* name, int width, const std::vector<std::size_t>& values) {
  if (values.empty()) return;
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(width);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / width);
  for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), static_cast<vtkIdType>(values[i]));
  grid.GetFieldData()->AddArray(array);
}

void add_cell_data(vtkUnstructuredGrid& grid, const char* name, const std::vector<int>& values) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), values[i]);
  grid.GetCellData()->AddArray(array);
}

void add_points(vtkUnstructuredGrid& grid, const HexahedralMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  grid.SetPoints(points);
}

void add_cells(vtkUnstructuredGrid& grid, const HexahedralMesh& mesh) {
  const std::size_t count = mesh.elements.size() + mesh.faces.size();
  grid.AllocateEstimate(static_cast<vtkIdType>(count), 8);
  for (const ElementCorners& element : mesh.elements) {
    std::array<vtkIdType, 8> corners{};
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = static_cast<vtkIdType>(element[corner_of_circular[c]]);
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  }
  for (const BoundaryFace& face : mesh.faces) {
    std::array<vtkIdType, 4> corners{};
    for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = static_cast<vtkIdType>(face.corners[c]);
    grid.InsertNextCell(VTK_QUAD, 4, corners.data());
  }
}

void add_cell_data(vtkUnstructuredGrid& grid, const HexahedralMesh& mesh) {
  constexpr int none = -1;
  std::vector<int> chamber_of_label(mesh.label_names.size(), none);
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    for (const std::size_t label : mesh.chambers[chamber].labels) chamber_of_label[label] = static_cast<int>(chamber);
  }
  std::vector<int> region;
  std::vector<int> label(mesh.elements.size(), none);
  std::vector<int> chamber(mesh.elements.size(), none);
  for (const std::size_t each : mesh.regions) region.push_back(static_cast<int>(each));
  for (const BoundaryFace& face : mesh.faces) {
    region.push_back(none);
    label.push_back(static_cast<int>(face.label));
    chamber.push_back(chamber_of_label[face.label]);
  }
  add_cell_data(grid, "region", region);
  add_cell_data(grid, "label", label);
  add_cell_data(grid, "chamber", chamber);
}

void add_field_data(vtkUnstructuredGrid& grid, const HexahedralMesh& mesh) {
  std::vector<std::string> chamber_names;
  std::vector<std::size_t> chamber_plenums;
  std::vector<std::size_t> chamber_labels;
  std::vector<std::size_t> cap_rims;
  for (std::size_t chamber = 0; chamber < mesh.chambers.size(); ++chamber) {
    const Chamber& each = mesh.chambers[chamber];
    chamber_names.push_back(each.name);
    chamber_plenums.push_back(each.plenum);
    for (const std::size_t label : each.labels) chamber_labels.insert(chamber_labels.end(), {chamber, label});
    for (std::size_t cap = 0; cap < each.caps.size(); ++cap) {
      for (const auto& [from, to] : each.caps[cap].rim) cap_rims.insert(cap_rims.end(), {chamber, cap, from, to});
    }
  }
  io::add_names(grid, "region_names", mesh.region_names);
  io::add_names(grid, "label_names", mesh.label_names);
  if (!mesh.chambers.empty()) {
    io::add_names(grid, "chamber_names", chamber_names);
    io::add_names(grid, "plenum_names", mesh.plenum_names);
  }
  add_rows(grid, "chamber_plenums", 1, chamber_plenums);
  add_rows(grid, "chamber_labels", 2, chamber_labels);
  add_rows(grid, "cap_rims", 4, cap_rims);
  add_rows(grid, "geometry", 1, {static_cast<std::size_t>(mesh.geometry)});
}

}  // namespace

void write_vtu_mesh(const std::filesystem::path& file, const HexahedralMesh& mesh) {
  vtkNew<vtkUnstructuredGrid> grid;
  add_points(*grid, mesh);
  add_cells(*grid, mesh);
  add_cell_data(*grid, mesh);
  add_field_data(*grid, mesh);
  io::write_vtu(file, *grid, io::IndexWidth::bits_64);
}

}  // namespace menger::meshes
