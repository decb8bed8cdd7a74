#include "fem/locomotion/locomotion_frames.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkHexahedron.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>
#include <vector>

#include "tests/support/test_folder.h"
#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using namespace locomotion_samples;

/// The hook moved by (1, 2, 3) mm at 0.5 s, its chamber at 800 Pa.
struct Moved {
  LocomotionStudy study = sample_study(hook_study);
  std::vector<double> displacements;
  std::vector<double> pressures{800.0};
  Moved() {
    for (std::size_t n = 0; n < study.mesh.points.size(); ++n) displacements.insert(displacements.end(), {0.001, 0.002, 0.003});
  }
  [[nodiscard]] MovedBody body() const { return {0.5, displacements, displacements, pressures}; }
};

TEST(LocomotionFrames, ShowTheBodyWhereItIs) {
  const Moved moved;
  const auto grid = moved_body_grid(moved.study.mesh, moved.body());
  ASSERT_EQ(grid->GetNumberOfPoints(), static_cast<vtkIdType>(moved.study.mesh.points.size()));
  for (vtkIdType n = 0; n < grid->GetNumberOfPoints(); ++n) {
    const meshes::Point& X = moved.study.mesh.points[static_cast<std::size_t>(n)];
    EXPECT_DOUBLE_EQ(grid->GetPoint(n)[0], X[0] + 0.001);
    EXPECT_DOUBLE_EQ(grid->GetPoint(n)[2], X[2] + 0.003);
  }
}

// Elements whose corners are in the wrong order have no volume, or a negative one.
TEST(LocomotionFrames, HaveElementsOfTheBodysVolume) {
  const Moved moved;
  const auto grid = moved_body_grid(moved.study.mesh, moved.body());
  double volume = 0.0;
  for (std::size_t e = 0; e < moved.study.mesh.elements.size(); ++e) {
    vtkCell* cell = grid->GetCell(static_cast<vtkIdType>(e));
    ASSERT_EQ(cell->GetCellType(), VTK_HEXAHEDRON);
    meshes::Point low{};
    meshes::Point high{};
    const auto corner = [&](vtkIdType c, meshes::Point& x) { grid->GetPoint(cell->GetPointId(static_cast<int>(c)), x.data()); };
    corner(0, low);
    corner(6, high);  // the opposite one in VTK's order
    volume += (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  }
  // Three cells of 10 mm less the chamber: 6 x 6 x 6 mm in each, and two passages of 4 x 6 x 6 mm.
  EXPECT_NEAR(volume, 3e-6 - (3.0 * 216e-9 + 2.0 * 144e-9), 1e-15);
}

TEST(LocomotionFrames, CarryPressureOnTheWallsOfChambers) {
  const Moved moved;
  const auto grid = moved_body_grid(moved.study.mesh, moved.body());
  vtkDataArray* chamber = grid->GetCellData()->GetArray("chamber");
  vtkDataArray* pressure = grid->GetCellData()->GetArray("chamber_pressure_Pa");
  vtkIdType walls = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const bool is_wall = chamber->GetTuple1(c) == 0.0;
    EXPECT_EQ(pressure->GetTuple1(c), is_wall ? 800.0 : 0.0);
    EXPECT_EQ(grid->GetCellType(c), is_wall ? VTK_QUAD : VTK_HEXAHEDRON);
    walls += is_wall ? 1 : 0;
  }
  EXPECT_GT(walls, 0);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.5);
}

TEST(LocomotionFrames, KeepTheFirstOnesAndGoOn) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  const Moved moved;
  LocomotionFrames frames(folder);
  frames.keep_only({});
  for (const double time : {0.0, 0.1, 0.2}) {
    MovedBody body = moved.body();
    body.time_s = time;
    frames.add(moved.study.mesh, body);
  }
  LocomotionFrames again(folder);
  again.keep_only({0.0, 0.1});
  EXPECT_TRUE(fs::exists(folder / "frames/frame_0001.vtu"));
  EXPECT_FALSE(fs::exists(folder / "frames/frame_0002.vtu"));
  again.add(moved.study.mesh, moved.body());
  const std::string collection = io::read_whole(folder / "frames.pvd");
  EXPECT_NE(collection.find("timestep=\"0.1\" part=\"0\" file=\"frames/frame_0001.vtu\""), std::string::npos);
  EXPECT_NE(collection.find("timestep=\"0.5\" part=\"0\" file=\"frames/frame_0002.vtu\""), std::string::npos);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "frames/frame_0002.vtu").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), static_cast<vtkIdType>(moved.study.mesh.points.size()));
  EXPECT_NE(reader->GetOutput()->GetPointData()->GetArray("velocity_m_per_s"), nullptr);
}

TEST(LocomotionFrames, KeepThoseBeforeOneThatIsMissing) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  const Moved moved;
  LocomotionFrames frames(folder);
  frames.keep_only({});
  for (int n = 0; n < 3; ++n) frames.add(moved.study.mesh, moved.body());
  fs::remove(folder / "frames/frame_0001.vtu");
  LocomotionFrames again(folder);
  again.keep_only({0.5, 0.5, 0.5});
  EXPECT_TRUE(fs::exists(folder / "frames/frame_0000.vtu"));
  EXPECT_FALSE(fs::exists(folder / "frames/frame_0002.vtu"));
  const std::string collection = io::read_whole(folder / "frames.pvd");
  EXPECT_NE(collection.find("frame_0000.vtu"), std::string::npos);
  EXPECT_EQ(collection.find("frame_0001.vtu"), std::string::npos);
}

}  // namespace
}  // namespace menger::fem
