// A search whose robots walk on finite elements: menger-evolve, menger-export and menger-reevaluate.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/search/search_plan.h"
#include "evolution/study/half_walk_evaluator.h"
#include "evolution/study/study_file.h"
#include "evolution/study/walk_evaluator.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "tests/support/archive_content.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger {
namespace {

namespace fs = std::filesystem;
using test_support::archive_content;
using test_support::Outcome;
using test_support::ProgramRun;

/// Returns the line that names the champion.
std::string champion_line(const std::string& out) {
  const std::size_t start = out.find("Champion: ");
  return start == std::string::npos ? "" : out.substr(start, out.find('\n', start) - start);
}

class EvolveOnElements : public testing::Test {
 protected:
  EvolveOnElements() { io::write_whole(folder_ / "study.toml", tests::walking_study_text()); }

  [[nodiscard]] ProgramRun start(const std::string& program, std::vector<std::string> arguments) const {
    return {folder_, fs::path(MENGER_PROGRAM_DIR) / ("menger-" + program), std::move(arguments)};
  }
  [[nodiscard]] Outcome run(const std::string& program, std::vector<std::string> arguments) const {
    return start(program, std::move(arguments)).wait();
  }
  [[nodiscard]] Outcome export_to(const std::string& archive, const std::string& folder) const {
    return run("export", {archive, "-o", folder, "--no-pictures", "--no-frames"});
  }

  /// Returns what was exported, by file, without wall times: manifests, checkpoints and lines of `seconds`.
  [[nodiscard]] std::map<std::string, std::string> exported(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      const fs::path& file = entry.path();
      if (!entry.is_regular_file() || file.filename() == "manifest.json" || file.extension() == ".checkpoint") continue;
      std::istringstream all(io::read_whole(file));
      std::string kept;
      for (std::string line; std::getline(all, line);)
        if (line.rfind("seconds = ", 0) != 0) kept += line + "\n";
      files[fs::relative(file, folder_ / folder).string()] = kept;
    }
    return files;
  }

  const tests::TestFolder folder_;
};

TEST_F(EvolveOnElements, TheChampionOfASearchIsExportedAndWalksOnFinerElements) {
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"note: the damping of Dragon Skin 10 is not measured", "note: friction of Dragon Skin 10",
                            "Champion: individual", "menger reevaluate run.sqlite"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out << "\ndoes not say: " << words;
  const std::string manifest = io::read_whole(folder_ / "run.manifest.json");
  EXPECT_NE(manifest.find("dragon_skin_10.toml"), std::string::npos) << "the silicone is an input";
  EXPECT_NE(manifest.find("study.toml"), std::string::npos);

  const Outcome levels = run("export", {"run.sqlite", "-o", "levels", "--levels", "1", "2"});
  EXPECT_EQ(levels.code, 2);
  EXPECT_NE(levels.err.find("--levels 2"), std::string::npos) << levels.err;
  EXPECT_FALSE(fs::exists(folder_ / "levels/generations.csv"));
  const Outcome out = export_to("run.sqlite", "out");
  ASSERT_EQ(out.code, 0) << out.err;
  EXPECT_NE(out.out.find("only level 1 is written"), std::string::npos) << out.out;
  EXPECT_EQ(out.out.find("differs from that in the archive"), std::string::npos) << out.out;
  const io::CsvContents costs = io::read_csv(folder_ / "out/costs.csv");
  EXPECT_GT(costs.number(0, "element_steps"), 1e5);
  EXPECT_EQ(costs.number(0, "voxel_steps"), 0.0);
  EXPECT_GT(io::read_csv(folder_ / "out/level_1/trajectory.csv").row_count(), 50U);

  const io::CsvContents periods = io::read_csv(folder_ / "out/periods.csv");
  ASSERT_EQ(periods.row_count(), 2U);
  const io::CsvContents walk = io::read_csv(folder_ / "out/level_1/trajectory.csv");
  const std::size_t last = walk.row_count() - 1;
  EXPECT_NEAR(periods.number(0, "dx_m") + periods.number(1, "dx_m"),
              walk.number(last, "centre_of_mass_x_m") - walk.number(0, "centre_of_mass_x_m"), 1e-15);

  // The study that was exported gives the same walk.
  const Outcome walked = run("locomote", {"out/champion_walk.toml", "-o", "walked", "--no-pictures", "--quiet"});
  ASSERT_EQ(walked.code, 0) << walked.err;
  EXPECT_EQ(io::read_whole(folder_ / "walked/trajectory.csv"), io::read_whole(folder_ / "out/level_1/trajectory.csv"));

  io::write_whole(folder_ / "finer.toml", "[elements]\nfidelity = \"standard\"\n");
  const Outcome finer = run("reevaluate", {"run.sqlite", "--top", "2", "--study", "finer.toml", "-o", "finer", "--no-pictures"});
  ASSERT_EQ(finer.code, 0) << finer.err;
  EXPECT_NE(finer.out.find("search     elements"), std::string::npos) << finer.out;
  const io::CsvContents table = io::read_csv(folder_ / "finer/reevaluation.csv");
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.text(0, "elements_status"), "completed");
  EXPECT_NEAR(table.number(0, "surrogate_body_lengths"), table.number(0, "fitness_body_lengths"), 1e-12)
      << "the search's own walk, made again";
  EXPECT_GT(table.number(0, "elements_count"), 0.0);
}

