#include "fem/locomotion/walk_grid.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "fem/elements/element_state.h"
#include "io/vtk/grid_arrays.h"

namespace menger::fem {
namespace {

using FaceKey = std::array<std::size_t, 4>;

constexpr std::size_t no_chamber = std::numeric_limits<std::size_t>::max();

FaceKey sorted(FaceKey corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

vtkSmartPointer<vtkDoubleArray> vectors(const char* name, std::span<const double> components) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(components.size() / 3));
  std::copy(components.begin(), components.end(), array->GetPointer(0));
  return array;
}

/// Returns the chamber of each label; no_chamber for labels of the outside.
std::vector<std::size_t> chambers_of_labels(const meshes::HexahedralMesh& mesh) {
  std::vector<std::size_t> chambers(mesh.label_names.size(), no_chamber);
  for (std::size_t c = 0; c < mesh.chambers.size(); ++c)
    for (const std::size_t label : mesh.chambers[c].labels) chambers[label] = c;
  return chambers;
}

/// Returns which chamber most corners of an element are on; of equals the first, and no_chamber if none is on any.
std::size_t most_frequent(const meshes::ElementCorners& corners, const std::vector<std::size_t>& chambers_of_points) {
  std::map<std::size_t, int> counts;
  for (const std::size_t corner : corners)
    if (chambers_of_points[corner] != no_chamber) ++counts[chambers_of_points[corner]];
  if (counts.empty()) return no_chamber;
  return std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
}

void add_integers(vtkUnstructuredGrid& grid, const char* name, const std::vector<int>& values) {
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  grid.GetCellData()->AddArray(array);
}

}  // namespace

WalkGrid::WalkGrid(const meshes::HexahedralMesh& mesh, materials::HyperelasticLaw law) : mesh_(mesh), law_(std::move(law)) {
  find_walls();
  find_chambers_of_elements();
}

void WalkGrid::find_walls() {
  const std::vector<std::size_t> chambers = chambers_of_labels(mesh_);
  std::map<FaceKey, std::size_t> places;  // in walls_
  for (const meshes::BoundaryFace& face : mesh_.faces) {
    if (chambers[face.label] == no_chamber) continue;
    places[sorted(face.corners)] = walls_.size();
    walls_.push_back({face.corners, chambers[face.label], 0});
  }
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::size_t side : {0U, 1U}) {
        FaceKey corners{};
        for (std::size_t c = 0, n = 0; c < 8; ++c)
          if ((c >> axis & 1U) == side) corners.at(n++) = mesh_.elements[e].at(c);
        if (const auto found = places.find(sorted(corners)); found != places.end()) walls_[found->second].element = e;
      }
    }
  }
}

void WalkGrid::find_chambers_of_elements() {
  if (mesh_.chambers.empty()) return;
  std::vector<std::size_t> of_points(mesh_.points.size(), no_chamber);
  for (const Wall& wall : walls_)
    for (const std::size_t corner : wall.corners) of_points[corner] = wall.chamber;
  chambers_of_elements_.assign(mesh_.elements.size(), no_chamber);
  for (bool has_grown = true; has_grown;) {  // by one layer of elements at a time
    has_grown = false;
    std::vector<std::size_t> reached;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      if (chambers_of_elements_[e] != no_chamber) continue;
      chambers_of_elements_[e] = most_frequent(mesh_.elements[e], of_points);
      if (chambers_of_elements_[e] != no_chamber) reached.push_back(e);
    }
    for (const std::size_t e : reached) {
      has_grown = true;
      for (const std::size_t corner : mesh_.elements[e])
        if (of_points[corner] == no_chamber) of_points[corner] = chambers_of_elements_[e];
    }
  }
}

double WalkGrid::pressure_Pa(const MovedBody& body, std::size_t chamber) const {
  return body.plenum_pressures_Pa[mesh_.chambers[chamber].plenum];
}

