#include "fem/implicit_locomotion/implicit_locomotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "fem/locomotion/locomotion_run.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"
#include "tests/unit/fem/locomotion/locomotion_samples.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using namespace locomotion_samples;

const std::string implicit = "[dynamics]\nmethod = \"implicit\"\n";

class ImplicitLocomotion : public testing::Test {
 protected:
  LocomotionResult run(const std::string& study, const std::string& name, LocomotionRunOptions options = {}) const {
    const LocomotionStudy read = sample_study(study);
    if (read.implicit) options.make = make_implicit_locomotion;
    return run_locomotion(read, folder_ / name, options);
  }

  const tests::TestFolder folder_;
};

/// Largest volume of the only chamber over the records.
double largest_volume_m3(const LocomotionResult& result) {
  double largest = 0.0;
  for (const WalkRecord& record : result.records) largest = std::max(largest, record.chamber_volumes_m3[0]);
  return largest;
}

// The breathing cube by both methods: the same elements, and steps whose errors are far below what is compared. The ground force
// is that of a body that bounces, whose phase differs.
TEST_F(ImplicitLocomotion, MovesAsExplicitDynamicsDoes) {
  const LocomotionResult by_explicit = run(cube_study + "[elements]\nkind = \"three_field\"\n", "explicit");
  const LocomotionResult result = run(cube_study + implicit, "implicit");
  ASSERT_EQ(result.status, io::RunStatus::completed) << result.reason;
  ASSERT_EQ(result.records.size(), by_explicit.records.size());
  EXPECT_EQ(result.records.back().time_s, 0.1);
  EXPECT_EQ(result.elements, by_explicit.elements);
  EXPECT_NEAR(peak_height_m(result), peak_height_m(by_explicit), 0.01 * peak_height_m(by_explicit));
  EXPECT_NEAR(largest_volume_m3(result), largest_volume_m3(by_explicit), 0.005 * largest_volume_m3(by_explicit));
  EXPECT_GT(largest_volume_m3(result), 1.02 * result.records.front().chamber_volumes_m3[0]);
  EXPECT_LT(travel_of(result)->horizontal_displacement_m, 1e-6) << "a symmetric body";
  for (const char* name : {"trajectory.csv", "frames.pvd", "frames/frame_0000.vtu", "manifest.json", "locomotion.toml"})
    EXPECT_TRUE(fs::exists(folder_ / "implicit" / name)) << name;
}

// Frames show the mesh: elements of both degrees have nodes at its points, in their order.
TEST_F(ImplicitLocomotion, ShowsTheNodesOfTheMesh) {
  for (const char* degree : {"degree = 1\n", "degree = 2\n"}) {
    const LocomotionStudy study = sample_study(std::string("[elements]\n") + degree + cube_study + implicit);
    const auto dynamics = make_implicit_locomotion(study, nullptr);
    // Without gravity's and the ground's forces the start is at rest everywhere; after a millisecond the body has fallen a
    // little.
    EXPECT_EQ(dynamics->displacements_m(), std::vector<double>(3 * study.mesh.points.size(), 0.0));
    ASSERT_EQ(dynamics->advance_to(1e-3).status, io::RunStatus::completed);
    const std::vector<double> u = dynamics->displacements_m();
    const std::vector<double> v = dynamics->velocities_m_per_s();
    ASSERT_EQ(v.size(), u.size());
    // Two mirror planes: a point and its image move alike, mirrored, which wrong nodes would not.
    double largest = 0.0;
    for (std::size_t a = 0; a < study.mesh.points.size(); ++a) {
      const Point& X = study.mesh.points[a];
      for (std::size_t b = 0; b < study.mesh.points.size(); ++b) {
        const Point& Y = study.mesh.points[b];
        if (std::abs(X[0] + Y[0] - 0.02) + std::abs(X[1] - Y[1]) + std::abs(X[2] - Y[2]) > 1e-9) continue;
        EXPECT_NEAR(u[3 * a], -u[3 * b], 1e-9);
        EXPECT_NEAR(u[3 * a + 2], u[3 * b + 2], 1e-9);
        largest = std::max(largest, std::abs(u[3 * a + 2]));
      }
    }
    EXPECT_GT(largest, 1e-7) << degree;
  }
}

