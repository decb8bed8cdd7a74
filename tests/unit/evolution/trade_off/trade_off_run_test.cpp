#include "evolution/trade_off/trade_off_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "tests/support/surrogate_example.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// A script in place of finite elements: everything grows by (1 + 1 / (degree * elements)^2) * 0.001 per 1000 Pa. It runs
/// `before` first.
std::string fake_inflate(const std::string& before) {
  return R"(n() { sed -n "s/^$1 = //p" inflate.toml | head -1; }
degree=$(n degree); through=$(n elements_through_wall); pressure=$(sed -n 's/^pressure_Pa = \[0, \(.*\)\]/\1/p' inflate.toml)
)" + before +
         R"(
mkdir result
printf 'status = "completed"\nunknowns = 7\naccepted_newton_iterations = 5\n' >result/result.toml
echo chamber_0_volume_m3,extent_change_x_m,extent_change_y_m,extent_change_z_m >result/curves.csv
echo 2,0,0,0 >>result/curves.csv
awk "BEGIN { g = (1 + 1 / ($degree * $through)^2) * $pressure / 1e6; printf \"%.12g,%.12g,%.12g,%.12g\\n\", 2 + 2 * g, 2 * g, g, g }" >>result/curves.csv
)";
}

constexpr const char* fake_simulate = R"(step=$(sed -n "s/^ *time_step_fraction = //p" scene.toml)
mkdir result
printf 'status = "completed"\nvoxels = 3\nsteps = 100\n' >result/result.toml
awk "BEGIN { print \"horizontal_displacement_m = \" 1 + $step }" >>result/result.toml
)";

/// Scripts in place of programs, which write their calls into the file `calls`, and a study that runs them.
class TradeRunTest : public testing::Test {
 protected:
  TradeRunTest() {
    fs::create_directories(folder_ / "bin");
    io::write_whole(folder_ / "design.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n");
    add_program("menger-inflate", fake_inflate(""));
    add_program("menger-simulate", fake_simulate);
    options_.programs = folder_ / "bin";
    options_.pictures = false;
  }

  void add_program(const std::string& name, const std::string& lines) const {
    const fs::path file = folder_ / "bin" / name;
    io::write_whole(file, "#!/bin/sh\nset -e\necho call >>'" + (folder_ / "calls").string() + "'\n" + lines);
    fs::permissions(file, fs::perms::owner_all);
  }

  [[nodiscard]] TradeStudy study(const std::string& text =
                                     "pressure_Pa = 1000\n[finite_elements]\nthin_walls = []\ndegrees = [1, 2]\n"
                                     "elements_through_wall = [1, 2]\n[gait]\n[voxels]\n"
                                     "numbers = [\"float64\"]\ndampings = [\"velocity\"]\n"
                                     "time_step_fractions = [0.5, 0.25]\nexclusion_depths = [\"1\"]\n") const {
    io::write_whole(folder_ / "study.toml", text + "[design]\nfile = \"design.toml\"\n");
    return read_trade_study(folder_ / "study.toml");
  }

  [[nodiscard]] TradeResult run(const TradeStudy& study) const { return run_trade_off(study, folder_ / "out", options_); }
  [[nodiscard]] std::size_t calls() const {
    return fs::exists(folder_ / "calls") ? io::read_whole(folder_ / "calls").size() / 5 : 0;
  }

  const tests::TestFolder folder_;
  TradeOptions options_;
};

