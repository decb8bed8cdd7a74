#include "fem/inflation/field_grid.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkHexahedron.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTriQuadraticHexahedron.h>

#include <array>
#include <cmath>

#include "io/vtk/grid_arrays.h"

namespace menger::fem {
namespace {

vtkSmartPointer<vtkDoubleArray> real_array(const char* name, int components, std::size_t tuples) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

/// Returns the lexicographic index of every node of a VTK cell, from the reference coordinates that VTK states.
std::vector<std::size_t> lexicographic_places(vtkCell& cell, int degree) {
  std::vector<std::size_t> places;
  const double* coordinates = cell.GetParametricCoords();
  for (vtkIdType n = 0; n < cell.GetNumberOfPoints(); ++n) {
    std::size_t place = 0;
    for (vtkIdType axis = 2; axis >= 0; --axis)
      place = place * static_cast<std::size_t>(degree + 1) +
              static_cast<std::size_t>(std::lround(degree * coordinates[3 * n + axis]));
    places.push_back(place);
  }
  return places;
}

void add_cells(vtkUnstructuredGrid& grid, const Space& space, std::span<const double> displacements) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(space.positions.size()));
  for (std::size_t n = 0; n < space.positions.size(); ++n) {
    Point x = space.positions[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += displacements[3 * n + i];
    points->SetPoint(static_cast<vtkIdType>(n), x.data());
  }
  grid.SetPoints(points);

  vtkNew<vtkHexahedron> linear;
  vtkNew<vtkTriQuadraticHexahedron> quadratic;
  vtkCell& cell = space.degree == 1 ? static_cast<vtkCell&>(*linear) : *quadratic;
  const std::vector<std::size_t> places = lexicographic_places(cell, space.degree);
  const std::size_t count = space.nodes_per_element();
  grid.AllocateExact(static_cast<vtkIdType>(space.local_element_count()), static_cast<vtkIdType>(space.element_nodes.size()));
  std::vector<vtkIdType> nodes(count);
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    for (std::size_t n = 0; n < count; ++n) nodes[n] = space.element_nodes[e * count + places[n]];
    grid.InsertNextCell(cell.GetCellType(), static_cast<vtkIdType>(count), nodes.data());
  }
}

void add_point_data(vtkUnstructuredGrid& grid, const Space& space, std::span<const double> displacements,
                    const NodalFields& fields) {
  const std::size_t count = space.positions.size();
  const auto displacement = real_array("displacement_m", 3, count);
  const auto stress = real_array("cauchy_stress_Pa", 6, count);
  const auto pressure = real_array("pressure_Pa", 1, count);
  const auto stretches = real_array("principal_stretches", 3, count);
  for (int c = 0; const char* name : {"xx", "yy", "zz", "xy", "yz", "xz"}) stress->SetComponentName(c++, name);
  for (std::size_t n = 0; n < count; ++n) {
    const auto tuple = static_cast<vtkIdType>(n);
    displacement->SetTuple(tuple, &displacements[3 * n]);
    stress->SetTuple(tuple, fields.cauchy_stress[n].data());
    pressure->SetValue(tuple, hydrostatic_pressure(fields.cauchy_stress[n]));
    stretches->SetTuple(tuple, principal_stretches(fields.deformation_gradient[n]).data());
  }
  for (const auto& array : {displacement, stress, pressure, stretches}) grid.GetPointData()->AddArray(array);
  grid.GetPointData()->SetActiveVectors("displacement_m");
}

void add_cell_data(vtkUnstructuredGrid& grid, const Space& space, const std::vector<ElementState>& elements) {
  int this_rank = 0;
  MPI_Comm_rank(space.communicator, &this_rank);
  vtkNew<vtkIntArray> region;
  region->SetName("region");
  vtkNew<vtkIntArray> rank;
  rank->SetName("rank");
  for (const std::size_t r : space.element_regions) {
    region->InsertNextValue(static_cast<int>(r));
    rank->InsertNextValue(this_rank);
  }
  grid.GetCellData()->AddArray(region);
  grid.GetCellData()->AddArray(rank);
  const auto add = [&](const char* name, double ElementState::*value) {
    std::vector<double> values;
    values.reserve(elements.size());
    for (const ElementState& element : elements) values.push_back(element.*value);
    io::add_floats(*grid.GetCellData(), name, values);
  };
  add("largest_stretch", &ElementState::largest_stretch);
  add("von_mises_stress_Pa", &ElementState::von_mises_stress_Pa);
  add("volume_ratio", &ElementState::volume_ratio);
  grid.GetCellData()->SetActiveScalars("largest_stretch");
}

const char* type_name(int data_type) {
  switch (data_type) {
    case VTK_DOUBLE:
      return "Float64";
    case VTK_FLOAT:
      return "Float32";
    default:
      return "Int32";
  }
}

void add_array_texts(std::string& text, const char* element, vtkDataSetAttributes& data) {
  text += std::string("    <") + element;
  if (vtkDataArray* scalars = data.GetScalars()) text += std::string(" Scalars=\"") + scalars->GetName() + "\"";
  if (vtkDataArray* vectors = data.GetVectors()) text += std::string(" Vectors=\"") + vectors->GetName() + "\"";
  text += ">\n";
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray& array = *data.GetArray(a);
    text += std::string("      <PDataArray type=\"") + type_name(array.GetDataType()) + "\" Name=\"" + array.GetName() +
            "\" NumberOfComponents=\"" + std::to_string(array.GetNumberOfComponents()) + "\"/>\n";
  }
  text += std::string("    </") + element + ">\n";
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> field_grid(const Space& space, std::span<const double> displacements,
                                                const NodalFields& fields, const FieldStep& step) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  add_cells(*grid, space, displacements);
  add_point_data(*grid, space, displacements, fields);
  add_cell_data(*grid, space, fields.elements);
  io::add_field_values(*grid, "TimeValue", std::array{step.s});
  io::add_field_values(*grid, "plenum_pressures_Pa", step.plenum_pressures_Pa);
  if (!step.names.plena.empty()) io::add_names(*grid, "plenum_names", step.names.plena);
  if (!step.names.regions.empty()) io::add_names(*grid, "region_names", step.names.regions);
  return grid;
}

std::string parallel_grid_text(vtkUnstructuredGrid& grid, const std::vector<std::string>& pieces) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\">\n";
  text += "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  add_array_texts(text, "PPointData", *grid.GetPointData());
  add_array_texts(text, "PCellData", *grid.GetCellData());
  text += "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    </PPoints>\n";
  for (const std::string& piece : pieces) text += "    <Piece Source=\"" + piece + "\"/>\n";
  return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace menger::fem