// Aggregates of at most four modules of at most four cells each.
TEST_F(EvolveOnElements, AggregatesOfFewModulesAreEvolvedConfirmedAndExported) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("levels = [1]"), 12, "levels = [2]\nlargest_body_cells = 4");
  text.replace(text.find("generations = 2"), 15, "generations = 1");
  io::write_whole(folder_ / "aggregates.toml", text);
  ASSERT_EQ(run("evolve", {"aggregates.toml", "--threads", "2", "-o", "aggregates.sqlite"}).code, 0);
  const Outcome confirmed = run("confirm", {"aggregates.sqlite", "aggregates.toml", "--top", "1", "-o", "confirmed.csv"});
  ASSERT_EQ(confirmed.code, 0) << confirmed.err;
  const io::CsvContents table = io::read_csv(folder_ / "confirmed.csv");
  ASSERT_EQ(table.row_count(), 1U);
  EXPECT_LE(table.number(0, "cells"), 4.0);
  EXPECT_NEAR(table.number(0, "score_body_lengths"), table.number(0, "fitness_body_lengths"), 1e-12) << "the same walk again";
  const Outcome modules = run("confirm", {"aggregates.sqlite", "study.toml", "--top", "1", "-o", "modules.csv"});
  EXPECT_EQ(modules.code, 2);
  EXPECT_NE(modules.err.find("body.levels: must be those of the archive, [2]"), std::string::npos) << modules.err;

  const Outcome out = export_to("aggregates.sqlite", "aggregates");
  ASSERT_EQ(out.code, 0) << out.err;
  EXPECT_NE(out.out.find("only level 2 is written"), std::string::npos) << out.out;
  EXPECT_EQ(out.out.find("differs from that in the archive"), std::string::npos) << out.out;
  EXPECT_TRUE(fs::exists(folder_ / "aggregates/level_2/trajectory.csv"));
  const Outcome walked = run("locomote", {"aggregates/champion_walk.toml", "-o", "walked", "--no-pictures", "--quiet"});
  ASSERT_EQ(walked.code, 0) << walked.err;
  EXPECT_EQ(io::read_whole(folder_ / "walked/trajectory.csv"), io::read_whole(folder_ / "aggregates/level_2/trajectory.csv"));
}

TEST_F(EvolveOnElements, IsTheSameForTwoThreadsAndAfterAKill) {
  const std::string longer = "0.2";  // s, so that a search takes a second or two
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite", "--duration", longer}).code, 0);
  for (const int signal : {SIGINT, SIGKILL}) {
    const std::string name = "ended_" + std::to_string(signal);
    const std::vector<std::string> arguments{"study.toml", "--threads", "1", "-o", name + ".sqlite", "--duration", longer};
    const ProgramRun running = start("evolve", arguments);
    while (!fs::exists(folder_ / (name + ".sqlite"))) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    running.send(signal);
    const Outcome ended = running.wait();
    if (signal == SIGINT) {
      EXPECT_EQ(ended.code, 130) << ended.out << ended.err;
    } else {
      EXPECT_EQ(ended.signal, SIGKILL);
    }
    ASSERT_EQ(run("evolve", arguments).code, 0);
    EXPECT_EQ(archive_content(folder_ / (name + ".sqlite")), archive_content(folder_ / "two.sqlite")) << signal;
    ASSERT_EQ(export_to(name + ".sqlite", name).code, 0);
  }
  ASSERT_EQ(export_to("two.sqlite", "two").code, 0);
  const std::map<std::string, std::string> expected = exported("two");
  EXPECT_TRUE(expected.contains("level_1/trajectory.csv"));
  EXPECT_EQ(exported("ended_" + std::to_string(SIGINT)), expected);
  EXPECT_EQ(exported("ended_" + std::to_string(SIGKILL)), expected);
}