TEST_F(TradeRunTest, ComparesAllFidelitiesWithTheFinest) {
  const TradeResult result = run(study());
  EXPECT_EQ(result.status, io::RunStatus::completed);
  EXPECT_EQ(result.repeated, 6U);
  ASSERT_TRUE(result.body && result.gait);
  ASSERT_EQ(result.body->rows.size(), 4U);
  EXPECT_EQ(result.body->reference, 3U);
  // computed by hand, in micrometres: 2, 1.25, 1.25, 1.0625; all observables are proportional
  const double rounding = 1e-7;  // of the script
  EXPECT_NEAR(result.body->rows[3].values[0].value(), 1.0625e-3, 1e-8);
  EXPECT_NEAR(result.body->rows[3].values[1].value(), 2.125e-3, 1e-8);
  EXPECT_NEAR(result.body->rows[0].error.value(), 2.0 / 1.0625 - 1.0, 10.0 * rounding);
  EXPECT_NEAR(result.body->rows[1].error.value(), 1.25 / 1.0625 - 1.0, 10.0 * rounding);
  EXPECT_NEAR(result.body->reference_error.value(), 1.25 / 1.0625 - 1.0, 10.0 * rounding);
  EXPECT_NEAR(result.gait->rows[0].error.value(), 1.5 / 1.25 - 1.0, rounding);
  EXPECT_NEAR(result.gait->reference_error.value(), 0.2, rounding);
  EXPECT_EQ(io::read_csv(folder_ / "out/tradeoff.csv").row_count(), 4U);
  EXPECT_EQ(io::read_csv(folder_ / "out/gait.csv").row_count(), 2U);
  EXPECT_NE(io::read_whole(folder_ / "out/recommendation.txt").find("for 20 % you need finite elements"), std::string::npos);
  EXPECT_EQ(io::read_toml(folder_ / "out/recommendation.toml").tables("recommendation").size(), 5U);
}

TEST_F(TradeRunTest, ASecondCallRepeatsNothing) {
  (void)run(study());
  EXPECT_EQ(calls(), 6U);
  const std::string table = io::read_whole(folder_ / "out/tradeoff.csv");
  EXPECT_EQ(run(study()).repeated, 0U);
  EXPECT_EQ(calls(), 6U);
  EXPECT_EQ(io::read_whole(folder_ / "out/tradeoff.csv"), table);
}

TEST_F(TradeRunTest, FailedFidelitiesStandInTheTable) {
  add_program("menger-inflate", fake_inflate(R"(case $degree$through in
11) echo broken >&2; exit 1;;
12) mkdir result; printf 'status = "limit_point"\nreason = "at 900 Pa"\nunknowns = 7\naccepted_newton_iterations = 5\n' >result/result.toml; exit 3;;
21) exit 0;;
esac)"));
  const TradeResult result = run(study());
  ASSERT_EQ(result.body->rows.size(), 4U);
  EXPECT_EQ(result.body->rows[0].status, "failed");
  EXPECT_EQ(result.body->rows[0].reason, "exit code 1: broken");
  EXPECT_EQ(result.body->rows[1].status, "limit_point");
  EXPECT_EQ(result.body->rows[1].reason, "at 900 Pa");
  EXPECT_EQ(result.body->rows[2].status, "failed") << "no result was written";
  EXPECT_EQ(result.body->rows[3].status, "completed");
  EXPECT_EQ(result.status, io::RunStatus::completed);
}

TEST_F(TradeRunTest, WithoutAReferenceTheTableStandsAlone) {
  add_program("menger-inflate", "exit 1\n");
  const TradeResult result = run(study());
  EXPECT_EQ(result.status, io::RunStatus::not_converged);
  EXPECT_FALSE(result.body->reference);
  EXPECT_EQ(io::read_csv(folder_ / "out/tradeoff.csv").row_count(), 4U);
}