// An L of Ls has two modules that touch along an edge without a bond: their points coincide, and each goes with its own module.
TEST_F(ImplicitLocomotion, TellsPointsThatCoincideApart) {
  const LocomotionStudy study =
      sample_study(hook + "level = 2\n" + silicone + ground + drive + short_time + no_pictures + implicit);
  const auto dynamics = make_implicit_locomotion(study, nullptr);
  ASSERT_EQ(dynamics->advance_to(2e-3).status, io::RunStatus::completed);
  const std::vector<double> u = dynamics->displacements_m();
  std::size_t coincident = 0;
  double furthest_m = 0.0;
  for (std::size_t a = 0; a < study.mesh.points.size(); ++a) {
    for (std::size_t b = a + 1; b < study.mesh.points.size(); ++b) {
      const Point& X = study.mesh.points[a];
      const Point& Y = study.mesh.points[b];
      if (std::hypot(X[0] - Y[0], X[1] - Y[1], X[2] - Y[2]) > 1e-9) continue;
      ++coincident;
      for (std::size_t i = 0; i < 3; ++i) furthest_m = std::max(furthest_m, std::abs(u[3 * a + i] - u[3 * b + i]));
    }
  }
  EXPECT_GT(coincident, 1U) << "along an edge";
  EXPECT_GT(furthest_m, 1e-7);
}

TEST_F(ImplicitLocomotion, GoesOnWhereItWasStoppedAsIfNothingHadHappened) {
  std::string study = hook_study + implicit;
  study.replace(study.find("record_interval_s = 0.004"), 25, "record_interval_s = 0.0015");
  const LocomotionResult whole = run(study, "whole");
  ASSERT_EQ(whole.status, io::RunStatus::completed) << whole.reason;
  std::size_t stops = 0;
  for (LocomotionResult result; result.status == io::RunStatus::stopped; ++stops) {
    std::atomic<bool> stop = false;
    int left = 13;  // more than between two states that it can be taken up from
    const auto count_down = [&](double) { stop = --left == 0; };
    result = run(study, "parts", {.stop = &stop, .progress = count_down});
    ASSERT_LT(stops, 10U);
  }
  EXPECT_EQ(stops, 3U) << "two stops among 27 records, and the end";
  std::vector<fs::path> files{"trajectory.csv", "frames.pvd"};
  for (const auto& entry : fs::directory_iterator(folder_ / "whole/frames")) files.push_back("frames" / entry.path().filename());
  EXPECT_GE(files.size(), 8U);
  for (const fs::path& file : files)
    EXPECT_EQ(io::read_whole(folder_ / "whole" / file), io::read_whole(folder_ / "parts" / file)) << file;
}

TEST_F(ImplicitLocomotion, TakesUpNoStateOfAnotherBody) {
  const LocomotionStudy study = sample_study(cube_study + implicit);
  const auto dynamics = make_implicit_locomotion(study, nullptr);
  ASSERT_EQ(dynamics->advance_to(1e-3).status, io::RunStatus::completed);
  const WalkState whole = dynamics->state();
  EXPECT_EQ(dynamics->misfit(whole), "");
  const auto misfit = [&](const auto& change) {
    ImplicitState changed = std::get<ImplicitState>(whole);
    change(changed);
    return dynamics->misfit(changed);
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto holds = [](const std::string& reason, const char* words) { return reason.find(words) != std::string::npos; };
  EXPECT_TRUE(holds(misfit([](ImplicitState& s) { s.displacements_m.pop_back(); }), "displacements_m has"));
  EXPECT_TRUE(holds(misfit([&](ImplicitState& s) { s.velocities_m_per_s[0] = none; }), "velocities_m_per_s holds"));
  EXPECT_TRUE(holds(misfit([](ImplicitState& s) { s.accelerations_m_per_s2.resize(3); }), "accelerations_m_per_s2 has"));
  EXPECT_TRUE(holds(misfit([](ImplicitState& s) { s.ground_nodes.resize(1); }), "ground_nodes has"));
  EXPECT_TRUE(holds(misfit([&](ImplicitState& s) { s.ground_nodes[0].anchor_m[0] = none; }), "anchor_m holds"));
  EXPECT_TRUE(holds(misfit([&](ImplicitState& s) { s.next_step_s = none; }), "time_s holds"));
  EXPECT_TRUE(holds(dynamics->misfit(ExplicitState{}), "explicit"));
}

// See LocomotionRun.EndsBeyondTheLimitPressureWithAStatus.
TEST_F(ImplicitLocomotion, EndsBeyondTheLimitPressureWithAStatus) {
  const std::string study =
      cube + silicone + ground + "[drive]\nmode = \"hold\"\npressure_Pa = [0, 60000]\nfrequency_Hz = 20\n" + time + no_pictures;
  const LocomotionResult result = run(study + implicit, "out");
  EXPECT_NE(result.status, io::RunStatus::completed);
  EXPECT_NE(result.status, io::RunStatus::stopped);
  EXPECT_NE(result.reason.find(" at "), std::string::npos) << result.reason;
  EXPECT_LT(result.time_s, 0.1);
  EXPECT_FALSE(travel_of(result));
}

}  // namespace
}  // namespace menger::fem