TEST_F(EvolveOnElements, StopsWithinASecond) {
  const ProgramRun running = start("evolve", {"study.toml", "--threads", "2", "--duration", "100"});
  while (!fs::exists(folder_ / "run.sqlite")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto told = std::chrono::steady_clock::now();
  running.send(SIGINT);
  EXPECT_EQ(running.wait().code, 130);
  EXPECT_LT(std::chrono::steady_clock::now() - told, std::chrono::seconds(1));
}

TEST_F(EvolveOnElements, VoxelsScreenAndFiniteElementsDecide) {
  io::write_whole(
      folder_ / "study.toml",
      "preset = \"paper\"\ngenerations = 3\n[population]\nsurvivors = 4\nmutants = 8\n"
      "[evaluation]\nmodel = \"both\"\nstand = true\nconfirm = 0\nleast_passing_share = 0.1\n"
      "[body]\nlevels = [1]\ncastable = true\n[time]\nduration_s = 0.05\n[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
      "/voxel/parameters/dragon_skin_10_1cm.toml\"\noutside_range = \"warn\"\n"
      "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 40\n");
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1", "-o", "one.sqlite"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"generation 0: 4 of 4 pass the surrogate; no rank correlation yet",
                            "pass the surrogate; rank correlation so far", "Champion: individual"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out << "\ndoes not say: " << words;
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "one.sqlite"), archive_content(folder_ / "two.sqlite"));
  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(folder_ / "one.sqlite");
  EXPECT_EQ(archive.screened_individuals().size(), 4U + 3U * 9U);
  const evolution::Study study = evolution::archived_study(archive);
  const std::string elements = io::content_hash(evolution::WalkEvaluator(study).physics());
  const auto design_of = [&](const evolution::ScreenedIndividual& one) {
    return design_hash(as_simulated(study.search, archive.individual(one.id).phenotype), 1);
  };
  std::set<std::string> passed;
  std::set<std::string> left_out;
  for (const evolution::ScreenedIndividual& one : archive.screened_individuals())
    (one.outcome == evolution::Screened::left_out ? left_out : passed).insert(design_of(one));
  EXPECT_FALSE(left_out.empty());
  for (const std::string& design : passed) EXPECT_TRUE(archive.evaluation({design, 1, elements})) << design;
  for (const std::string& design : left_out)
    EXPECT_EQ(archive.evaluation({design, 1, elements}).has_value(), passed.contains(design)) << design;
  ASSERT_EQ(export_to("one.sqlite", "out").code, 0);
  const io::CsvContents costs = io::read_csv(folder_ / "out/costs.csv");
  EXPECT_GT(costs.number(0, "element_steps"), 0.0);
  EXPECT_GT(costs.number(0, "voxel_steps"), 0.0);
  EXPECT_EQ(run("reevaluate", {"one.sqlite", "--top", "1", "-o", "again", "--no-pictures"}).code, 0);
}