TEST_F(TradeRunTest, ThinWallsRunBesideThreeFieldElementsAndAreNoReference) {
  add_program("menger-inflate", "if grep -q thin_wall inflate.toml; then degree=1; through=2; else\n" +
                                    fake_inflate("").substr(0, fake_inflate("").find("pressure=")) + "\nfi\n" +
                                    fake_inflate("").substr(fake_inflate("").find("pressure=")));
  const TradeResult result =
      run(study("pressure_Pa = 1000\n[finite_elements]\nthin_walls = [\"fine\", \"draft\"]\ndegrees = [1]\n"
                "elements_through_wall = [1, 4]\n"));
  ASSERT_EQ(result.body->rows.size(), 4U);
  EXPECT_EQ(result.body->rows[0].fidelity.at("thin_walls"), "draft");
  EXPECT_EQ(result.body->rows[1].fidelity.at("thin_walls"), "fine");
  EXPECT_FALSE(result.body->rows[0].fidelity.contains("degree"));
  EXPECT_EQ(result.body->reference, 3U);
  // 1 + 1/4 and 1 + 1/16 of the same growth
  EXPECT_NEAR(result.body->rows[0].error.value(), 1.25 / 1.0625 - 1.0, 1e-8);
  EXPECT_EQ(result.body->rows[0].label, "thin walls, draft, bulk ratio 50, tolerance 1e-07");
  EXPECT_EQ(io::read_csv(folder_ / "out/tradeoff.csv").text(1, "thin_walls"), "fine");
}

TEST_F(TradeRunTest, RunsThatTakeTooLongAreEnded) {
  add_program("menger-simulate", "exec sleep 60\n");
  TradeStudy limited = study();
  limited.voxels.time_limit_s = 0.1;
  const TradeResult result = run(limited);
  EXPECT_EQ(result.gait->rows[0].status, "stopped");
  EXPECT_NE(result.gait->rows[0].reason.find("time limit"), std::string::npos);
  EXPECT_TRUE(result.body->reference);
}

TEST_F(TradeRunTest, WhatIsTooLargeIsSkippedAndNamed) {
  TradeStudy small = study();
  small.elements->largest_unknowns = 10'000.0;  // the meshes have 2964, 14856 and 17658
  const TradeResult result = run(small);
  EXPECT_EQ(result.body->rows[0].status, "completed");
  EXPECT_EQ(result.body->rows[1].status, "skipped");
  EXPECT_NE(result.body->rows[1].reason.find("largest_unknowns"), std::string::npos);
  EXPECT_EQ(result.body->reference, 0U);
  small.elements->largest_unknowns = 10.0;
  EXPECT_THROW((void)run(small), io::InputError);
}

TEST_F(TradeRunTest, StopsAndGoesOn) {
  std::atomic<bool> stop{false};
  options_.stop = &stop;
  options_.progress = [&](double, double, const std::string&) { stop = calls() >= 2; };
  const TradeResult stopped = run(study());
  EXPECT_EQ(stopped.status, io::RunStatus::stopped);
  EXPECT_FALSE(fs::exists(folder_ / "out/tradeoff.csv"));
  const std::size_t done = calls();
  EXPECT_LT(done, 6U);
  stop = false;
  options_.progress = nullptr;
  EXPECT_EQ(run(study()).status, io::RunStatus::completed);
  EXPECT_LE(calls(), 7U) << "at most the one that was stopped is run again";
}

