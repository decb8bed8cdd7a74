#include "fem/inflation/inflation_picture.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <filesystem>
#include <string>

#include "fem/inflation/inflation_charts.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/statics/hollow_cube_space.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;

/// Pixels of a picture that are red, as the highest stress is drawn.
int red_pixels(const fs::path& file) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  int count = 0;
  for (int y = 0; y < image.GetDimensions()[1]; ++y) {
    for (int x = 0; x < image.GetDimensions()[0]; ++x) {
      const auto* pixel = static_cast<unsigned char*>(image.GetScalarPointer(x, y, 0));
      if (pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2] && pixel[0] > 80) ++count;
    }
  }
  return count;
}

TEST(InflationPicture, ShowsStressInsideThatOnlyTheCutLaysOpen) {
  const tests::TestFolder folder;
  for (const int degree : {1, 2}) {
    const Space space = hollow_cube_space(degree);
    NodalFields fields;
    fields.deformation_gradient.assign(space.positions.size(), {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
    // high on the chamber's far wall, y = 16 mm, alone
    for (const Point& X : space.positions) {
      const bool is_wall = X[1] > 0.0159 && X[1] < 0.0161 && X[0] > 0.005 && X[0] < 0.015 && X[2] > 0.005 && X[2] < 0.015;
      fields.cauchy_stress.push_back({is_wall ? 1e4 : 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
    }
    const std::vector<double> displacements(3 * space.positions.size(), 0.0);
    const fs::path file = folder / ("chamber_" + std::to_string(degree) + ".png");
    const DeformedBody body = gather_deformed_body(space, displacements, fields);
    ASSERT_EQ(body.positions.size(), space.positions.size());
    const io::PictureOutcome outcome = draw_deformed_body(file, body, "cut", {.width_px = 400, .height_px = 250});
    if (!outcome.written) GTEST_SKIP() << outcome.missing;
    // the colour bar alone has some hundred red pixels
    EXPECT_GT(red_pixels(file), 1000);
  }
}

TEST(InflationPicture, OfPressureOverVolumeNeedsAPoint) {
  const tests::TestFolder scratch;
  const fs::path folder = scratch / "new";
  EXPECT_FALSE(draw_pressure_volume(folder / "none.png", {}).written);
  InflationResult result;
  result.plenum_names = {"plenum 0"};
  for (const double p : {0.0, 1e3, 1.5e3, 1.2e3}) {
    PathPoint point;
    point.pressures_Pa = {p};
    point.plenum_volumes_m3 = {1e-6 + 1e-9 * static_cast<double>(result.path.points.size())};
    result.path.points.push_back(point);
  }
  result.path.limit_points = {{0, 1.5e3, 1.002e-6, true}};
  const io::PictureOutcome outcome = draw_pressure_volume(folder / "pv.png", result);
  if (!outcome.written) GTEST_SKIP() << outcome.missing;
  EXPECT_TRUE(fs::exists(folder / "pv.png"));
}

}  // namespace
}  // namespace menger::fem
