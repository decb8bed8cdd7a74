#include "evolution/report/export.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "tests/support/earlier_archive.h"
#include "tests/support/paraview_files.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::Outcome;
using test_support::ProgramRun;

/// Programs in a folder of their own, with a small study in it.
class Export : public testing::Test {
 protected:
  [[nodiscard]] Outcome run(const std::string& program, std::vector<std::string> arguments) const {
    return ProgramRun(folder_, fs::path(MENGER_PROGRAM_DIR) / program, std::move(arguments)).wait();
  }

  void evolve(const std::string& archive, const std::string& threads = "2", const std::string& encoding = "fractal",
              const std::string& preset = "paper", const std::string& population = "") const {
    io::write_whole(folder_ / "study.toml",
                    "preset = \"" + preset + "\"\ngenerations = 3\n[population]\nsurvivors = 4\nmutants = 4\n" + population +
                        "[genome]\nencoding = \"" + encoding + "\"\n[body]\nlevels = [1, 2]\n[time]\nduration_s = 0.05\n");
    const Outcome outcome = run("menger-evolve", {"study.toml", "-o", archive, "--threads", threads});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  [[nodiscard]] Outcome export_run(const std::string& archive, const std::string& folder,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{archive, "-o", folder, "--no-pictures", "--record-interval", "0.025"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("menger-export", arguments);
  }

  /// Returns the content of every file under a folder, except the manifest, which has times.
  [[nodiscard]] std::map<std::string, std::string> contents(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == "manifest.json") continue;
      files[fs::relative(entry.path(), folder_ / folder).string()] = io::read_whole(entry.path());
    }
    return files;
  }

  const tests::TestFolder folder_;
};

