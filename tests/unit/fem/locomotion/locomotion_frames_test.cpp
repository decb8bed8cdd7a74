#include "fem/locomotion/locomotion_frames.h"

#include <gtest/gtest.h>
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

TEST(LocomotionFrames, KeepTheFirstOnesAndGoOn) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  const Moved moved;
  LocomotionFrames frames(folder, moved.study.mesh, moved.study.material.law);
  frames.keep_only({});
  for (const double time : {0.0, 0.1, 0.2}) {
    MovedBody body = moved.body();
    body.time_s = time;
    frames.add(body);
  }
  LocomotionFrames again(folder, moved.study.mesh, moved.study.material.law);
  again.keep_only({0.0, 0.1});
  EXPECT_TRUE(fs::exists(folder / "frames/frame_0001.vtu"));
  EXPECT_FALSE(fs::exists(folder / "frames/frame_0002.vtu"));
  again.add(moved.body());
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
  LocomotionFrames frames(folder, moved.study.mesh, moved.study.material.law);
  frames.keep_only({});
  for (int n = 0; n < 3; ++n) frames.add(moved.body());
  fs::remove(folder / "frames/frame_0001.vtu");
  LocomotionFrames again(folder, moved.study.mesh, moved.study.material.law);
  again.keep_only({0.5, 0.5, 0.5});
  EXPECT_TRUE(fs::exists(folder / "frames/frame_0000.vtu"));
  EXPECT_FALSE(fs::exists(folder / "frames/frame_0002.vtu"));
  const std::string collection = io::read_whole(folder / "frames.pvd");
  EXPECT_NE(collection.find("frame_0000.vtu"), std::string::npos);
  EXPECT_EQ(collection.find("frame_0001.vtu"), std::string::npos);
}

}  // namespace
}  // namespace menger::fem
