#include "voxel/picture/vtk_output.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "io/text/formatted.h"
#include "io/text/whole_file.h"
#include "io/vtk/vtk_file.h"
#include "voxel/picture/cube.h"

namespace menger::voxel {
namespace {

void add_real_array(vtkUnstructuredGrid& grid, const char* name, const std::vector<double>& values) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::transform(values.begin(), values.end(), array->GetPointer(0), [](double value) { return static_cast<float>(value); });
  grid.GetCellData()->AddArray(array);
}

/// Adds points as float64, because differences between voxels are small compared with their positions.
void add_points_array(vtkUnstructuredGrid& grid, const char* name, const std::vector<std::array<double, 3>>& points) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  for (vtkIdType voxel = 0; const auto& point : points) array->SetTuple(voxel++, point.data());
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
  vtkIdType point = 0;
  for (std::size_t voxel = 0; voxel < frame.position_m.size(); ++voxel) {
    std::array<vtkIdType, cube_corner_count> corners{};
    for (std::size_t corner = 0; const auto& position : cube_corners_m(frame, voxel)) {
      points->SetPoint(point, position.data());
      corners[corner++] = point++;
    }
    grid.InsertNextCell(VTK_HEXAHEDRON, cube_corner_count, corners.data());
  }
  grid.SetPoints(points);
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
  add_points_array(*grid, "centre_m", frame.position_m);
  add_byte_array(*grid, "material", frame.material);
  add_real_array(*grid, "phase", frame.phase);
  add_real_array(*grid, "size_m", frame.size_m);
  add_real_array(*grid, "strain", frame.strain);
  add_real_array(*grid, "speed_m_s", frame.speed_m_s);
  add_byte_array(*grid, "contact", frame.contact);
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(frame.time_s);
  grid->GetFieldData()->AddArray(time);

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
  entries_.push_back({frame.time_s, frame_file(entries_.size())});
  write_frame(folder_ / entries_.back().file, frame);
}

void FrameSeries::finish() const { write_collection(collection_file(), entries_); }

std::filesystem::path FrameSeries::collection_file() const { return folder_ / (name_ + ".pvd"); }

std::filesystem::path FrameSeries::frame_file(std::size_t index) const {
  return std::filesystem::path(name_) / ("frame_" + io::padded(index, 4) + ".vtu");
}

}  // namespace menger::voxel
