#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/load_case.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "voxel/model/surrogate_file.h"
#include "voxel/statics/load_case_response.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with a hollow cube of 98 elements.
class TradeoffProgram : public testing::Test {
 protected:
  TradeoffProgram() {
    io::write_whole(folder_ / "cube.toml", "name = \"cube\"\ncell_edge_m = 0.02\nlayers = [[\"1\"]]\n");
    io::write_whole(folder_ / "study.toml",
                    "pressure_Pa = 3000\n[design]\nfile = \"cube.toml\"\nwall_thickness_m = 0.004\n"
                    "[finite_elements]\nthin_walls = []\ndegrees = [1, 2]\nelements_through_wall = [1]\n");
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-tradeoff", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(TradeoffProgram, ComparesTwoFidelitiesOfACubeAndRepeatsNothing) {
  const Outcome outcome = run({"study.toml", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 runs made"), std::string::npos) << outcome.out;
  const io::CsvContents table = io::read_csv(folder_ / "out/tradeoff.csv");
  ASSERT_EQ(table.row_count(), 2U);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(table.text(row, "status"), "completed");
    EXPECT_GT(table.number(row, "volume_change"), 0.0);
    // a free cube grows equally along all axes
    EXPECT_NEAR(table.number(row, "extent_change_x_m"), table.number(row, "extent_change_y_m"), 1e-9);
    EXPECT_NEAR(table.number(row, "extent_change_x_m"), table.number(row, "extent_change_z_m"), 1e-9);
    EXPECT_GT(table.number(row, "peak_memory_MB"), 10.0);
  }
  // 6^3 nodes without 2^3 inside the chamber, or with middles 11^3 without 5^3: the solver has as many as were counted
  EXPECT_EQ(table.number(0, "unknowns"), 3.0 * (6 * 6 * 6 - 2 * 2 * 2));
  EXPECT_EQ(table.number(1, "unknowns"), 3.0 * (11 * 11 * 11 - 5 * 5 * 5));
  const double coarse = table.number(0, "extent_change_z_m");
  const double fine = table.number(1, "extent_change_z_m");
  EXPECT_NEAR(table.number(0, "extent_change_z_m_relative_error"), std::abs(coarse - fine) / fine, 1e-12);
  EXPECT_EQ(table.text(1, "role").substr(0, 9), "reference");
  EXPECT_TRUE(fs::exists(folder_ / "out/manifest.json"));

  const Outcome again = run({"study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("0 runs made"), std::string::npos) << again.out;
}

TEST_F(TradeoffProgram, RefusalLeavesTheResultsOfAnEarlierRunWhole) {
  ASSERT_EQ(run({"study.toml", "-o", "out", "--no-pictures"}).code, 0);
  fs::create_directory(folder_ / "empty");
  const Outcome outcome = run({"study.toml", "-o", "out", "--programs", "empty"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("there is no such program"), std::string::npos) << outcome.err;
  for (const char* name : {"manifest.json", "tradeoff.csv", "recommendation.txt"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
}

TEST_F(TradeoffProgram, ASettledCellOfVoxelsIsWithinATenthOfFiniteElements) {
  // The pressure is in the middle of the range of the fit. The fit weighs residuals by the largest value of a curve, so at small
  // pressures the same residual is a larger relative error. The body is free in both models, so that only the models differ. It
  // is Q2/P1, because with one element through the wall Q1/P0 itself has an error of a quarter.
  io::write_whole(folder_ / "cell.toml", "name = \"cell\"\ncell_edge_m = 0.01\nlayers = [[\"1\"]]\n");
  io::write_whole(folder_ / "settled.toml",
                  "pressure_Pa = 20000\n[design]\nfile = \"cell.toml\"\n[finite_elements]\nthin_walls = []\ndegrees = "
                  "[2]\nelements_through_wall = [1]\n"
                  "[voxels]\nnumbers = [\"float64\"]\ndampings = [\"velocity\"]\ntime_step_fractions = [0.9]\n"
                  "exclusion_depths = [\"off\"]\n[settling]\nparameters = [\"" MENGER_PARAMETERS "\"]\n");
  const Outcome outcome = run({"settled.toml", "-o", "settled", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents table = io::read_csv(folder_ / "settled/tradeoff.csv");
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.text(1, "model"), "voxels");
  EXPECT_EQ(table.text(1, "status"), "completed") << table.text(1, "reason");
  EXPECT_EQ(table.text(1, "validity"), "inside") << table.text(1, "reason");
  for (const char* observable : {"volume_change", "extent_change_x_m", "extent_change_y_m", "extent_change_z_m"})
    EXPECT_NEAR(table.number(1, observable) / table.number(0, observable), 1.0, 0.1) << observable;
}

TEST_F(TradeoffProgram, ASettledBarIsWhereItsParametersPutIt) {
  // Compares the equilibrium by Newton's method with the frames of a run that settles. Both are the same model; the tolerance of
  // 0.5 % is for a run that is not quite at rest. The end voxels bulge to one side only.
  io::write_whole(folder_ / "bar.toml", "name = \"bar\"\ncell_edge_m = 0.01\nlayers = [[\"11\"]]\n");
  io::write_whole(folder_ / "settled.toml",
                  "pressure_Pa = 6000\n[design]\nfile = \"bar.toml\"\n[finite_elements]\nthin_walls = []\ndegrees = "
                  "[1]\nelements_through_wall = [1]\n"
                  "[voxels]\nnumbers = [\"float64\"]\ndampings = [\"velocity\"]\ntime_step_fractions = [0.9]\n"
                  "exclusion_depths = [\"off\"]\n[settling]\nparameters = [\"" MENGER_PARAMETERS
                  "\", \"" MENGER_REFINED_PARAMETERS "\"]\n");
  const Outcome outcome = run({"settled.toml", "-o", "settled", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents table = io::read_csv(folder_ / "settled/tradeoff.csv");
  ASSERT_EQ(table.row_count(), 3U);

  meshes::LoadCase inflation;
  inflation.name = "bar";
  inflation.cells = {2, 1, 1};
  inflation.digits = "11";
  inflation.cell_edge_m = 0.01;
  inflation.wall_thickness_m = 0.002;
  inflation.pressures_Pa = {6000.0};
  const std::vector<std::pair<std::string, std::string>> columns{{"volume_change", "volume_change"},
                                                                 {"extent_x_m", "extent_change_x_m"},
                                                                 {"extent_y_m", "extent_change_y_m"},
                                                                 {"extent_z_m", "extent_change_z_m"}};
  for (const std::size_t row : {1U, 2U}) {  // one voxel along the edge of a cell, and two
    ASSERT_EQ(table.text(row, "status"), "completed") << table.text(row, "reason");
    const char* const parameters = table.number(row, "voxels_per_cell") == 1.0 ? MENGER_PARAMETERS : MENGER_REFINED_PARAMETERS;
    const voxel::LoadCaseResponse expected = voxel::respond(voxel::read_surrogate(parameters), inflation);
    ASSERT_EQ(expected.status, io::RunStatus::completed) << expected.reason;
    for (const auto& [of_parameters, of_trade] : columns) {
      const auto place = std::ranges::find(expected.columns, of_parameters) - expected.columns.begin();
      const double value = expected.values.at(static_cast<std::size_t>(place)).front();
      EXPECT_NEAR(table.number(row, of_trade) / value, 1.0, 0.005) << of_trade << " in row " << row;
    }
  }
}

TEST_F(TradeoffProgram, ParametersOfAnotherCellEndWithTwo) {
  io::write_whole(
      folder_ / "settled.toml",
      "[design]\nfile = \"cube.toml\"\n[finite_elements]\nthin_walls = []\n[settling]\nparameters = [\"" MENGER_PARAMETERS
      "\"]\n");
  const Outcome outcome = run({"settled.toml", "-o", "settled"});
  EXPECT_EQ(outcome.code, 2);
  for (const char* word : {"dragon_skin_10_1cm.toml", "cell_edge_m", "0.01", "0.02"})
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "settled"));
}

TEST_F(TradeoffProgram, RunsItsOwnTemplate) {
  const Outcome outcome = run({"--template"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  io::write_whole(folder_ / "template.toml", outcome.out);
  const Outcome trade = run({"template.toml", "-o", "template", "--no-pictures"});
  EXPECT_EQ(trade.code, 0) << trade.err;
  EXPECT_EQ(io::read_csv(folder_ / "template/gait.csv").row_count(), 27U) << trade.out;
}

TEST_F(TradeoffProgram, WrongInputEndsWithTwoAndNamesIt) {
  EXPECT_EQ(run({}).code, 2);
  EXPECT_EQ(run({"study.toml", "--search", "study.toml"}).code, 2);
  const Outcome missing = run({"missing.toml"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_NE(missing.err.find("missing.toml"), std::string::npos);
  const Outcome searchless = run({"--search", "study.toml"});
  EXPECT_EQ(searchless.code, 2);
  EXPECT_NE(searchless.err.find("[search]"), std::string::npos);
  const Outcome alone = run({"study.toml", "--programs", folder_.path().string()});
  EXPECT_EQ(alone.code, 2);
  EXPECT_NE(alone.err.find("menger-inflate"), std::string::npos);
  EXPECT_EQ(run({"--help"}).code, 0);
}

}  // namespace
}  // namespace menger
