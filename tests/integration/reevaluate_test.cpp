// The archive of a search, and menger-reevaluate.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// The program in a folder of its own, with an archive of two robots of silicone.
class ReevaluateProgram : public testing::Test {
 protected:
  ReevaluateProgram() {
    tests::make_archive(folder_ / "run.sqlite", tests::silicone_study(),
                        {"111100000100000000000000000", "111000000000000000000000000"});
  }

  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    return ProgramRun(folder_, MENGER_PROGRAM_DIR "/menger-reevaluate", std::move(arguments)).wait();
  }

  const tests::TestFolder folder_;
};

TEST_F(ReevaluateProgram, EvaluatesDesignsByTheLocomotionOfFiniteElements) {
  // The simulated time ends at the first peak of the pressure.
  io::write_whole(folder_ / "study.toml",
                  "least_body_lengths = 0.001\n[time]\nduration_s = 0.13\nrecord_interval_s = 0.01\nframe_interval_s = 0.05\n"
                  "[elements]\nprecision = \"double\"\n");
  const Outcome outcome = run({"run.sqlite", "--top", "2", "--study", "study.toml", "-o", "out", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
  const io::CsvContents table = io::read_csv(folder_ / "out/reevaluation.csv");
  ASSERT_EQ(table.row_count(), 2U);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(table.text(row, "surrogate_status"), "completed");
    EXPECT_EQ(table.text(row, "elements_status"), "completed") << table.text(row, "elements_reason");
    EXPECT_GT(table.number(row, "elements_dz_m"), 0.0) << "it swells, and so its centre rises";
    EXPECT_GT(table.number(row, "surrogate_dz_m"), 0.0);
  }
  // The bar rises as it does with two layers of mean-dilatation elements (60.1 um; one layer: 47.6). The surrogate's rise is a
  // third less, more than nine of ten displacements of its validation are off (28 %). Along x the bar cannot move, because it is
  // its own mirror image.
  const double rise_m = table.number(1, "elements_dz_m");
  EXPECT_NEAR(rise_m, 60.1e-6, 0.05 * rise_m);
  EXPECT_NEAR(table.number(1, "surrogate_dz_m"), rise_m, 0.5 * rise_m);
  EXPECT_NEAR(table.number(1, "elements_dx_m"), 0.0, 1e-9);
  EXPECT_NEAR(table.number(1, "surrogate_dx_m"), 0.0, 1e-6);
  for (const char* file : {"winner/both.pvd", "winner/voxels_0002.vtu", "ranking.csv", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  test_support::expect_opens_in_paraview(folder_ / "out");
  EXPECT_EQ(evolution::RunArchive::open_to_read(folder_ / "run.sqlite").reevaluations().size(), 2U);

  const Outcome again = run({"run.sqlite", "--top", "2", "--study", "study.toml", "-o", "out", "--no-pictures"});
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.out.find("\n0 runs of finite elements made"), std::string::npos) << again.out;
}

TEST_F(ReevaluateProgram, WrongInputEndsWithTheReason) {
  io::write_whole(folder_ / "study.toml", "depth = 3\n");
  const Outcome outcome = run({"run.sqlite", "--study", "study.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("depth"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"run.sqlite", "--top", "0"}).code, 2);
  EXPECT_EQ(run({"missing.sqlite"}).code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("menger reevaluate run.sqlite --top 5"), std::string::npos) << help.out;
}

TEST(CompareSearchesProgram, SaysWhatItReadAndRefusesTheFolderOfAnotherCommand) {
  const tests::TestFolder folder;
  io::write_whole(folder / "search/costs.csv", "generation,voxel_steps,element_steps\n0,1000,0\n");
  io::write_whole(folder / "search/reevaluation.csv",
                  "rank,surrogate_body_lengths,elements_body_lengths,elements_steps,elements_count\n1,0.5,0.1,10,10\n");
  const auto compare = [&](const std::string& out) {
    return ProgramRun(folder, MENGER_PROGRAM_DIR "/menger-compare-searches", {"search", "-o", out, "--no-pictures"}).wait();
  };
  io::write_whole(folder / "out/comparison.png", "of an earlier run");
  const Outcome outcome = compare("out");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "out/comparison.png")) << "it would pass for one of this run";
  const std::string manifest = io::read_whole(folder / "out/manifest.json");
  for (const char* part :
       {"menger-compare-searches", "search/costs.csv", "search/reevaluation.csv", "voxel_steps_per_element_step"})
    EXPECT_NE(manifest.find(part), std::string::npos) << manifest;
  fs::rename(folder / "search", folder / "other");
  EXPECT_EQ(compare("out").code, 2);
  EXPECT_TRUE(fs::exists(folder / "out/comparison.csv")) << "wrong input removes nothing";
  fs::rename(folder / "other", folder / "search");
  io::write_whole(folder / "walk/manifest.json", R"({"program": "menger-simulate"})");
  const Outcome refused = compare("walk");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("walk: holds results of menger simulate"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace menger