TEST_F(TradeRunTest, WithoutAStatedPressureItStaysBelowTheLimit) {
  add_program("menger-inflate", fake_inflate(R"(if [ $pressure = 6000 ]; then mkdir result
printf 'status = "limit_point"\nunknowns = 7\naccepted_newton_iterations = 5\n[[limit_points]]\npressure_Pa = 5000\n' >result/result.toml
exit 3; fi)"));
  const TradeResult result = run(study("[finite_elements]\nthin_walls = []\ndegrees = [1]\nelements_through_wall = [1]\n"));
  EXPECT_EQ(result.pressure_Pa, 4000.0);
  EXPECT_NEAR(result.body->rows[0].values[0].value(), 8e-3, 1e-8);
  EXPECT_EQ(result.notes.size(), 1U);
}

TEST_F(TradeRunTest, AStoppedSearchIsNotCalledWithoutAChampion) {
  for (const char* name : {"menger-evolve", "menger-export"}) add_program(name, "exit 0\n");
  io::write_whole(folder_ / "evolve.toml", "preset = \"paper\"\n");
  std::atomic<bool> stop{true};
  options_.stop = &stop;
  const TradeResult result = run(study("pressure_Pa = 1000\n[search]\nstudy = \"evolve.toml\"\n"));
  EXPECT_EQ(result.status, io::RunStatus::stopped);
  EXPECT_TRUE(result.notes.empty()) << result.notes.front();
}

TEST_F(TradeRunTest, AFidelityThatIsRefusedDoesNotEndTheOthers) {
  add_program("menger-inflate", fake_inflate(R"(if [ $degree$through = 12 ]; then echo 'wall: too thin' >&2; exit 2; fi)"));
  const TradeResult result = run(study());
  EXPECT_EQ(result.status, io::RunStatus::completed);
  EXPECT_EQ(result.body->rows[1].status, "failed");
  EXPECT_EQ(result.body->rows[1].reason, "exit code 2: wall: too thin");
  for (const std::size_t n : {0U, 2U, 3U}) EXPECT_EQ(result.body->rows[n].status, "completed");
}

TEST_F(TradeRunTest, SearchesThatAreAllRefusedAreWrongInput) {
  add_program("menger-evolve", "echo 'study.toml: preset = 7' >&2\nexit 2\n");
  add_program("menger-export", "exit 0\n");
  io::write_whole(folder_ / "evolve.toml", "preset = \"paper\"\n");
  EXPECT_THROW((void)run(study("pressure_Pa = 1000\n[search]\nstudy = \"evolve.toml\"\n")), io::InputError);
}

TEST_F(TradeRunTest, InputThatAProgramAlwaysRefusesIsWrongInput) {
  add_program("menger-inflate", "echo 'design.toml: cell_edge_m = 7: must be 8' >&2\nexit 2\n");
  try {
    (void)run(study());
    ADD_FAILURE() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("design.toml: cell_edge_m = 7: must be 8"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_ / "out/tradeoff.csv"));
}

TEST_F(TradeRunTest, AChangedParametersFileIsAnotherRun) {
  const std::string gait =
      "[gait]\nscene = \"scene.toml\"\n[voxels]\nnumbers = [\"float64\"]\ndampings = [\"velocity\"]\n"
      "time_step_fractions = [0.5]\nexclusion_depths = [\"1\"]\n";
  io::write_whole(folder_ / "scene.toml", "[surrogate]\nparameters = \"p.toml\"\n");
  io::write_whole(folder_ / "p.toml", "density = 1\n");
  EXPECT_EQ(run(study(gait)).repeated, 1U);
  EXPECT_EQ(run(study(gait)).repeated, 0U);
  io::write_whole(folder_ / "p.toml", "density = 2\n");
  EXPECT_EQ(run(study(gait)).repeated, 1U);
}

TEST_F(TradeRunTest, WhatLeavesTheRangeOfValiditySaysSo) {
  add_program("menger-simulate",
              std::string(fake_simulate) +
                  "printf '[surrogate]\\noutside_validity = [\"5 cells long\", \"7 kPa\"]\\n' >>result/result.toml\n");
  const TradeResult result = run(study());
  EXPECT_TRUE(result.gait->rows[0].is_outside());
  const io::CsvContents table = io::read_csv(folder_ / "out/gait.csv");
  EXPECT_EQ(table.text(0, "validity"), "outside");
  EXPECT_EQ(table.text(0, "reason"), "outside the range of validity: 5 cells long; 7 kPa");
  EXPECT_EQ(io::read_csv(folder_ / "out/tradeoff.csv").text(0, "validity"), "");
  EXPECT_NE(io::read_whole(folder_ / "out/recommendation.txt").find(", outside the range of validity"), std::string::npos);
}

TEST_F(TradeRunTest, ParametersOfAnotherBodyAreRefusedBeforeAnythingRuns) {
  // for another silicone, and for cells of 10 mm, not 20
  io::write_whole(folder_ / "p.toml", voxel::surrogate_text(tests::surrogate_example()));
  EXPECT_THROW((void)run(study("[finite_elements]\n[settling]\nparameters = [\"p.toml\"]\n")), io::InputError);
  EXPECT_EQ(calls(), 0U);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(TradeRunTest, TwoParametersFilesForTheSameVoxelsAreRefused) {
  const std::string text =
      "pressure_Pa = 1000\n[finite_elements]\nthin_walls = []\ndegrees = [1]\nelements_through_wall = [1]\n"
      "[settling]\nparameters = [\"a.toml\", \"b.toml\"]\n";
  voxel::SurrogateParameters parameters = tests::surrogate_example();
  parameters.cell_edge_m = 0.02;
  for (const char* name : {"a.toml", "b.toml"}) io::write_whole(folder_ / name, voxel::surrogate_text(parameters));
  TradeStudy same = study(text);
  same.silicone_name = parameters.silicone;
  same.law = parameters.law;
  try {
    (void)run(same);
    ADD_FAILURE() << "accepted";
  } catch (const io::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("voxels_per_cell = 1"), std::string::npos) << error.what();
  }
  EXPECT_EQ(calls(), 0U);
}

TEST_F(TradeRunTest, SearchesThatAllFailAreANumericalOutcome) {
  add_program("menger-evolve", "echo 'no body is left' >&2\nexit 1\n");
  add_program("menger-export", "exit 0\n");
  io::write_whole(folder_ / "evolve.toml", "preset = \"paper\"\n");
  const TradeResult result =
      run(study("pressure_Pa = 1000\n[search]\nstudy = \"evolve.toml\"\n[voxels]\nnumbers = [\"float64\"]\n"
                "dampings = [\"velocity\"]\ntime_step_fractions = [0.5]\nexclusion_depths = [\"1\"]\n"));
  EXPECT_EQ(result.status, io::RunStatus::not_converged);
  const std::string text = io::read_whole(folder_ / "out/search.txt");
  EXPECT_NE(text.find("0 of 3 searches found a champion"), std::string::npos) << text;
  EXPECT_NE(text.find("seed 2"), std::string::npos) << text;
  EXPECT_NE(text.find("exit code 1: no body is left"), std::string::npos) << text;
  EXPECT_EQ(io::read_csv(folder_ / "out/search.csv").row_count(), 3U);
}

TEST_F(TradeRunTest, ChampionsAreInflatedUpToTheLargestUnknownsOnly) {
  TradeStudy champion = study();
  champion.elements->largest_unknowns = 10.0;
  TradeRunner runner(folder_ / "runs", options_);
  SearchRow row;
  inflate_champion(champion, 1000.0, runner, row);
  EXPECT_EQ(row.element_status, "skipped");
  EXPECT_NE(row.element_reason.find("2964 unknowns"), std::string::npos) << row.element_reason;
  EXPECT_FALSE(row.volume_change);
  EXPECT_EQ(calls(), 0U);
  champion.elements->largest_unknowns = 1e5;
  inflate_champion(champion, 1000.0, runner, row);
  EXPECT_EQ(row.element_status, "completed");
  EXPECT_NEAR(row.extent_change_x_m.value(), 4e-3, 1e-8);  // Q1/P0, one element
}

TEST_F(TradeRunTest, NoFidelityLeftIsWrongInput) {
  EXPECT_THROW((void)run(study("[gait]\n[voxels]\nnumbers = [\"float32\"]\ndampings = [\"increments\"]\n")), io::InputError);
  EXPECT_EQ(calls(), 0U);
}

TEST_F(TradeRunTest, AMissingProgramIsWrongInput) {
  fs::remove(folder_ / "bin/menger-simulate");
  EXPECT_THROW((void)run(study()), io::InputError);
  EXPECT_EQ(calls(), 0U);
}

}  // namespace
}  // namespace menger::evolution
