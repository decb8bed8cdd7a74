#include "fem/inflation/inflation_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "fem/elements/element_kernel.h"
#include "fem/inflation/inflation_problem.h"
#include "fem/inflation/path_checkpoint.h"
#include "io/text/number_text.h"
#include "io/text/version.h"
#include "io/text/whole_file.h"
#include "meshes/design/reference_shapes.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::fem {
namespace {

/// A cube of linear elements under pressure.
InflationStudy cube_study() {
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
  return study;
}

TEST(InflationRun, TellsItsNotesBeforeItFollowsThePath) {
  std::vector<std::string> told;
  int points = 0;
  InflationOptions options;
  options.begun = [&](const std::vector<std::string>& notes) {
    EXPECT_EQ(points, 0);
    told = notes;
  };
  options.progress = [&](const PathPoint&, double, double) { ++points; };
  const tests::TestFolder folder;
  const InflationResult result = run_inflation(cube_study(), folder / "new", options);
  EXPECT_GT(points, 0);
  ASSERT_EQ(told.size(), 1U) << "one linear element through the wall";
  ASSERT_GE(result.notes.size(), told.size());
  EXPECT_EQ(result.notes.front(), told.front());
}

/// What a checkpoint of a study depends on, see InflationRun::identity.
std::string identity_of(const InflationStudy& study) {
  std::string text = path_text(study) + "version = " + std::string(io::version()) +
                     "\ninstruction_set = " + std::string(best_element_kernels().instruction_set) + "\n";
  for (const NamedPoint& point : make_problem(study).points) {
    text += point.name;
    for (const double x : point.position) text += " " + io::number_text(x);
    text += "\n";
  }
  return text;
}

// The file is whole and of the study, but what it holds may be anything.
TEST(InflationRun, RefusesACheckpointThatDoesNotFitTheBodyAndTouchesNothing) {
  const InflationStudy study = cube_study();
  const tests::TestFolder folder;
  ASSERT_EQ(run_inflation(study, folder / "out").path.status, io::RunStatus::completed);
  const std::filesystem::path checkpoint = folder / "out/path.checkpoint";
  const std::string curves = io::read_whole(folder / "out/curves.csv");
  const std::string identity = identity_of(study);
  const PathProgress whole = read_checkpoint(checkpoint, identity, MPI_COMM_WORLD).value();
  ASSERT_GE(whole.restart.points.size(), 2U);
  ASSERT_FALSE(whole.restart.states.back().element_pressures_Pa.empty());
  const auto expect_refused = [&](const std::string& reason, const auto& change) {
    PathProgress changed = whole;
    change(changed, changed.restart.states.back(), changed.restart.points.back());
    write_checkpoint(checkpoint, identity, changed, MPI_COMM_WORLD);
    const std::string message = tests::message_of([&] { (void)run_inflation(study, folder / "out"); });
    EXPECT_NE(message.find("path.checkpoint: does not fit the body: it has " + reason), std::string::npos) << message;
    EXPECT_NE(message.find("; give --restart"), std::string::npos) << message;
    EXPECT_EQ(io::read_whole(folder / "out/curves.csv"), curves) << reason;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/result.toml")) << reason;
  };
  const std::string state = "a state of another size, or with a number that is not finite";
  expect_refused(state, [](PathProgress&, BodyState& s, PathPoint&) { s.displacements_m.resize(3); });
  expect_refused(state, [](PathProgress&, BodyState& s, PathPoint&) { s.displacements_m[1] = std::nan(""); });
  expect_refused(state, [](PathProgress&, BodyState& s, PathPoint&) { s.plenum_pressures_Pa.clear(); });
  expect_refused(state, [](PathProgress&, BodyState& s, PathPoint&) { s.element_pressures_Pa.resize(8); });
  expect_refused("a point of another body", [](PathProgress&, BodyState&, PathPoint& p) { p.pressures_Pa.clear(); });
  expect_refused("a point of another body", [](PathProgress&, BodyState&, PathPoint& p) { p.chamber_volumes_m3.resize(7); });
  expect_refused("a point of another body", [](PathProgress& p, BodyState&, PathPoint&) { p.observations[0].clear(); });
  expect_refused("other observations", [](PathProgress& p, BodyState&, PathPoint&) { p.observations.pop_back(); });
  expect_refused("0 states of ", [](PathProgress& p, BodyState&, PathPoint&) {
    p.restart.states.clear();
    p.restart.s.clear();
  });
  expect_refused("a limit point of a plenum",
                 [](PathProgress& p, BodyState&, PathPoint&) { p.restart.limit_points = {{.plenum = 9}}; });
  expect_refused("a step whose length", [](PathProgress& p, BodyState&, PathPoint&) { p.restart.next_step = std::nan(""); });
  write_checkpoint(checkpoint, identity, whole, MPI_COMM_WORLD);
  EXPECT_EQ(run_inflation(study, folder / "out").path.status, io::RunStatus::completed);
}

}  // namespace
}  // namespace menger::fem
