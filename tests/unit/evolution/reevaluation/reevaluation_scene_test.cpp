#include "evolution/reevaluation/reevaluation_scene.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>

#include "io/text/whole_file.h"
#include "io/vtk/vtk_file.h"
#include "tests/support/test_folder.h"
#include "voxel/picture/vtk_output.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr double edge_m = 0.01;

/// Writes a cube at x as finite elements do.
void write_cube(const fs::path& file, double x_m) {
  vtkNew<vtkPoints> points;
  for (const auto& [x, y, z] : std::array<std::array<double, 3>, 8>{
           {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}) {
    points->InsertNextPoint(x_m + edge_m * x, edge_m * y, edge_m * z);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const std::array<vtkIdType, 8> corners{0, 1, 2, 3, 4, 5, 6, 7};
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, corners.data());
  io::write_vtu(file, *grid);
}

/// Returns a frame of the surrogate with one voxel, moved by x from its start.
voxel::Frame frame_at(double time_s, double x_m) {
  voxel::Frame frame;
  frame.time_s = time_s;
  frame.position_m = {{x_m, 0.0, 0.0}};
  frame.rest_position_m = {{0.0, 0.0, 0.0}};
  frame.orientation = {{1.0, 0.0, 0.0, 0.0}};
  frame.size_m = {edge_m};
  frame.speed_m_s = {0.0};
  frame.strain = {0.0};
  frame.material = {1};
  frame.phase = {0.0};
  frame.contact = {0};
  frame.cell_edge_m = edge_m;
  return frame;
}

class ReevaluationScene : public testing::Test {
 protected:
  ReevaluationScene() {
    design_.elements.folder = folder_ / "runs/a/result";
    std::vector<voxel::CollectionEntry> entries;
    for (int n = 0; n < 3; ++n) {
      const fs::path file = "frames/frame_000" + std::to_string(n) + ".vtu";
      write_cube(design_.elements.folder / file, 0.002 * n);
      entries.push_back({.time_s = 0.1 * n, .file = file});
      design_.surrogate.frames.push_back(frame_at(0.1 * n + 1e-4, 0.001 * n));
    }
    voxel::write_collection(design_.elements.folder / "frames.pvd", entries);
  }

  const tests::TestFolder folder_;
  ReevaluatedDesign design_;
};

TEST_F(ReevaluationScene, BothModelsStandInOneCollectionOnOneClock) {
  const SceneOutcome outcome = write_both_models(folder_ / "winner", design_, false);
  EXPECT_EQ(outcome.frames, 3U);
  EXPECT_TRUE(outcome.notes.empty());
  const std::vector<voxel::CollectionEntry> entries = voxel::read_collection(folder_ / "winner/both.pvd");
  ASSERT_EQ(entries.size(), 6U);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_EQ(entries[n].part, static_cast<int>(n % 2));
    EXPECT_EQ(entries[n].time_s, 0.1 * static_cast<double>(n / 2));
    EXPECT_TRUE(fs::is_regular_file(folder_ / "winner" / entries[n].file)) << entries[n].file;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder_ / "winner" / entries[5].file).c_str());
  reader->Update();
  std::array<double, 6> bounds{};
  reader->GetOutput()->GetBounds(bounds.data());
  const double rounding = 1e-8;  // of float32
  EXPECT_NEAR(bounds[0], 0.002, rounding) << "where the first cell of finite elements begins, and 2 mm on";
  EXPECT_NEAR(bounds[4], 0.0, rounding) << "on the same ground";
  EXPECT_NEAR(bounds[3], edge_m, rounding) << "at the same place, so that ParaView can lay one over the other";
  EXPECT_EQ(entries[4].name, "finite elements");
  EXPECT_EQ(entries[5].name, "voxels");
}

TEST_F(ReevaluationScene, WhatAnEarlierCallLeftIsRemoved) {
  (void)write_both_models(folder_ / "winner", design_, false);
  design_.surrogate.frames.pop_back();
  EXPECT_EQ(write_both_models(folder_ / "winner", design_, false).frames, 2U);
  EXPECT_FALSE(fs::exists(folder_ / "winner/voxels_0002.vtu"));
  design_.surrogate.frames.clear();
  const SceneOutcome nothing = write_both_models(folder_ / "winner", design_, true);
  EXPECT_EQ(nothing.frames, 0U);
  EXPECT_EQ(nothing.notes.size(), 1U);
  EXPECT_FALSE(fs::exists(folder_ / "winner/both.pvd"));
}

TEST_F(ReevaluationScene, DrawsAStrip) {
  const SceneOutcome outcome = write_both_models(folder_ / "winner", design_, true);
  if (!outcome.picture.written) GTEST_SKIP() << outcome.picture.missing;
  EXPECT_EQ(io::read_whole(folder_ / "winner/strip.png").substr(1, 3), "PNG");
}

}  // namespace
}  // namespace menger::evolution
