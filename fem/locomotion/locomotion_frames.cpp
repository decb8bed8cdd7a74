#include "fem/locomotion/locomotion_frames.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "io/vtk/vtk_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

constexpr const char* collection_name = "frames.pvd";

/// Returns the path of a frame, relative to the folder of the run.
fs::path frame_file(std::size_t number) { return fs::path("frames") / ("frame_" + io::padded(number, 4) + ".vtu"); }

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

vtkSmartPointer<vtkDoubleArray> vectors(const char* name, std::span<const double> components) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(components.size() / 3));
  std::copy(components.begin(), components.end(), array->GetPointer(0));
  return array;
}

template <class Array>
vtkSmartPointer<Array> named(const char* name) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  return array;
}

/// Returns the chamber of each label; empty for labels of the outside.
std::vector<std::optional<std::size_t>> chambers_of_labels(const meshes::HexahedralMesh& mesh) {
  std::vector<std::optional<std::size_t>> chambers(mesh.label_names.size());
  for (std::size_t c = 0; c < mesh.chambers.size(); ++c)
    for (const std::size_t label : mesh.chambers[c].labels) chambers[label] = c;
  return chambers;
}

/// The data arrays of the cells.
struct CellArrays {
  vtkSmartPointer<vtkIntArray> region = named<vtkIntArray>("region");
  vtkSmartPointer<vtkIntArray> chamber = named<vtkIntArray>("chamber");
  vtkSmartPointer<vtkDoubleArray> pressure = named<vtkDoubleArray>("chamber_pressure_Pa");

  void add(int region_of_cell, int chamber_of_cell, double pressure_Pa) const {
    region->InsertNextValue(region_of_cell);
    chamber->InsertNextValue(chamber_of_cell);
    pressure->InsertNextValue(pressure_Pa);
  }
};

void add_elements(vtkUnstructuredGrid& grid, const meshes::HexahedralMesh& mesh, const CellArrays& arrays) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    std::array<vtkIdType, 8> corners{};
    for (std::size_t c = 0; c < corners.size(); ++c)  // VTK numbers corners in cyclic order
      corners.at(c) = static_cast<vtkIdType>(mesh.elements[e].at(c % 4 < 2 ? c : c ^ 1U));
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
    arrays.add(static_cast<int>(mesh.regions[e]), -1, 0.0);
  }
}

void add_walls(vtkUnstructuredGrid& grid, const meshes::HexahedralMesh& mesh, std::span<const double> plenum_pressures_Pa,
               const CellArrays& arrays) {
  const auto chambers = chambers_of_labels(mesh);
  for (const meshes::BoundaryFace& face : mesh.faces) {
    if (!chambers[face.label]) continue;
    std::array<vtkIdType, 4> corners{};
    std::transform(face.corners.begin(), face.corners.end(), corners.begin(),
                   [](std::size_t corner) { return static_cast<vtkIdType>(corner); });
    grid.InsertNextCell(VTK_QUAD, 4, corners.data());
    const std::size_t chamber = *chambers[face.label];
    arrays.add(-1, static_cast<int>(chamber), plenum_pressures_Pa[mesh.chambers[chamber].plenum]);
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> moved_body_grid(const meshes::HexahedralMesh& mesh, const MovedBody& body) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    meshes::Point x = mesh.points[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += body.displacements_m[3 * n + i];
    points->InsertNextPoint(x.data());
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(vectors("displacement_m", body.displacements_m));
  grid->GetPointData()->AddArray(vectors("velocity_m_per_s", body.velocities_m_per_s));
  const CellArrays arrays;
  add_elements(*grid, mesh, arrays);
  add_walls(*grid, mesh, body.plenum_pressures_Pa, arrays);
  grid->GetCellData()->AddArray(arrays.region);
  grid->GetCellData()->AddArray(arrays.chamber);
  grid->GetCellData()->AddArray(arrays.pressure);
  const auto time = named<vtkDoubleArray>("TimeValue");
  time->InsertNextValue(body.time_s);
  grid->GetFieldData()->AddArray(time);
  const auto pressures = named<vtkDoubleArray>("plenum_pressures_Pa");
  for (const double pressure : body.plenum_pressures_Pa) pressures->InsertNextValue(pressure);
  grid->GetFieldData()->AddArray(pressures);
  return grid;
}

void LocomotionFrames::keep_only(const std::vector<double>& times_s) {
  times_s_ = times_s;
  // Users may have removed some frames. Frames after the first missing one do not count.
  std::size_t kept = 0;
  while (kept < times_s_.size() && is_there(folder_ / frame_file(kept))) ++kept;
  times_s_.resize(kept);
  // The collection is updated before the files are removed, so that it never names one that does not exist.
  if (times_s_.empty())
    io::remove_if_there(folder_ / collection_name);
  else
    write_collection();
  std::vector<fs::path> surplus;
  std::error_code no_such_folder;
  for (const auto& entry : fs::directory_iterator(folder_ / "frames", no_such_folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_frame = name.starts_with("frame_") && name.ends_with(".vtu");
    bool stays = false;
    for (std::size_t n = 0; n < times_s_.size() && !stays; ++n) stays = name == frame_file(n).filename();
    if (is_frame && !stays) surplus.push_back(entry.path());
  }
  for (const fs::path& file : surplus) io::remove_if_there(file);
}

void LocomotionFrames::add(const meshes::HexahedralMesh& mesh, const MovedBody& body) {
  io::write_vtu(folder_ / frame_file(times_s_.size()), *moved_body_grid(mesh, body));
  times_s_.push_back(body.time_s);
  write_collection();
}

void LocomotionFrames::write_collection() const {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (std::size_t n = 0; n < times_s_.size(); ++n)
    text += "    <DataSet timestep=\"" + io::number_text(times_s_[n]) + "\" part=\"0\" file=\"" + frame_file(n).generic_string() +
            "\"/>\n";
  io::write_whole(folder_ / collection_name, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace menger::fem
