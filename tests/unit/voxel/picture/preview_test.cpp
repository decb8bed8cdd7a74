#include "voxel/picture/preview.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <array>
#include <filesystem>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::voxel {
namespace {

namespace fs = std::filesystem;

/// A row of two cubes of different materials, lying on the ground.
Frame two_cubes() {
  return {.time_s = 0.0,
          .position_m = {{0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}},
          .orientation = {{1.0, 0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}},
          .size_m = {0.01, 0.01},
          .reach_m = {},
          .speed_m_s = {0.0, 0.0},
          .strain = {0.0, 0.0},
          .material = {1, 2},
          .phase = {0.0, 0.0},
          .contact = {0, 0},
          .cell_edge_m = 0.01};
}

struct Pixels {
  int width = 0, height = 0;
  int blue = 0, orange = 0, white = 0;
};

Pixels count_pixels(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  Pixels pixels{.width = image.GetDimensions()[0], .height = image.GetDimensions()[1]};
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      const double red = image.GetScalarComponentAsDouble(x, y, 0, 0);
      const double green = image.GetScalarComponentAsDouble(x, y, 0, 1);
      const double blue = image.GetScalarComponentAsDouble(x, y, 0, 2);
      if (red > 250 && green > 250 && blue > 250) ++pixels.white;
      if (green > 1.5 * red && blue > 1.5 * red) ++pixels.blue;
      if (red > 1.5 * green && red > 1.5 * blue) ++pixels.orange;
    }
  }
  return pixels;
}

class Preview : public testing::Test {
 protected:
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< not there before a test writes
  io::PictureStyle small_{.width_px = 320, .height_px = 200};
};

TEST_F(Preview, DrawsBothMaterialsOnWhite) {
  const io::PictureOutcome outcome = render_robot(folder_ / "robot.png", two_cubes(), {}, {small_});
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  const Pixels pixels = count_pixels(folder_ / "robot.png");
  EXPECT_EQ(pixels.width, 320);
  EXPECT_EQ(pixels.height, 200);
  const int all = pixels.width * pixels.height;
  EXPECT_GT(pixels.blue, all / 50);
  EXPECT_GT(pixels.orange, all / 50);
  EXPECT_GT(pixels.white, all / 5);
}

TEST_F(Preview, ATitleTakesRoomFromTheRobot) {
  const io::PictureOutcome outcome = render_robot(folder_ / "plain.png", two_cubes(), {}, {small_});
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  ASSERT_TRUE(render_robot(folder_ / "titled.png", two_cubes(), {}, {.picture = small_, .title = "two cubes after 5 s"}).written);
  EXPECT_LT(count_pixels(folder_ / "titled.png").blue, count_pixels(folder_ / "plain.png").blue);
  EXPECT_GT(count_pixels(folder_ / "titled.png").blue, 0);
}

TEST_F(Preview, ALargerRobotInARowIsDrawnLarger) {
  Frame small = two_cubes();
  small.material = {1, 1};
  Frame large = two_cubes();
  large.material = {2, 2};
  large.size_m = {0.02, 0.02};
  large.position_m = {{0.0, 0.0, 0.005}, {0.02, 0.0, 0.005}};
  const std::array frames{small, large};
  const io::PictureOutcome outcome =
      render_row(folder_ / "row.png", frames, {}, {.picture = {.width_px = 960, .height_px = 600}});
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  const Pixels pixels = count_pixels(folder_ / "row.png");
  ASSERT_GT(pixels.blue, 0);
  // Twice the edge is four times the area; edges of the cubes take some of it.
  EXPECT_NEAR(static_cast<double>(pixels.orange) / pixels.blue, 4.0, 0.6);
}

TEST_F(Preview, PlotsATrajectory) {
  const Trajectory trajectory{{0.0, {0.0, 0.0, 0.0}, {}}, {1.0, {0.01, 0.0, 0.0}, {}}, {2.0, {0.02, 0.01, 0.0}, {}}};
  const io::PictureOutcome outcome = plot_trajectory(folder_ / "plot.png", trajectory, 0.03, "walker", small_);
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  const Pixels pixels = count_pixels(folder_ / "plot.png");
  EXPECT_GT(pixels.blue, 100);  // the lines
  EXPECT_GT(pixels.orange, 0);  // the end
  EXPECT_GT(pixels.white, pixels.width * pixels.height / 2);
}

TEST_F(Preview, PlotsABodyThatNeverMoved) {
  const Trajectory trajectory{{0.0, {0.0, 0.0, 0.0}, {}}, {1.0, {0.0, 0.0, 0.0}, {}}};
  const io::PictureOutcome outcome = plot_trajectory(folder_ / "plot.png", trajectory, 0.03, "walker", small_);
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  EXPECT_GT(count_pixels(folder_ / "plot.png").blue, 100);
}

TEST_F(Preview, PlotsNothingFromASingleRecord) {
  const io::PictureOutcome outcome = plot_trajectory(folder_ / "plot.png", {{0.0, {0.0, 0.0, 0.0}, {}}}, 0.03, "walker", small_);
  EXPECT_FALSE(outcome.written);
  EXPECT_FALSE(outcome.missing.empty());
}

TEST_F(Preview, APlaceUnderAFileIsRefused) {
  io::write_whole(folder_ / "file", "text");
  EXPECT_THROW(static_cast<void>(render_robot(folder_ / "file/robot.png", two_cubes(), {}, {small_})), io::InputError);
}

}  // namespace
}  // namespace menger::voxel
