#include "fem/inflation/inflation_run.h"

#include <gtest/gtest.h>

#include "meshes/design/reference_shapes.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

TEST(InflationRun, TellsItsNotesBeforeItFollowsThePath) {
  InflationStudy study;
  study.file = "study.toml";
  DesignSource source;
  source.design = {"cube", meshes::full_cube(1), 0.02};
  source.options.wall_thickness_m = 0.004;
  study.source = source;
  study.material.law = materials::NeoHookean{5e4};
  study.material.volume = materials::SimoTaylorVolume{2.5e6};
  study.degree = 1;
  study.drives[""] = {.kind = DriveKind::pressure, .values = {0.0, 1000.0}};
  study.output.fields = study.output.pictures = false;
  std::vector<std::string> told;
  int points = 0;
  InflationOptions options;
  options.begun = [&](const std::vector<std::string>& notes) {
    EXPECT_EQ(points, 0);
    told = notes;
  };
  options.progress = [&](const PathPoint&, double, double) { ++points; };
  const tests::TestFolder folder;
  const InflationResult result = run_inflation(study, folder / "new", options);
  EXPECT_GT(points, 0);
  ASSERT_EQ(told.size(), 1U) << "one linear element through the wall";
  ASSERT_GE(result.notes.size(), told.size());
  EXPECT_EQ(result.notes.front(), told.front());
}

}  // namespace
}  // namespace menger::fem
