#include "voxel/picture/vtk_output.h"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/small_disk.h"
#include "tests/support/test_folder.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

/// Two voxels: one at rest at the origin, one that is turned by 90 degrees about z, larger and moving. Files count places from
/// the corner of the first cell: by 5 mm more along each axis.
Frame two_voxels(double time_s) {
  const double half_root = std::sqrt(0.5);
  return {.time_s = time_s,
          .position_m = {{0.0, 0.0, 0.0}, {0.02, 0.01, 0.03}},
          .rest_position_m = {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.02}},
          .orientation = {{1.0, 0.0, 0.0, 0.0}, {half_root, 0.0, 0.0, half_root}},
          .size_m = {0.01, 0.012},
          .reach_m = {},
          .speed_m_s = {0.0, 0.5},
          .strain = {-0.25, 0.125},
          .material = {1, 2},
          .phase = {0.0, 0.5},
          .contact = {contact::floor_static, contact::other_voxel},
          .cell_edge_m = 0.01};
}

class VtkOutput : public testing::Test {
 protected:
  [[nodiscard]] vtkUnstructuredGrid& read(const fs::path& file) {
    reader_->SetFileName((folder_ / file).c_str());
    reader_->Update();
    return *reader_->GetOutput();
  }

  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

double value_of(vtkUnstructuredGrid& grid, const char* array, vtkIdType cell) {
  vtkDataArray* values = grid.GetCellData()->GetArray(array);
  if (values == nullptr) throw std::runtime_error(std::string("no array ") + array);
  return values->GetTuple1(cell);
}

TEST_F(VtkOutput, EveryVoxelIsAHexahedronWithPointsOfItsOwn) {
  write_frame(folder_ / "frame.vtu", two_voxels(0.0));
  vtkUnstructuredGrid& grid = read("frame.vtu");
  ASSERT_EQ(grid.GetNumberOfCells(), 2);
  EXPECT_EQ(grid.GetNumberOfPoints(), 16);
  EXPECT_EQ(grid.GetCellType(0), VTK_HEXAHEDRON);
  EXPECT_EQ(grid.GetCellType(1), VTK_HEXAHEDRON);
}

TEST_F(VtkOutput, CornersAreThoseOfTheTurnedCube) {
  write_frame(folder_ / "frame.vtu", two_voxels(0.0));
  vtkUnstructuredGrid& grid = read("frame.vtu");
  const auto expect_point = [&](vtkIdType cell, int corner, double x, double y, double z) {
    const double* point = grid.GetPoint(grid.GetCell(cell)->GetPointId(corner));
    EXPECT_NEAR(point[0], x + 0.005, 1e-8);
    EXPECT_NEAR(point[1], y + 0.005, 1e-8);
    EXPECT_NEAR(point[2], z + 0.005, 1e-8);
  };
  expect_point(0, 0, -0.005, -0.005, -0.005);
  expect_point(0, 6, 0.005, 0.005, 0.005);
  // The turn takes the corner direction (-, -, -) to (+, -, -) and (+, -, +) to (+, +, +).
  expect_point(1, 0, 0.02 + 0.006, 0.01 - 0.006, 0.03 - 0.006);
  expect_point(1, 5, 0.02 + 0.006, 0.01 + 0.006, 0.03 + 0.006);
}

TEST_F(VtkOutput, DisplacementsLeadBackToTheCellsAtRest) {
  write_frame(folder_ / "frame.vtu", two_voxels(0.0));
  vtkUnstructuredGrid& grid = read("frame.vtu");
  vtkDataArray* displacements = grid.GetPointData()->GetArray("displacement_m");
  ASSERT_NE(displacements, nullptr);
  EXPECT_EQ(grid.GetPointData()->GetVectors(), displacements);
  const auto expect_rest = [&](vtkIdType cell, int corner, const std::array<double, 3>& expected) {
    const vtkIdType id = grid.GetCell(cell)->GetPointId(corner);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(grid.GetPoint(id)[axis] - displacements->GetComponent(id, axis), expected[static_cast<std::size_t>(axis)], 1e-8)
          << cell << " " << corner;
  };
  expect_rest(0, 0, {0.0, 0.0, 0.0});
  expect_rest(0, 6, {0.01, 0.01, 0.01});
  expect_rest(1, 0, {0.01, 0.0, 0.02});
  expect_rest(1, 5, {0.02, 0.0, 0.03});
  EXPECT_EQ(displacements->GetComponent(0, 0), 0.0) << "the first voxel rests";
}

TEST_F(VtkOutput, DrawsAHollowVoxelToTheReachOfItsSides) {
  Frame frame = two_voxels(0.0);
  frame.reach_m = {{0.004, 0.005, 0.006, 0.007, 0.008, 0.009}, {0.001, 0.002, 0.003, 0.004, 0.005, 0.006}};
  write_frame(folder_ / "frame.vtu", frame);
  vtkUnstructuredGrid& grid = read("frame.vtu");
  const auto expect_corner = [&](vtkIdType cell, int corner, const std::array<double, 3>& expected) {
    std::array<double, 3> point{};
    grid.GetPoint(grid.GetCell(cell)->GetPointId(corner), point.data());
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(point[axis], expected[axis] + 0.005, 1e-8) << cell << " " << corner;
  };
  expect_corner(0, 0, {-0.004, -0.006, -0.008});
  expect_corner(0, 6, {0.005, 0.007, 0.009});
  // Turned by 90 degrees about z: its +x side looks along y, its +y side along -x.
  expect_corner(1, 0, {0.02 + 0.003, 0.01 - 0.001, 0.03 - 0.005});
  expect_corner(1, 6, {0.02 - 0.004, 0.01 + 0.002, 0.03 + 0.006});
}

TEST_F(VtkOutput, CentresAreKeptWhateverTheReaches) {
  Frame frame = two_voxels(0.0);
  frame.position_m[1] = {1.0 / 3.0, 1e-9, -0.1};  // more digits than a float32 has
  frame.reach_m = {{0.004, 0.005, 0.006, 0.007, 0.008, 0.009}, {0.001, 0.002, 0.003, 0.004, 0.005, 0.006}};
  write_frame(folder_ / "frame.vtu", frame);
  vtkDataArray* centres = read("frame.vtu").GetCellData()->GetArray("centre_m");
  ASSERT_NE(centres, nullptr);
  ASSERT_EQ(centres->GetNumberOfComponents(), 3);
  for (vtkIdType cell = 0; cell < 2; ++cell) {
    std::array<double, 3> centre{};
    centres->GetTuple(cell, centre.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(centre[axis], frame.position_m[static_cast<std::size_t>(cell)][axis] + 0.005);
  }
}

TEST_F(VtkOutput, VolumesOfTheHexahedraArePositive) {
  write_frame(folder_ / "frame.vtu", two_voxels(0.0));
  vtkUnstructuredGrid& grid = read("frame.vtu");
  for (vtkIdType cell = 0; cell < 2; ++cell) {
    std::array<std::array<double, 3>, 4> corner{};
    for (std::size_t i = 0; const int at : {0, 1, 3, 4}) grid.GetPoint(grid.GetCell(cell)->GetPointId(at), corner[i++].data());
    const auto edge = [&](std::size_t i, std::size_t axis) { return corner[i][axis] - corner[0][axis]; };
    const double volume = edge(1, 0) * (edge(2, 1) * edge(3, 2) - edge(2, 2) * edge(3, 1)) -
                          edge(1, 1) * (edge(2, 0) * edge(3, 2) - edge(2, 2) * edge(3, 0)) +
                          edge(1, 2) * (edge(2, 0) * edge(3, 1) - edge(2, 1) * edge(3, 0));
    EXPECT_NEAR(volume, std::pow(value_of(grid, "size_m", cell), 3), 1e-11);
  }
}

TEST_F(VtkOutput, CellDataAreTheFrames) {
  write_frame(folder_ / "frame.vtu", two_voxels(0.04));
  vtkUnstructuredGrid& grid = read("frame.vtu");
  EXPECT_EQ(value_of(grid, "material", 0), 1.0);
  EXPECT_EQ(value_of(grid, "material", 1), 2.0);
  EXPECT_EQ(value_of(grid, "phase", 1), 0.5);
  EXPECT_FLOAT_EQ(static_cast<float>(value_of(grid, "size_m", 1)), 0.012F);
  EXPECT_EQ(value_of(grid, "strain", 0), -0.25);
  EXPECT_EQ(value_of(grid, "strain", 1), 0.125);
  EXPECT_EQ(value_of(grid, "speed_m_s", 1), 0.5);
  EXPECT_EQ(value_of(grid, "contact", 0), 2.0);
  EXPECT_EQ(value_of(grid, "contact", 1), 4.0);
  EXPECT_FLOAT_EQ(static_cast<float>(value_of(grid, "volume_ratio", 0)), 1.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(value_of(grid, "volume_ratio", 1)), 1.2F * 1.2F * 1.2F);
  EXPECT_EQ(grid.GetCellData()->GetScalars(), grid.GetCellData()->GetArray("volume_ratio")) << "what ParaView colours by";
  ASSERT_NE(grid.GetFieldData()->GetArray("TimeValue"), nullptr);
  EXPECT_EQ(grid.GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.04);
}

TEST_F(VtkOutput, EqualFramesAreEqualFiles) {
  write_frame(folder_ / "a.vtu", two_voxels(0.04));
  write_frame(folder_ / "b.vtu", two_voxels(0.04));
  EXPECT_EQ(io::read_whole(folder_ / "a.vtu"), io::read_whole(folder_ / "b.vtu"));
}

TEST_F(VtkOutput, ThousandsOfVoxelsStayCompact) {
  Frame frame;
  frame.cell_edge_m = 0.01;
  for (int i = 0; i < 8000; ++i) {
    const double jitter = 1e-4 * std::sin(12.9898 * i);  // as irregular as a moving body
    const int row = i / 20;
    const int layer = i / 400;
    frame.position_m.push_back({0.01 * (i % 20) + jitter, 0.01 * (row % 20) - jitter, 0.01 * layer});
    frame.rest_position_m.push_back({0.01 * (i % 20), 0.01 * (row % 20), 0.01 * layer});
    frame.orientation.push_back({1.0, 0.0, 0.0, 0.0});
    frame.size_m.push_back(0.01 + jitter);
    frame.speed_m_s.push_back(jitter);
    frame.strain.push_back(jitter);
    frame.material.push_back(1);
    frame.phase.push_back(0.0);
    frame.contact.push_back(0);
  }
  write_frame(folder_ / "frame.vtu", frame);
  // 8 points and their displacements of 3 floats each, 8 ids of 4 bytes, a centre of 3 doubles and 5 real numbers per voxel: 268
  // bytes before compression.
  EXPECT_LT(fs::file_size(folder_ / "frame.vtu"), 8000U * 268U);
  EXPECT_EQ(read("frame.vtu").GetNumberOfCells(), 8000);
}

TEST_F(VtkOutput, ASeriesListsItsFramesAndCanRemoveThoseOfAnEarlierOne) {
  const auto write_series = [&](int count) {
    FrameSeries series(folder_);
    series.remove_earlier();
    EXPECT_FALSE(fs::exists(folder_ / "frames.pvd"));
    EXPECT_FALSE(fs::exists(folder_ / "frames/frame_0000.vtu"));
    for (int i = 0; i < count; ++i) series.add(two_voxels(0.5 * i));
    series.finish();
  };
  write_series(4);
  // A gap, as a frame removed by hand leaves it, must not hide what follows; other files are not the series' own.
  fs::remove(folder_ / "frames/frame_0001.vtu");
  for (const char* name : {"frame_mine.vtu", "frame_.vtu", "frame_0000.vtu.bak"}) io::write_whole(folder_ / "frames" / name, "");
  write_series(2);
  for (const char* name : {"frame_mine.vtu", "frame_.vtu", "frame_0000.vtu.bak"})
    EXPECT_TRUE(fs::exists(folder_ / "frames" / name));
  const auto entries = read_collection(folder_ / "frames.pvd");
  EXPECT_EQ(entries, (std::vector<CollectionEntry>{{0.0, "frames/frame_0000.vtu", 0, "voxels"},
                                                   {0.5, "frames/frame_0001.vtu", 0, "voxels"}}));
  EXPECT_TRUE(fs::exists(folder_ / "frames/frame_0001.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "frames/frame_0002.vtu"));
  EXPECT_FALSE(fs::exists(folder_ / "frames/frame_0003.vtu"));
}

TEST_F(VtkOutput, APlaceUnderAFileIsRefused) {
  io::write_whole(folder_ / "file", "text");
  EXPECT_THROW(write_frame(folder_ / "file/frame.vtu", two_voxels(0.0)), io::InputError);
  EXPECT_EQ(io::read_whole(folder_ / "file"), "text");
}

TEST_F(VtkOutput, AFullDiskLeavesTheEarlierFrame) {
  const fs::path file = folder_ / "frame.vtu";
  write_frame(file, two_voxels(1.0));
  const std::string whole = io::read_whole(file);
  for (const std::size_t room : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
    bool refused = false;
    {
      const SmallDisk disk(room);
      try {
        write_frame(file, two_voxels(1.0));
      } catch (const io::InputError&) {
        refused = true;
      }
    }
    EXPECT_TRUE(refused) << room;
    EXPECT_EQ(io::read_whole(file), whole) << room;
  }
}

}  // namespace
}  // namespace menger::voxel