TEST_F(EvolveOnElements, WalksEndAfterTheirFirstHalfUnlessTheyRankHigh) {
  const auto study_with = [](const std::string& evaluation, const std::string& more) {
    std::string text = tests::walking_study_text("measure = \"last_periods\"\n" + evaluation, "", more);
    text.replace(text.find("duration_s = 0.05"), 17, "duration_s = 0.15");
    text.replace(text.find("survivors = 3\nmutants = 3"), 25, "survivors = 6\nmutants = 8");
    return text;
  };
  const std::string halved = "shorter_walks = true\nleast_passing_share = 0.1\n";
  for (const std::string more : {"", "[robust]\nfrictions = [0.4, 1.2]\nloss_factors = [0.1]\n"}) {
    const std::string name = more.empty() ? "one" : "robust";
    io::write_whole(folder_ / "study.toml", study_with(halved, more));
    const Outcome outcome = run("evolve", {"study.toml", "--threads", "1", "-o", name + ".sqlite"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("go on after the first half of their walk"), std::string::npos) << outcome.out;
    ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", name + "_two.sqlite"}).code, 0);
    const std::string expected = archive_content(folder_ / (name + "_two.sqlite"));
    EXPECT_EQ(archive_content(folder_ / (name + ".sqlite")), expected);
    for (const int ms : more.empty() ? std::vector{150, 500} : std::vector{150}) {
      const std::string ended = name + "_ended_" + std::to_string(ms);
      const ProgramRun running = start("evolve", {"study.toml", "--threads", "1", "-o", ended + ".sqlite"});
      while (!fs::exists(folder_ / (ended + ".sqlite"))) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(ms));
      running.send(SIGKILL);
      EXPECT_EQ(running.wait().signal, SIGKILL);
      ASSERT_EQ(run("evolve", {"study.toml", "--threads", "1", "-o", ended + ".sqlite"}).code, 0);
      EXPECT_EQ(archive_content(folder_ / (ended + ".sqlite")), expected) << "walks that had paused begin anew";
      ASSERT_EQ(export_to(ended + ".sqlite", ended).code, 0);
    }
    ASSERT_EQ(export_to(name + ".sqlite", name).code, 0);
    EXPECT_EQ(io::read_whole(folder_ / name / "costs.csv"), io::read_whole(folder_ / (name + "_ended_150") / "costs.csv"));
  }

  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(folder_ / "one.sqlite");
  const evolution::Study study = evolution::archived_study(archive);
  const std::string whole_walks = io::content_hash(evolution::WalkEvaluator(study).physics());
  const std::string half_walks = io::content_hash(evolution::HalfWalkEvaluator(study, nullptr).physics());
  std::uint64_t left_out = 0;
  std::map<int, double> cost;  // by generation; a walk that went on is counted once
  std::set<std::string> seen;
  for (const evolution::ScreenedIndividual& one : archive.screened_individuals()) {
    const std::string design = design_hash(as_simulated(study.search, archive.individual(one.id).phenotype), 1);
    const auto half = archive.evaluation({design, 1, half_walks});
    const auto whole = archive.evaluation({design, 1, whole_walks});
    ASSERT_TRUE(half);
    if (one.outcome == evolution::Screened::left_out) ++left_out;
    if (one.outcome != evolution::Screened::left_out) {
      ASSERT_TRUE(whole);
    }
    if (!seen.insert(design).second) continue;
    const auto steps_of = [&](const auto& walk) { return static_cast<double>(walk->result.steps * half->result.elements); };
    if (!whole || whole->generation != half->generation) cost[half->generation] += steps_of(half);
    if (whole) cost[whole->generation] += steps_of(whole);
    if (whole && whole->result.displacement_m) {
      EXPECT_GT(static_cast<double>(whole->result.steps), 1.9 * static_cast<double>(half->result.steps));
    }
    if (whole && half->result.status == io::RunStatus::diverged) {
      EXPECT_EQ(whole->result.steps, half->result.steps) << "it cannot go on";
    }
  }
  EXPECT_GT(left_out, 0U);
  const io::CsvContents costs = io::read_csv(folder_ / "one/costs.csv");
  for (std::size_t row = 0; row < costs.row_count(); ++row)
    EXPECT_EQ(costs.number(row, "element_steps"), cost[static_cast<int>(row)]) << row;
  for (const evolution::PoolMember& member : archive.pool(*archive.last_generation())) {
    if (!member.fitness) continue;
    const auto whole =
        archive.evaluation({design_hash(as_simulated(study.search, archive.individual(member.id).phenotype), 1), 1, whole_walks});
    ASSERT_TRUE(whole);
    EXPECT_EQ(*member.fitness, evolution::level_score(study.search, *whole->result.displacement_m, 1)) << "of whole walks alone";
  }
}

TEST_F(EvolveOnElements, RobustRobotsWalkInEveryScenarioOrCannotSurvive) {
  io::write_whole(folder_ / "study.toml",
                  tests::walking_study_text("", "", "[robust]\nfrictions = [0.4, 1.2]\nloss_factors = [0.059, 0.146]\n"));
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1", "-o", "one.sqlite"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("up to 4 scenarios, of which the worst is its score"), std::string::npos) << outcome.out;
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "one.sqlite"), archive_content(folder_ / "two.sqlite"));
  const ProgramRun running = start("evolve", {"study.toml", "--threads", "1", "-o", "ended.sqlite"});
  while (!fs::exists(folder_ / "ended.sqlite")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  running.send(SIGKILL);
  EXPECT_EQ(running.wait().signal, SIGKILL);
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "1", "-o", "ended.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "ended.sqlite"), archive_content(folder_ / "two.sqlite"));

  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(folder_ / "one.sqlite");
  const std::vector<evolution::ArchivedScenario> scenarios = archive.scenarios();
  ASSERT_EQ(scenarios.size(), 4U);
  EXPECT_EQ(scenarios[2].text, "friction = 1.2, loss_factor = 0.059");
  ASSERT_EQ(export_to("one.sqlite", "out").code, 0);
  const io::CsvContents table = io::read_csv(folder_ / "out/scenarios.csv");
  ASSERT_GE(table.row_count(), 4U);
  double worst = table.number(0, "body_lengths");
  double decided = -1.0;
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(table.text(row, "individual"), table.text(0, "individual"));
    worst = std::min(worst, table.number(row, "body_lengths"));
    if (table.number(row, "decides") == 1.0) decided = table.number(row, "body_lengths");
  }
  EXPECT_EQ(worst, table.number(0, "fitness_body_lengths"));
  EXPECT_EQ(decided, worst);
  // The champion is shown in the scenario that decides.
  const io::CsvContents walk = io::read_csv(folder_ / "out/level_1/trajectory.csv");
  EXPECT_NEAR(walk.number(walk.row_count() - 1, "horizontal_displacement_body_lengths"), worst, 1e-9);
  EXPECT_EQ(run("reevaluate", {"one.sqlite", "--top", "1", "-o", "again", "--no-pictures"}).code, 0);
}

