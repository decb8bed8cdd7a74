#include "voxel/picture/vtk_output.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "io/text/formatted.h"
#include "io/text/whole_file.h"
#include "io/vtk/grid_arrays.h"
#include "io/vtk/vtk_file.h"
#include "voxel/picture/cube.h"

namespace menger::voxel {
namespace {

/// Moves a place from the coordinates of a Frame into those of the design.
std::array<double, 3> in_design(const Frame& frame, std::array<double, 3> place_m) {
  for (double& coordinate : place_m) coordinate += 0.5 * frame.cell_edge_m;
  return place_m;
}

/// Adds the centres as float64, because differences between voxels are small compared with their positions.
void add_centres(vtkUnstructuredGrid& grid, const Frame& frame) {
  vtkNew<vtkDoubleArray> array;
  array->SetName("centre_m");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(frame.position_m.size()));
  for (vtkIdType voxel = 0; const auto& centre : frame.position_m) array->SetTuple(voxel++, in_design(frame, centre).data());
  grid.GetCellData()->AddArray(array);
}

void add_byte_array(vtkUnstructuredGrid& grid, const char* name, const std::vector<std::uint8_t>& values) {
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  grid.GetCellData()->AddArray(array);
}

void add_cubes(vtkUnstructuredGrid& grid, const Frame& frame) {
  const auto voxels = static_cast<vtkIdType>(frame.position_m.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(cube_corner_count * voxels);
  grid.AllocateExact(voxels, cube_corner_count * voxels);
  std::vector<double> displacements;
  vtkIdType point = 0;
  for (std::size_t voxel = 0; voxel < frame.position_m.size(); ++voxel) {
    std::array<vtkIdType, cube_corner_count> ids{};
    const auto corners = cube_corners_m(frame, voxel);
    const auto at_rest = rest_corners_m(frame, voxel);
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      points->SetPoint(point, in_design(frame, corners[corner]).data());
      ids[corner] = point++;
      for (std::size_t axis = 0; axis < 3; ++axis) displacements.push_back(corners[corner][axis] - at_rest[corner][axis]);
    }
    grid.InsertNextCell(VTK_HEXAHEDRON, cube_corner_count, ids.data());
  }
  grid.SetPoints(points);
  io::add_floats(*grid.GetPointData(), "displacement_m", displacements, 3);
  grid.GetPointData()->SetActiveVectors("displacement_m");
}

/// Whether a name is frame_0000.vtu or the like, with any number of digits.
bool is_frame_name(std::string_view name) {
  constexpr std::string_view before = "frame_", after = ".vtu";
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) return false;
  const std::string_view digits = name.substr(before.size(), name.size() - before.size() - after.size());
  return digits.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

void write_frame(const std::filesystem::path& file, const Frame& frame) {
  vtkNew<vtkUnstructuredGrid> grid;
  add_cubes(*grid, frame);
  add_centres(*grid, frame);
  add_byte_array(*grid, "material", frame.material);
  vtkCellData& data = *grid->GetCellData();
  std::vector<double> volume_ratios;
  for (std::size_t voxel = 0; voxel < frame.position_m.size(); ++voxel) volume_ratios.push_back(volume_ratio(frame, voxel));
  io::add_floats(data, "phase", frame.phase);
  io::add_floats(data, "size_m", frame.size_m);
  io::add_floats(data, "volume_ratio", volume_ratios);
  io::add_floats(data, "strain", frame.strain);
  io::add_floats(data, "speed_m_s", frame.speed_m_s);
  add_byte_array(*grid, "contact", frame.contact);
  data.SetActiveScalars("volume_ratio");
  io::add_field_values(*grid, "TimeValue", std::array{frame.time_s});
  io::write_vtu(file, *grid);
}

FrameSeries::FrameSeries(std::filesystem::path folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {}

void FrameSeries::remove_earlier() const {
  io::remove_if_there(collection_file());
  // All names are collected first, because it is not defined whether a listing continues correctly while files are removed.
  std::vector<std::filesystem::path> frames;
  std::error_code no_such_folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / name_, no_such_folder)) {
    if (is_frame_name(entry.path().filename().string())) frames.push_back(entry.path());
  }
  for (const auto& frame : frames) io::remove_if_there(frame);
}

void FrameSeries::add(const Frame& frame) {
  entries_.push_back({.time_s = frame.time_s, .file = frame_file(entries_.size()), .name = "voxels"});
  write_frame(folder_ / entries_.back().file, frame);
}

void FrameSeries::finish() const { write_collection(collection_file(), entries_); }

std::filesystem::path FrameSeries::collection_file() const { return folder_ / (name_ + ".pvd"); }

std::filesystem::path FrameSeries::frame_file(std::size_t index) const {
  return std::filesystem::path(name_) / ("frame_" + io::padded(index, 4) + ".vtu");
}

}  // namespace menger::voxel