TEST_F(Export, RefusesADamagedArchiveBeforeItTouchesAnEarlierExport) {
  evolve("run.sqlite");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  const std::string champion = io::read_csv(folder_ / "out/generations.csv").text(3, "champion");
  const auto before = contents("out");
  const std::string manifest = io::read_whole(folder_ / "out/manifest.json");
  SQLite::Database((folder_ / "run.sqlite").string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE individual SET genome = 'no genome' WHERE id = (SELECT parent FROM individual WHERE id = " + champion +
            "); UPDATE individual SET genome = 'no genome' WHERE id = " + champion);
  const Outcome outcome = export_run("run.sqlite", "out", {"--levels", "1"});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_EQ(contents("out"), before);
  EXPECT_EQ(io::read_whole(folder_ / "out/manifest.json"), manifest);
}

TEST_F(Export, WritesTheFittestRobotOfEachNiche) {
  evolve("run.sqlite", "2", "fractal", "paper", "[map_elites]\ncells_per_niche = 5\n");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  const io::CsvContents niches = io::read_csv(folder_ / "out/niches.csv");
  ASSERT_GE(niches.row_count(), 2U) << "bodies of one kind alone";
  std::set<std::vector<double>> kinds;
  double best = 0.0;
  for (std::size_t row = 0; row < niches.row_count(); ++row) {
    const double fewest = niches.number(row, "fewest_cells");
    EXPECT_GE(niches.number(row, "cells"), fewest);
    EXPECT_LT(niches.number(row, "cells"), fewest + 5.0);
    kinds.insert({fewest, niches.number(row, "feet"), niches.number(row, "layers")});
    best = std::max(best, niches.optional_number(row, "fitness_body_lengths").value_or(0.0));
  }
  EXPECT_EQ(kinds.size(), niches.row_count()) << "two robots in a niche";
  const io::CsvContents generations = io::read_csv(folder_ / "out/generations.csv");
  EXPECT_EQ(generations.number(generations.row_count() - 1, "best_fitness_body_lengths"), best);
  evolve("without.sqlite");
  ASSERT_EQ(export_run("without.sqlite", "out", {"--levels", "1"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/niches.csv")) << "of another search";
}

TEST_F(Export, WritesTablesDesignAndSimulationsOfTheChampion) {
  evolve("run.sqlite");
  const Outcome outcome = export_run("run.sqlite", "out", {"--levels", "1", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("differs"), std::string::npos) << outcome.out;
  for (const char* name :
       {"generations.csv", "lineage.csv", "champion.toml", "manifest.json", "level_1/trajectory.csv", "level_1/frames.pvd",
        "level_1/frames/frame_0002.vtu", "level_2/frames.pvd", "level_2/result.toml", "level_2/scene.toml"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  }
  test_support::expect_opens_in_paraview(folder_ / "out");
  EXPECT_TRUE(fs::exists(folder_ / "run.sqlite"));

  const auto archive = evolution::RunArchive::open_to_read(folder_ / "run.sqlite");
  const io::CsvContents generations = io::read_csv(folder_ / "out/generations.csv");
  ASSERT_EQ(generations.row_count(), 4U);
  const auto id = static_cast<std::uint64_t>(generations.number(3, "champion"));
  const evolution::Individual champion = archive.individual(id);
  EXPECT_EQ(meshes::read_design(folder_ / "out/champion.toml").body, champion.phenotype.body);
  // The fitness is the least displacement, and the simulation reproduces that of the search.
  const double first = generations.number(3, "level_1_displacement_body_lengths");
  const double second = generations.number(3, "level_2_displacement_body_lengths");
  EXPECT_EQ(generations.number(3, "best_fitness_body_lengths"), std::min(first, second));
  const io::CsvContents trajectory = io::read_csv(folder_ / "out/level_2/trajectory.csv");
  EXPECT_NEAR(trajectory.number(trajectory.row_count() - 1, "horizontal_displacement_body_lengths"), second, 1e-12);

  const io::CsvContents lineage = io::read_csv(folder_ / "out/lineage.csv");
  EXPECT_FALSE(lineage.optional_number(0, "parent")) << "the eldest has no parent";
  for (std::size_t row = 1; row < lineage.row_count(); ++row) {
    EXPECT_EQ(lineage.number(row, "parent"), lineage.number(row - 1, "individual"));
  }
  EXPECT_EQ(lineage.number(lineage.row_count() - 1, "individual"), static_cast<double>(id));
  EXPECT_EQ(lineage.text(lineage.row_count() - 1, "phenotype"), phenotype_key(champion.phenotype));
}

TEST_F(Export, OfASteadyStateSearchIsThatOfItsReplay) {
  evolve("run.sqlite", "3", "fractal", "paper", "selection = \"steady_state\"\n");
  const Outcome replayed = run("menger-evolve", {"study.toml", "-o", "again.sqlite", "--threads", "1", "--replay", "run.sqlite"});
  ASSERT_EQ(replayed.code, 0) << replayed.err;
  ASSERT_EQ(export_run("run.sqlite", "first", {"--levels", "1"}).code, 0);
  ASSERT_EQ(export_run("again.sqlite", "second", {"--levels", "1"}).code, 0);
  EXPECT_EQ(contents("first"), contents("second"));
  const io::CsvContents generations = io::read_csv(folder_ / "first/generations.csv");
  ASSERT_EQ(generations.row_count(), 4U);
  EXPECT_EQ(generations.number(3, "pruned"), 0.0);
  EXPECT_EQ(generations.number(3, "evaluations") + generations.number(3, "cached"), 2.0 * 5.0) << "two levels of five robots";
  const Outcome timings = export_run("run.sqlite", "timings", {"--levels", "1", "--timings"});
  ASSERT_EQ(timings.code, 0) << timings.err;
  EXPECT_NE(timings.out.find("schedule.csv estimates times of generations that do"), std::string::npos) << timings.out;
}

TEST_F(Export, RefusesToReplayWhatHasNoOrderOrAnother) {
  evolve("run.sqlite");
  const Outcome generational = run("menger-evolve", {"study.toml", "-o", "again.sqlite", "--replay", "run.sqlite"});
  EXPECT_EQ(generational.code, 2);
  EXPECT_NE(generational.err.find("--replay run.sqlite: study.toml: population.selection = \"generational\""), std::string::npos)
      << generational.err;
  evolve("steady.sqlite", "2", "fractal", "paper", "selection = \"steady_state\"\n");
  const Outcome other = run("menger-evolve", {"study.toml", "-o", "again.sqlite", "--seed", "2", "--replay", "steady.sqlite"});
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("--replay steady.sqlite: is the archive of another study than study.toml"), std::string::npos)
      << other.err;
  EXPECT_FALSE(fs::exists(folder_ / "again.sqlite"));
}

TEST_F(Export, ReadsAnEarlierArchive) {
  evolve("run.sqlite");
  ASSERT_EQ(export_run("run.sqlite", "now", {"--levels", "1"}).code, 0);
  std::string study = tests::demo_study_of_version_3;
  const auto change = [&](const std::string& from, const std::string& to) { study.replace(study.find(from), from.size(), to); };
  change("survivors = 15", "survivors = 4");
  change("mutants = 15", "mutants = 4");
  change("duration_s = 2", "duration_s = 0.05");
  tests::make_earlier(folder_ / "run.sqlite", study);
  const Outcome outcome = export_run("run.sqlite", "then", {"--levels", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("differs"), std::string::npos) << outcome.out;
  EXPECT_EQ(contents("then"), contents("now"));
}

TEST_F(Export, TellsADisplacementThatDiffersFromThatOfTheArchive) {
  evolve("run.sqlite");
  {
    SQLite::Database archive((folder_ / "run.sqlite").string(), SQLite::OPEN_READWRITE);
    EXPECT_GT(archive.exec("UPDATE evaluation SET dx_m = 12, dy_m = 0.5, dz_m = -3 WHERE level = 1 AND dx_m IS NOT NULL"), 0);
  }
  const Outcome outcome = export_run("run.sqlite", "out", {"--levels", "1", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("level 1: the displacement differs from that in the archive: ["), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("] m here, [12, 0.5, -3] m there"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("level 2: the displacement differs"), std::string::npos) << outcome.out;
}

TEST_F(Export, HoldsTheChecksOfTheTimeStep) {
  io::write_whole(folder_ / "study.toml",
                  "preset = \"paper\"\ngenerations = 2\n[population]\nsurvivors = 3\nmutants = 3\n[body]\nlevels = [1, 2]\n"
                  "[time]\nduration_s = 0.05\n[check_dt]\nevery = 2\n");
  const Outcome search = run("menger-evolve", {"study.toml", "-o", "run.sqlite"});
  ASSERT_EQ(search.code, 0) << search.err;
  for (const char* line : {"time step check, generation 0, individual ", "time step check, generation 2, individual "})
    EXPECT_NE(search.out.find(line), std::string::npos) << search.out;
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  const io::CsvContents checks = io::read_csv(folder_ / "out/check_dt.csv");
  ASSERT_EQ(checks.row_count(), 4U);
  const io::CsvContents generations = io::read_csv(folder_ / "out/generations.csv");
  for (std::size_t row = 0; row < 4; ++row) {
    const auto generation = static_cast<std::size_t>(checks.number(row, "generation"));
    EXPECT_EQ(checks.number(row, "individual"), generations.number(generation, "champion"));
    EXPECT_EQ(checks.number(row, "score_body_lengths"), generations.number(generation, "best_fitness_body_lengths"));
    EXPECT_EQ(checks.text(row, "half_step_status"), "completed");
    EXPECT_NE(checks.number(row, "change"), 0.0);
  }
}

TEST_F(Export, TellsWhatEvaluationsTookOnRequest) {
  evolve("run.sqlite");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/timings.csv"));
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1", "--individuals", "--timings", "--workers", "1", "3"}).code, 0);
  const io::CsvContents individuals = io::read_csv(folder_ / "out/individuals.csv");
  EXPECT_EQ(individuals.text(0, "level_1_status"), "completed");
  const io::CsvContents timings = io::read_csv(folder_ / "out/timings.csv");
  const std::vector<double> evaluations = io::read_csv(folder_ / "out/generations.csv").numbers("evaluations");
  EXPECT_EQ(static_cast<double>(timings.row_count()), std::accumulate(evaluations.begin(), evaluations.end(), 0.0));
  for (const double seconds : timings.numbers("seconds")) EXPECT_GT(seconds, 0.0);
  EXPECT_EQ(io::read_csv(folder_ / "out/schedule.csv").row_count(), 2U * evaluations.size());
  EXPECT_EQ(export_run("run.sqlite", "out", {"--workers", "0"}).code, 2);
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  for (const char* name : {"individuals.csv", "timings.csv", "schedule.csv"})
    EXPECT_FALSE(fs::exists(folder_ / "out" / name)) << "tables of an earlier export would stand beside newer ones";
}

TEST_F(Export, BestFitnessNeverFalls) {
  evolve("run.sqlite");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  const std::vector<double> best = io::read_csv(folder_ / "out/generations.csv").numbers("best_fitness_body_lengths");
  EXPECT_TRUE(std::ranges::is_sorted(best));
}

TEST_F(Export, BytesDoNotDependOnTheThreadsOfTheSearch) {
  for (const std::string threads : {"1", "2", "8"}) {
    evolve("run_" + threads + ".sqlite", threads);
    ASSERT_EQ(export_run("run_" + threads + ".sqlite", "out_" + threads, {"--levels", "1", "2"}).code, 0);
  }
  const auto expected = contents("out_1");
  EXPECT_GT(expected.size(), 10U);
  EXPECT_EQ(contents("out_2"), expected);
  EXPECT_EQ(contents("out_8"), expected);
}

TEST_F(Export, WholeBodiesOfArrangementsAreDesigns) {
  evolve("run.sqlite", "2", "nonfractal");
  const Outcome outcome = export_run("run.sqlite", "out", {"--levels", "1", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("differs"), std::string::npos) << outcome.out;
  EXPECT_EQ(meshes::read_design(folder_ / "out/champion_level_2.toml").body.nx(), 9);
}

TEST_F(Export, ReleasedCodeHasItsOwnUnit) {
  evolve("run.sqlite", "2", "fractal", "released-code");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  EXPECT_TRUE(io::read_csv(folder_ / "out/generations.csv").has("best_fitness_m2"));
}

TEST_F(Export, MakesPicturesOrSaysWhatIsMissing) {
  evolve("run.sqlite");
  const Outcome outcome = run("menger-export", {"run.sqlite", "-o", "out", "--levels", "1", "--no-frames"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/level_1/frames.pvd"));
  const bool said = outcome.out.find("no pictures") != std::string::npos;
  for (const char* name : {"champion.png", "level_1/robot.png"})
    EXPECT_NE(fs::exists(folder_ / "out" / name), said) << outcome.out;
}

TEST_F(Export, ASecondCallShowsInsteadOfRedoing) {
  evolve("run.sqlite");
  const Outcome first = export_run("run.sqlite", "out");
  ASSERT_EQ(first.code, 0) << first.err;
  const auto before = contents("out");
  const auto written = fs::last_write_time(folder_ / "out/level_1/trajectory.csv");
  const Outcome second = export_run("run.sqlite", "out");
  ASSERT_EQ(second.code, 0) << second.err;
  EXPECT_EQ(fs::last_write_time(folder_ / "out/level_1/trajectory.csv"), written);
  EXPECT_EQ(contents("out"), before);
  EXPECT_NE(second.out.find("already"), std::string::npos) << second.out;
  // The table is the same, and missing files are made again.
  EXPECT_NE(second.out.find(first.out.substr(first.out.find("level "), 200)), std::string::npos) << second.out;
  fs::remove(folder_ / "out/level_2/result.toml");
  ASSERT_EQ(export_run("run.sqlite", "out").code, 0);
  EXPECT_EQ(contents("out"), before);
}

TEST_F(Export, LeavesNothingOfAnotherChampion) {
  evolve("run.sqlite");
  evolve("other.sqlite", "2", "nonfractal");
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1", "2"}).code, 0);
  ASSERT_EQ(export_run("run.sqlite", "out", {"--levels", "1"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/level_2/result.toml")) << "it is of this champion";
  ASSERT_EQ(export_run("other.sqlite", "out", {"--levels", "1"}).code, 0);
  ASSERT_EQ(export_run("other.sqlite", "fresh", {"--levels", "1"}).code, 0);
  EXPECT_EQ(contents("out"), contents("fresh"));
}

TEST_F(Export, RefusesWhatIsNoArchive) {
  EXPECT_EQ(export_run("missing.sqlite", "out").code, 2);
  io::write_whole(folder_ / "text.sqlite", "once upon a time");
  const Outcome text = export_run("text.sqlite", "out");
  EXPECT_EQ(text.code, 2);
  EXPECT_NE(text.err.find("text.sqlite"), std::string::npos) << text.err;
  evolve("cut.sqlite");
  fs::resize_file(folder_ / "cut.sqlite", fs::file_size(folder_ / "cut.sqlite") / 3);
  EXPECT_EQ(export_run("cut.sqlite", "out").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Export, RefusesAFolderThatCannotBeWritten) {
  evolve("run.sqlite");
  io::write_whole(folder_ / "file", "x");
  const Outcome outcome = export_run("run.sqlite", "file/out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("file"), std::string::npos) << outcome.err;
  EXPECT_EQ(io::read_whole(folder_ / "file"), "x");
}

TEST_F(Export, RefusesAnArchiveWithoutGenerations) {
  evolve("run.sqlite");
  const auto archive = evolution::RunArchive::open_to_read(folder_ / "run.sqlite");
  { (void)evolution::RunArchive::open(folder_ / "empty.sqlite", archive.study(), 3); }
  const Outcome outcome = export_run("empty.sqlite", "out");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("no finished generation"), std::string::npos) << outcome.err;
}

TEST_F(Export, RefusesRecordIntervalsThatMakeNoRecords) {
  evolve("run.sqlite");
  for (const char* interval : {"0", "-1", "nan", "1e-12"}) {
    const Outcome outcome = export_run("run.sqlite", "out", {"--record-interval", interval});
    EXPECT_EQ(outcome.code, 2) << interval;
    EXPECT_NE(outcome.err.find("--record-interval"), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Export, RefusesLevelsThatTheBodyDoesNotHave) {
  evolve("run.sqlite", "2", "nonfractal");
  const Outcome outcome = export_run("run.sqlite", "out", {"--levels", "4"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("level 4"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace menger