TEST_F(EvolveOnElements, SearchInWhichEveryRobotFailsIsANumericalOutcome) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("[0, 6000]"), 9, "[0, 6000000]");
  io::write_whole(folder_ / "study.toml", text);
  const Outcome outcome = run("evolve", {"study.toml"});
  EXPECT_EQ(outcome.code, 3) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("No design has a fitness: every evaluation failed"), std::string::npos) << outcome.out;
  EXPECT_EQ(run("evolve", {"study.toml"}).code, 3) << "also when it is finished already";
}

TEST_F(EvolveOnElements, TheBestAreConfirmedOnFinerElements) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("confirm = 0"), 11, "confirm = 2");
  io::write_whole(folder_ / "study.toml", text);
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("The best robots on finer elements [body lengths]:"), std::string::npos) << outcome.out;
  const io::CsvContents table = io::read_csv(folder_ / "run.confirmed.csv");
  ASSERT_EQ(table.row_count(), 4U);
  EXPECT_EQ(table.text(0, "fidelity"), "standard");
  EXPECT_EQ(table.text(1, "fidelity"), "fine");
  EXPECT_GE(table.number(0, "fitness_body_lengths"), table.number(2, "fitness_body_lengths"));
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), archive_content(folder_ / "two.sqlite"));
  EXPECT_EQ(io::read_whole(folder_ / "run.confirmed.csv"), io::read_whole(folder_ / "two.confirmed.csv"));
  ASSERT_EQ(export_to("run.sqlite", "out").code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "out/confirmed.csv"), io::read_whole(folder_ / "run.confirmed.csv"));
  // A search that is finished already is confirmed, too.
  fs::remove(folder_ / "run.confirmed.csv");
  ASSERT_EQ(run("evolve", {"study.toml"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "two.confirmed.csv"), io::read_whole(folder_ / "run.confirmed.csv"));
}