void WalkGrid::add_points(vtkUnstructuredGrid& grid, const MovedBody& body) const {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t n = 0; n < mesh_.points.size(); ++n) {
    meshes::Point x = mesh_.points[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += body.displacements_m[3 * n + i];
    points->InsertNextPoint(x.data());
  }
  grid.SetPoints(points);
  grid.GetPointData()->AddArray(vectors("displacement_m", body.displacements_m));
  grid.GetPointData()->AddArray(vectors("velocity_m_per_s", body.velocities_m_per_s));
  grid.GetPointData()->SetActiveVectors("displacement_m");
}

void WalkGrid::add_cells(vtkUnstructuredGrid& grid) const {
  for (const meshes::ElementCorners& element : mesh_.elements) {
    std::array<vtkIdType, 8> corners{};
    for (std::size_t c = 0; c < corners.size(); ++c)  // VTK numbers corners in cyclic order
      corners.at(c) = static_cast<vtkIdType>(element.at(c % 4 < 2 ? c : c ^ 1U));
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  }
  for (const Wall& wall : walls_) {
    std::array<vtkIdType, 4> corners{};
    std::transform(wall.corners.begin(), wall.corners.end(), corners.begin(),
                   [](std::size_t corner) { return static_cast<vtkIdType>(corner); });
    grid.InsertNextCell(VTK_QUAD, 4, corners.data());
  }
}

void WalkGrid::add_cell_data(vtkUnstructuredGrid& grid, const MovedBody& body) const {
  constexpr int none = -1;
  std::vector<int> regions;
  std::vector<int> chambers(mesh_.elements.size(), none);
  std::vector<double> pressures_Pa;
  std::vector<ElementState> states;
  std::array<double, 24> positions{};
  std::array<double, 24> displacements{};
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    for (std::size_t n = 0; n < positions.size(); ++n) {
      const std::size_t corner = mesh_.elements[e].at(n / 3);
      positions.at(n) = mesh_.points[corner].at(n % 3);
      displacements.at(n) = body.displacements_m[3 * corner + n % 3];
    }
    regions.push_back(static_cast<int>(mesh_.regions[e]));
    const std::size_t chamber = chambers_of_elements_.empty() ? no_chamber : chambers_of_elements_[e];
    pressures_Pa.push_back(chamber == no_chamber ? 0.0 : pressure_Pa(body, chamber));
    states.push_back(element_state(law_, mean_deformation(1, positions, displacements)));
  }
  for (const Wall& wall : walls_) {
    regions.push_back(none);
    chambers.push_back(static_cast<int>(wall.chamber));
    pressures_Pa.push_back(pressure_Pa(body, wall.chamber));
    states.push_back(states[wall.element]);
  }
  add_integers(grid, "region", regions);
  add_integers(grid, "chamber", chambers);
  vtkCellData& data = *grid.GetCellData();
  io::add_floats(data, "chamber_pressure_Pa", pressures_Pa);
  const auto add = [&](const char* name, double ElementState::*value) {
    std::vector<double> values;
    values.reserve(states.size());
    for (const ElementState& state : states) values.push_back(state.*value);
    io::add_floats(data, name, values);
  };
  add("largest_stretch", &ElementState::largest_stretch);
  add("von_mises_stress_Pa", &ElementState::von_mises_stress_Pa);
  add("volume_ratio", &ElementState::volume_ratio);
  data.SetActiveScalars("largest_stretch");
}

vtkSmartPointer<vtkUnstructuredGrid> WalkGrid::at(const MovedBody& body) const {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  add_points(*grid, body);
  add_cells(*grid);
  add_cell_data(*grid, body);
  io::add_field_values(*grid, "TimeValue", std::array{body.time_s});
  io::add_field_values(*grid, "plenum_pressures_Pa", body.plenum_pressures_Pa);
  io::add_names(*grid, "region_names", mesh_.region_names);
  if (!mesh_.chambers.empty()) {
    std::vector<std::string> names;
    for (const meshes::Chamber& chamber : mesh_.chambers) names.push_back(chamber.name);
    io::add_names(*grid, "chamber_names", names);
    io::add_names(*grid, "plenum_names", mesh_.plenum_names);
  }
  return grid;
}

}  // namespace menger::fem