TEST_F(EvolveOnElements, ARobotThatFallsOnFinerElementsIsNotTheChampion) {
  std::string text = tests::walking_study_text();
  io::write_whole(folder_ / "study.toml", text);
  ASSERT_EQ(run("evolve", {"study.toml"}).code, 0);
  {
    evolution::RunArchive archive = evolution::RunArchive::open_to_extend(folder_ / "run.sqlite");
    evolution::Study finer = evolution::archived_study(archive);
    const evolution::FitDesign best = archive.fit_designs().front();
    finer.silicone.elements.fidelity = fem::Fidelity::standard;
    evolution::Reevaluation fall{.design_hash = design_hash(as_simulated(finer.search, best.phenotype), 1),
                                 .level = 1,
                                 .protocol = evolution::WalkEvaluator(finer).physics(),
                                 .variant = "confirmed on standard elements",
                                 .duration_s = finer.duration_s,
                                 .result = {}};
    fall.result.status = io::RunStatus::fell;
    fall.result.reason = "it falls over";
    fall.result.left_out_m = {0.01, 0.0, 0.0};
    archive.add_reevaluations({&fall, 1});
  }
  text.replace(text.find("confirm = 0"), 11, "confirm = 2");
  io::write_whole(folder_ / "study.toml", text);
  const Outcome confirmed = run("evolve", {"study.toml"});
  ASSERT_EQ(confirmed.code, 0) << confirmed.err;
  const io::CsvContents table = io::read_csv(folder_ / "run.confirmed.csv");
  ASSERT_EQ(table.row_count(), 4U);
  EXPECT_EQ(table.text(0, "reason"), "it falls over");
  const std::string second = table.text(2, "individual");
  ASSERT_NE(table.text(0, "individual"), second);
  EXPECT_NE(confirmed.out.find("Champion: individual " + second + ","), std::string::npos) << confirmed.out;

  const Outcome exported = export_to("run.sqlite", "out");
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(exported.out.find("Champion: individual " + second + ","), std::string::npos) << exported.out;
  // Both programs, and a search that is finished already, say in one line why the best robot of the search is not the champion.
  const std::string line = champion_line(confirmed.out);
  for (const char* words : {"; number 2 of the search: ", "it comes before number 1 of the search (individual ",
                            "no walk on standard elements (it falls over)"})
    EXPECT_NE(line.find(words), std::string::npos) << line << "\ndoes not say: " << words;
  EXPECT_EQ(champion_line(exported.out), line);
  EXPECT_EQ(champion_line(run("evolve", {"study.toml"}).out), line);
  const Outcome again = run("reevaluate", {"run.sqlite", "--top", "2", "-o", "again", "--no-pictures"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("winner/ has rank 2"), std::string::npos) << again.out;
  EXPECT_EQ(meshes::read_design(folder_ / "again/winner/design.toml").body.digits(),
            meshes::read_design(folder_ / "out/champion.toml").body.digits());
  EXPECT_EQ(io::read_csv(folder_ / "again/reevaluation.csv").text(1, "individual"), second);
}

TEST_F(EvolveOnElements, SaysHowManyBodiesWereRefused) {
  std::string text = tests::walking_study_text();
  text.replace(text.find("castable = true"), 15, "castable = false");
  io::write_whole(folder_ / "study.toml", text);
  const Outcome outcome = run("evolve", {"study.toml", "--seed", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Outcome exported = export_to("run.sqlite", "out");
  ASSERT_EQ(exported.code, 0) << exported.err;
  const std::size_t count = io::read_csv(folder_ / "out/refused.csv").row_count();
  ASSERT_GT(count, 0U) << "the seed makes no body that finite elements refuse";
  for (const std::string& out : {outcome.out, exported.out, run("evolve", {"study.toml", "--seed", "2"}).out}) {
    EXPECT_NE(out.find("note: finite elements refused " + std::to_string(count) + " of "), std::string::npos) << out;
    EXPECT_NE(out.find("refused.csv"), std::string::npos) << out;
  }
}

TEST_F(EvolveOnElements, ABudgetEndsASearchAtACountedCost) {
  const auto with_budget = [&](const std::string& budget) {
    std::string text = tests::walking_study_text("", "", budget);
    text.replace(text.find("generations = 2"), 15, "generations = 9");
    io::write_whole(folder_ / "study.toml", text);
  };
  const auto costs = [&](const std::string& name) {
    EXPECT_EQ(export_to(name + ".sqlite", name).code, 0);
    const io::CsvContents table = io::read_csv(folder_ / name / "costs.csv");
    std::vector<double> sums;
    for (std::size_t row = 0; row < table.row_count(); ++row)
      sums.push_back((sums.empty() ? 0.0 : sums.back()) + table.number(row, "element_steps"));
    return sums;
  };
  with_budget("");
  ASSERT_EQ(run("evolve", {"study.toml", "-o", "whole.sqlite"}).code, 0);
  const std::vector<double> whole = costs("whole");
  ASSERT_EQ(whole.size(), 10U);
  // The third generation begins within the budget and ends beyond it.
  const double budget = 0.5 * (whole[1] + whole[2]);
  with_budget("[budget]\nelement_steps = " + std::to_string(budget) + "\n");
  const Outcome outcome = run("evolve", {"study.toml", "--threads", "1"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("% of the budget"), std::string::npos) << outcome.out;
  EXPECT_EQ(costs("run"), std::vector(whole.begin(), whole.begin() + 3));
  EXPECT_NE(run("evolve", {"study.toml"}).out.find("nothing to do"), std::string::npos) << "it is spent";
  ASSERT_EQ(run("evolve", {"study.toml", "--threads", "2", "-o", "two.sqlite"}).code, 0);
  EXPECT_EQ(archive_content(folder_ / "run.sqlite"), archive_content(folder_ / "two.sqlite"));
  with_budget("[budget]\nelement_steps = " + std::to_string(whole[3]) + "\n");
  ASSERT_EQ(run("evolve", {"study.toml"}).code, 0) << "more can be spent on the same search";
  EXPECT_EQ(costs("run"), std::vector(whole.begin(), whole.begin() + 4)) << "a budget that is spent exactly is spent";
  with_budget("[budget]\nvoxel_steps_per_element_step = 1\n");
  EXPECT_NE(run("evolve", {"study.toml"}).err.find("budget.element_steps"), std::string::npos);
}

TEST_F(EvolveOnElements, RobotsOfAnySearchWalkAsAnotherStudySays) {
  io::write_whole(
      folder_ / "voxels.toml",
      "preset = \"paper\"\ngenerations = 2\n[population]\nsurvivors = 4\nmutants = 4\n[evaluation]\nstand = true\n"
      "[body]\nlevels = [1]\ncastable = true\n[time]\nduration_s = 0.05\n[surrogate]\nparameters = \"" MENGER_SOURCE_DIR
      "/voxel/parameters/dragon_skin_10_1cm.toml\"\noutside_range = \"warn\"\n"
      "[drive]\nmode = \"in_phase\"\npressure_Pa = [0, 6000]\nfrequency_Hz = 40\n");
  ASSERT_EQ(run("evolve", {"voxels.toml", "-o", "voxels.sqlite"}).code, 0);
  io::write_whole(folder_ / "judge.toml",
                  tests::walking_study_text("", "", "[robust]\nfrictions = [0.4, 1.2]\nloss_factors = [0.1]\n"));
  const Outcome outcome = run("confirm", {"voxels.sqlite", "judge.toml", "--top", "2", "-o", "best.csv"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const io::CsvContents best = io::read_csv(folder_ / "best.csv");
  ASSERT_EQ(best.row_count(), 4U) << "two robots in two scenarios";
  EXPECT_GE(best.number(0, "fitness_body_lengths"), best.number(2, "fitness_body_lengths"));
  const evolution::RunArchive archive = evolution::RunArchive::open_to_read(folder_ / "voxels.sqlite");
  ASSERT_EQ(archive.reevaluations().size(), 4U);
  for (std::size_t row = 0; row < 4; row += 2) {
    EXPECT_EQ(best.number(row, "friction"), 0.4);
    EXPECT_EQ(best.number(row + 1, "friction"), 1.2);
    EXPECT_EQ(best.number(row, "rank"), best.number(row + 1, "rank"));
    double worst = 1e9;
    for (const evolution::Reevaluation& walk : archive.reevaluations()) {
      if (walk.design_hash != best.text(row, "design")) continue;
      ASSERT_TRUE(walk.result.displacement_m) << walk.result.reason;
      worst = std::min(worst, evolution::body_lengths(*walk.result.displacement_m, 1, 0.01));
    }
    EXPECT_EQ(best.number(row, "score_body_lengths"), worst);
    EXPECT_EQ(std::min(best.number(row, "body_lengths"), best.number(row + 1, "body_lengths")), worst);
  }
  std::string still = io::read_whole(folder_ / "voxels.toml");
  still.replace(still.find("mutants = 4"), 11, "mutants = 0");
  io::write_whole(folder_ / "still.toml", still);
  ASSERT_EQ(run("evolve", {"still.toml", "-o", "still.sqlite", "-g", "6"}).code, 0);
  ASSERT_EQ(run("confirm", {"still.sqlite", "judge.toml", "--champions", "-o", "champions.csv", "--threads", "1"}).code, 0);
  const io::CsvContents champions = io::read_csv(folder_ / "champions.csv");
  ASSERT_EQ(export_to("still.sqlite", "out").code, 0);
  const io::CsvContents generations = io::read_csv(folder_ / "out/generations.csv");
  std::vector<std::string> expected;
  for (std::size_t row = 0; row < generations.row_count(); ++row)
    if (expected.empty() || expected.back() != generations.text(row, "champion"))
      expected.push_back(generations.text(row, "champion"));
  ASSERT_LT(expected.size(), generations.row_count()) << "one stays the champion, and is there once";
  ASSERT_EQ(champions.row_count(), 2 * expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(champions.text(2 * n, "individual"), expected[n]);

  const std::string second = best.text(2, "individual");
  ASSERT_EQ(run("confirm", {"voxels.sqlite", "judge.toml", "--individuals", second, second, "-o", "one.csv"}).code, 0);
  const io::CsvContents one = io::read_csv(folder_ / "one.csv");
  ASSERT_EQ(one.row_count(), 2U);
  EXPECT_EQ(one.text(0, "individual"), second);
  EXPECT_EQ(one.text(0, "score_body_lengths"), best.text(2, "score_body_lengths"));
  const auto inputs_of = [&](const char* manifest) {
    const std::string text = io::read_whole(folder_ / manifest);
    return text.substr(0, text.find("\"parameters\""));
  };
  EXPECT_EQ(inputs_of("one.csv.manifest.json"), inputs_of("best.csv.manifest.json"))
      << "an archive that has gained walks is the same search";
  const Outcome unknown = run("confirm", {"voxels.sqlite", "judge.toml", "--individuals", "100000", "-o", "none.csv"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("--individuals 100000"), std::string::npos) << unknown.err;

  const std::string of_the_search = io::read_whole(folder_ / "voxels.manifest.json");
  ASSERT_EQ(run("confirm", {"voxels.sqlite", "judge.toml", "--individuals", second, "-o", "voxels.csv"}).code, 0);
  EXPECT_EQ(io::read_whole(folder_ / "voxels.manifest.json"), of_the_search)
      << "a table of the same name has a manifest of its own";
  EXPECT_TRUE(fs::exists(folder_ / "voxels.csv.manifest.json"));

  const auto expect_refused = [&](const std::string& from, const std::string& to, const std::string& word) {
    std::string text = tests::walking_study_text();
    text.replace(text.find(from), from.size(), to);
    io::write_whole(folder_ / "wrong.toml", text);
    const Outcome refused = run("confirm", {"voxels.sqlite", "wrong.toml", "-o", "wrong.csv"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(word), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder_ / "wrong.csv"));
  };
  expect_refused("wall_thickness_m = 0.002", "wall_thickness_m = 0.002\ncell_edge_m = 0.012", "body.cell_edge_m = 0.012");
  EXPECT_EQ(run("confirm", {"voxels.sqlite", "voxels.toml"}).code, 2);
  EXPECT_EQ(run("confirm", {"voxels.sqlite", "judge.toml", "--top", "2", "--individuals", second}).code, 2);
  const std::string judge = io::read_whole(folder_ / "judge.toml");
  for (const char* read : {"voxels.sqlite", "./judge.toml"}) {
    const Outcome refused = run("confirm", {"voxels.sqlite", "judge.toml", "-o", read});
    EXPECT_EQ(refused.code, 2) << "the table would take the place of what is read";
    EXPECT_NE(refused.err.find(read), std::string::npos) << refused.err;
  }
  EXPECT_EQ(io::read_whole(folder_ / "judge.toml"), judge);
  EXPECT_EQ(run("confirm", {"voxels.sqlite", "judge.toml", "--individuals", second, "-o", "one.csv"}).code, 0);
}

TEST_F(EvolveOnElements, TheTableAndTheManifestBelongToTheirArchive) {
  const fs::path table = folder_ / "run.confirmed.csv";
  const auto manifest = [&] { return io::read_whole(folder_ / "run.manifest.json"); };
  io::write_whole(table, "of an earlier run\n");
  ASSERT_EQ(run("evolve", {"study.toml", "-g", "0"}).code, 0);
  EXPECT_FALSE(fs::exists(table)) << "nothing was confirmed";
  EXPECT_NE(manifest().find("\"confirm\": 0"), std::string::npos) << manifest();
  io::write_whole(table, "of an earlier run\n");
  ASSERT_EQ(run("evolve", {"study.toml", "-g", "0"}).code, 0);
  EXPECT_FALSE(fs::exists(table)) << "the search was finished";
  std::string text = tests::walking_study_text();
  text.replace(text.find("confirm = 0"), 11, "confirm = 1");
  io::write_whole(folder_ / "study.toml", text);
  ASSERT_EQ(run("evolve", {"study.toml", "-g", "0"}).code, 0);
  EXPECT_EQ(io::read_csv(table).row_count(), 2U);
  EXPECT_NE(manifest().find("\"confirm\": 1"), std::string::npos) << "a finished search is confirmed with another number";
  const std::string written = manifest();
  ASSERT_EQ(run("evolve", {"study.toml", "-g", "0"}).code, 0);
  EXPECT_EQ(manifest(), written) << "nothing was computed";
}

TEST_F(EvolveOnElements, WrongInputIsFoundBeforeAnythingIsWritten) {
  const auto expect_refused = [&](const std::string& text, const std::string& word) {
    io::write_whole(folder_ / "study.toml", text);
    const Outcome outcome = run("evolve", {"study.toml"});
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "run.sqlite"));
  };
  expect_refused(tests::walking_study_text("", "", "[elements]\nfidelity = \"rough\"\n"), "elements.fidelity");
  std::string levels = tests::walking_study_text();
  levels.replace(levels.find("[1]"), 3, "[3]");
  expect_refused(levels, "body.levels");
}

}  // namespace
}  // namespace menger
