// The best robots of a search on finer elements.

#include "evolution/report/confirmation.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "evolution/report/study_view.h"
#include "evolution/study/walk_evaluator.h"
#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "tests/support/archive_content.h"
#include "tests/support/silicone_archive.h"
#include "tests/support/test_folder.h"
#include "tests/support/walking_study.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;

const std::string hook = "110000000100000000000000000";
const std::string turned_hook = "100100000100000000000000000";  // another pose of it
const std::string bar = "111000000000000000000000000";
const std::string corner = "110100000000000000000000000";

class ConfirmationTest : public testing::Test {
 protected:
  [[nodiscard]] Study read(const std::string& more = "") const {
    Study study = tests::read_walking_study(folder_ / "study.toml", tests::walking_study_text("", "", more));
    study.duration_s = 0.03;
    study.confirm = 2;
    return study;
  }

  /// Makes an archive with the bodies' evaluations by the search.
  void make(const std::string& name, const Study& study, const std::vector<std::string>& bodies) const {
    tests::make_archive(folder_ / name, study, bodies);
    RunArchive archive = RunArchive::open_to_extend(folder_ / name);
    const auto evaluators = scenario_evaluators_of(study);
    for (const FitDesign& design : archive.fit_designs()) {
      const Phenotype simulated = as_simulated(study.search, design.phenotype);
      for (const auto& evaluator : evaluators) {
        archive.add_evaluation({design_hash(simulated, 1), 1, io::content_hash(evaluator->physics())},
                               {0, evaluator->evaluate(simulated.body, 1, never_)});
      }
    }
  }

  const tests::TestFolder folder_;
  const std::atomic<bool> never_{false};
};

TEST_F(ConfirmationTest, TheBestDifferentRobotsWalkOnStandardAndFineElements) {
  const Study study = read();
  make("run.sqlite", study, {hook, turned_hook, bar, corner});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  EXPECT_TRUE(confirmations(study, archive).empty());
  std::size_t walks = 0;
  WalksAgainOptions options;
  options.progress = [&](std::size_t done, std::size_t total) {
    ++walks;
    EXPECT_EQ(done, walks);
    EXPECT_EQ(total, 4U) << "two robots on two fidelities; the turned hook is none of its own";
  };
  ASSERT_EQ(confirm(study, archive, options), io::RunStatus::completed);
  EXPECT_EQ(walks, 4U);
  const std::vector<Confirmation> found = confirmations(study, archive);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].design.phenotype.body.digits(), hook);
  EXPECT_EQ(found[2].design.phenotype.body.digits(), bar);
  EXPECT_EQ(found[1].fidelity, fem::Fidelity::fine);
  for (const Confirmation& one : found) {
    Study finer = study;
    finer.silicone.elements.fidelity = one.fidelity;
    const Evaluation expected = WalkEvaluator(finer).evaluate(as_simulated(study.search, one.design.phenotype).body, 1, never_);
    ASSERT_TRUE(expected.displacement_m) << expected.reason;
    EXPECT_EQ(one.score, level_score(study.search, *expected.displacement_m, 1));
    EXPECT_TRUE(one.angle_deg);
  }
  EXPECT_NE(found[0].score, found[1].score);
  const std::string table = confirmation_table(study, found).text();
  EXPECT_NE(table.find("rank,individual,design,cells,fitness_body_lengths,fidelity,score_body_lengths"), std::string::npos)
      << table;
  EXPECT_NE(table.find(",standard,"), std::string::npos) << table;
  EXPECT_NE(confirmation_text(study, found).find("on fine elements"), std::string::npos);

  walks = 0;
  ASSERT_EQ(confirm(study, archive, options), io::RunStatus::completed);
  EXPECT_EQ(walks, 0U) << "no walk is made again";
}

TEST_F(ConfirmationTest, IsTheSameForTwoThreadsAndAfterAStop) {
  const Study study = read("[robust]\nfrictions = [0.4, 1.2]\nloss_factors = [0.1]\n");
  for (const std::string name : {"one.sqlite", "two.sqlite", "stopped.sqlite"}) make(name, study, {hook, bar});
  const auto confirmed = [&](const std::string& name, const WalksAgainOptions& options) {
    RunArchive archive = RunArchive::open_to_extend(folder_ / name);
    return confirm(study, archive, options);
  };
  ASSERT_EQ(confirmed("one.sqlite", {}), io::RunStatus::completed);
  ASSERT_EQ(confirmed("two.sqlite", {.threads = 2}), io::RunStatus::completed);
  const std::string expected = archive_content(folder_ / "one.sqlite");
  EXPECT_EQ(archive_content(folder_ / "two.sqlite"), expected);
  std::atomic<bool> stop{false};
  ASSERT_EQ(confirmed("stopped.sqlite", {.stop = &stop, .after_commit = [&](std::size_t count) { stop = count == 3; }}),
            io::RunStatus::stopped);
  EXPECT_NE(archive_content(folder_ / "stopped.sqlite"), expected);
  ASSERT_EQ(confirmed("stopped.sqlite", {}), io::RunStatus::completed);
  EXPECT_EQ(archive_content(folder_ / "stopped.sqlite"), expected);
  const RunArchive archive = RunArchive::open_to_read(folder_ / "one.sqlite");
  EXPECT_EQ(archive.reevaluations().size(), 8U) << "two robots, two fidelities, two scenarios";
  EXPECT_EQ(confirmations(study, archive).size(), 4U) << "a score over the scenarios";
}

// Another study may have asked for walks on fine elements only, which say nothing of standard ones.
TEST_F(ConfirmationTest, WalksOnSomeOfTheFinerElementsConfirmNothing) {
  const Study study = read();
  make("run.sqlite", study, {hook, bar});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  WalksAgain fine{.study = study, .variant = "on fine elements"};
  fine.study.silicone.elements.fidelity = fem::Fidelity::fine;
  ASSERT_EQ(walk_again({&fine, 1}, archive.fit_designs(), archive, {}), io::RunStatus::completed);
  EXPECT_TRUE(confirmations(study, archive).empty());
  ASSERT_EQ(confirm(study, archive, {}), io::RunStatus::completed);
  EXPECT_EQ(confirmations(study, archive).size(), 4U);
}

TEST_F(ConfirmationTest, AWalkOfAnotherLevelIsAnotherWalk) {
  const Study study = read();
  make("run.sqlite", study, {hook});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  Reevaluation walked{.design_hash = "hash", .level = 2, .protocol = "protocol", .variant = "", .result = {}};
  walked.result.status = io::RunStatus::completed;
  walked.result.displacement_m = {0.1, 0.0, 0.0};
  archive.add_reevaluations({&walked, 1});
  const MadeWalks made(archive);
  EXPECT_TRUE(made.in_scenarios({"protocol"}, "hash", 2));
  EXPECT_FALSE(made.in_scenarios({"protocol"}, "hash", 1));
}

TEST_F(ConfirmationTest, ABodyOfSeveralRobotsWalksOnce) {
  const Study study = read();
  make("run.sqlite", study, {hook, bar});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  std::vector<FitDesign> robots = archive.fit_designs();
  robots.push_back(robots.front());
  robots.back().individual = 7;
  std::size_t walks = 0;
  const WalksAgain asked{.study = study, .variant = "again"};
  ASSERT_EQ(walk_again({&asked, 1}, robots, archive,
                       {.progress =
                            [&](std::size_t, std::size_t total) {
                              ++walks;
                              EXPECT_EQ(total, 2U);
                            }}),
            io::RunStatus::completed);
  EXPECT_EQ(walks, 2U);
}

TEST_F(ConfirmationTest, TellsWhyARobotFailed) {
  Study study = read();
  study.confirm = 1;
  make("run.sqlite", study, {hook});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  for (const fem::Fidelity fidelity : {fem::Fidelity::standard, fem::Fidelity::fine}) {
    Study finer = study;
    finer.silicone.elements.fidelity = fidelity;
    Reevaluation row{.design_hash = design_hash(as_simulated(study.search, archive.fit_designs().front().phenotype), 1),
                     .level = 1,
                     .protocol = WalkEvaluator(finer).physics(),
                     .variant = "confirmed",
                     .duration_s = study.duration_s,
                     .result = {}};
    row.result.status = io::RunStatus::diverged;
    row.result.reason = "walls pass through each other";
    archive.add_reevaluations({&row, 1});
  }
  const std::vector<Confirmation> found = confirmations(study, archive);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_FALSE(found[0].score);
  EXPECT_EQ(found[0].reason, "walls pass through each other");
  EXPECT_NE(confirmation_text(study, found).find("none on standard elements (walls pass"), std::string::npos);
}

/// Returns a row of a robot of this rank. @param along none if the walk failed
Confirmation row(std::size_t rank, fem::Fidelity fidelity, std::optional<double> along) {
  Confirmation one;
  one.rank = rank;
  one.fidelity = fidelity;
  one.along = along;
  if (along) one.score = std::abs(*along);
  return one;
}

/// Returns the rank of the robot that a search is shown by; 0 if there is none.
std::size_t best(const std::vector<Confirmation>& confirmed) {
  const std::span<const Confirmation> walks = best_confirmed(confirmed);
  return walks.empty() ? 0 : walks.front().rank;
}

using enum fem::Fidelity;

TEST(BestConfirmed, GoesFurthestOnTheElementsOnWhichItGoesLeast) {
  EXPECT_EQ(best({row(1, standard, 0.5), row(1, fine, 0.2), row(2, standard, 0.3), row(2, fine, 0.3)}), 2U);
  EXPECT_EQ(best({row(1, standard, 0.2), row(1, fine, 0.5), row(2, standard, 0.3), row(2, fine, 0.3)}), 2U);
  EXPECT_EQ(best({row(1, standard, 0.3), row(1, fine, 0.3), row(2, standard, 0.3), row(2, fine, 0.4)}), 1U)
      << "of equals the better one of the search";
  EXPECT_EQ(best({row(1, standard, 0.4), row(1, fine, -0.2), row(2, standard, 0.1), row(2, fine, 0.1)}), 2U)
      << "the first goes back on fine elements";
  EXPECT_EQ(best({row(2, fine, 0.1), row(3, fine, 0.2)}), 3U) << "one fidelity, and the first robot has no walks";
  EXPECT_EQ(best({}), 0U);
}

TEST(BestConfirmed, AFailedWalkHalvesTheOther) {
  EXPECT_EQ(best({row(1, standard, 0.3), row(1, fine, std::nullopt), row(2, standard, 0.1), row(2, fine, 0.1)}), 1U);
  EXPECT_EQ(best({row(1, standard, 0.3), row(1, fine, std::nullopt), row(2, standard, 0.2), row(2, fine, 0.2)}), 2U);
  EXPECT_EQ(best({row(1, standard, -0.3), row(1, fine, std::nullopt), row(2, standard, -0.2), row(2, fine, -0.2)}), 2U)
      << "a failed walk does not make a way back shorter";
  EXPECT_EQ(best({row(1, standard, std::nullopt), row(1, fine, std::nullopt), row(2, standard, -0.1), row(2, fine, 0.1)}), 2U)
      << "a robot without a walk comes last";
  EXPECT_EQ(best({row(1, standard, std::nullopt), row(1, fine, std::nullopt)}), 0U);
}

TEST(BestConfirmed, AFallIsNoDistance) {
  Confirmation fallen = row(1, standard, 0.0);
  fallen.score.reset();
  EXPECT_EQ(best({fallen, row(1, fine, 0.5), row(2, standard, 0.1), row(2, fine, 0.1)}), 2U);
  EXPECT_EQ(best({fallen, row(1, fine, 0.5), row(2, standard, -0.1), row(2, fine, 0.1)}), 1U);
  EXPECT_EQ(best({fallen}), 0U) << "it has no score on any elements";
}

/// How a robot walks on elements of one fidelity: so far in so many degrees from the axis x, or not at all.
struct KnownWalk {
  double body_lengths = 0.0;
  double angle_deg = 0.0;
  std::string reason{};
};

/// Archives with walks that are stated instead of computed.
class ChampionTest : public ConfirmationTest {
 protected:
  ChampionTest() : study_(read()) {}

  [[nodiscard]] Evaluation result_of(const KnownWalk& walk, std::size_t element_count) const {
    Evaluation result;
    result.elements = element_count;
    result.steps = 1;
    if (!walk.reason.empty()) {
      result.status = io::RunStatus::diverged;
      result.reason = walk.reason;
      return result;
    }
    const double length_m = walk.body_lengths * 3.0 * study_.search.cell_edge_m;
    const double angle = walk.angle_deg * std::numbers::pi / 180.0;
    result.status = io::RunStatus::completed;
    result.displacement_m = {length_m * std::cos(angle), length_m * std::sin(angle), 0.001};
    return result;
  }

  /// Makes an archive of these bodies, the best first, with their walks in the search, on standard and on fine elements.
  void make(const std::vector<std::pair<std::string, std::array<KnownWalk, 3>>>& robots) const {
    std::vector<std::string> bodies;
    for (const auto& [body, walks] : robots) bodies.push_back(body);
    tests::make_archive(folder_ / "run.sqlite", study_, bodies);
    RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
    for (const auto& [body, walks] : robots) {
      Phenotype phenotype;
      phenotype.body = meshes::Polycube::from_digits(3, 3, 3, body);
      const std::string design = design_hash(as_simulated(study_.search, phenotype), 1);
      archive.add_evaluation({design, 1, io::content_hash(WalkEvaluator(study_).physics())}, {0, result_of(walks[0], 100)});
      for (const auto& [fidelity, walk] : {std::pair{standard, walks[1]}, std::pair{fine, walks[2]}}) {
        Study finer = study_;
        finer.silicone.elements.fidelity = fidelity;
        const Reevaluation made{.design_hash = design,
                                .level = 1,
                                .protocol = WalkEvaluator(finer).physics(),
                                .variant = "confirmed",
                                .duration_s = study_.duration_s,
                                .result = result_of(walk, 200)};
        archive.add_reevaluations({&made, 1});
      }
    }
  }

  /// Returns the line that names the champion of the archive.
  [[nodiscard]] std::string line() const {
    const RunArchive archive = RunArchive::open_to_read(folder_ / "run.sqlite");
    const auto champion = champion_of(view_of(archive, study_), study_, 0, confirmations(study_, archive));
    return champion ? champion_text(*champion) : "";
  }

  Study study_;
};

TEST_F(ChampionTest, OneFailedWalkDoesNotMakeWayForARobotThatStandsStill) {
  make({{hook, {KnownWalk{0.0686, 30.0}, {0.0741, 30.2}, {.reason = "walls went through each other"}}},
        {bar, {KnownWalk{0.0003, 0.0}, {0.0002, 0.0}, {0.0004, 0.0}}}});
  EXPECT_EQ(
      line(),
      "Champion: individual 0, 3 cells, " + hook +
          "; number 1 of the search: 1.0000 body lengths there, along the same direction 0.0741 on standard elements (turned by "
          "0 degrees) and no walk on fine elements (walls went through each other)");
}

TEST_F(ChampionTest, ARobotThatTurnsBackMakesWayForOneThatKeepsItsDirection) {
  make({{hook, {KnownWalk{0.0450, -100.0}, {0.0432, -97.0}, {0.0239, 79.0}}},
        {bar, {KnownWalk{0.0150, 170.0}, {0.0127, -176.0}, {0.0159, 153.0}}}});
  EXPECT_EQ(
      line(),
      "Champion: individual 1, 3 cells, " + bar +
          "; number 2 of the search: 0.8750 body lengths there, along the same direction 0.0123 on standard elements (turned by "
          "14 degrees) and 0.0152 on fine elements (turned by 17 degrees); it comes before number 1 of the search "
          "(individual 0): 1.0000 body lengths there, along the same direction 0.0431 on standard elements (turned by 3 degrees) "
          "and -0.0239 on fine elements (turned by 179 degrees)");
  const RunArchive archive = RunArchive::open_to_read(folder_ / "run.sqlite");
  const std::vector<Confirmation> found = confirmations(study_, archive);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NEAR(found[1].score.value(), 0.0239, 1e-12);
  EXPECT_NEAR(found[1].along.value(), 0.0239 * std::cos(179.0 / 180.0 * std::numbers::pi), 1e-12);
  const io::CsvContents table = io::parse_csv(confirmation_table(study_, found).text(), "confirmed.csv");
  EXPECT_NEAR(table.number(1, "along_body_lengths"), found[1].along.value(), 1e-12);
}

TEST_F(ChampionTest, IsTheBestOfTheSearchIfNoRobotWalksOnFinerElements) {
  const KnownWalk failed{.reason = "walls went through each other"};
  make({{hook, {KnownWalk{0.05, 0.0}, failed, failed}}, {bar, {KnownWalk{0.04, 0.0}, failed, failed}}});
  EXPECT_NE(line().find("Champion: individual 0, 3 cells, " + hook +
                        "; the best of the search, as no robot that was confirmed walks on finer elements; number 1"),
            std::string::npos)
      << line();
}

TEST_F(ChampionTest, SaysWhereNoRobotKeepsItsDirection) {
  make({{hook, {KnownWalk{0.05, 0.0}, {0.05, 0.0}, {0.05, 180.0}}}, {bar, {KnownWalk{0.0, 0.0}, {0.04, 20.0}, {0.03, 0.0}}}});
  EXPECT_NE(line().find("Champion: individual 1,"), std::string::npos) << "what stood still has no direction: 0\n" << line();
  EXPECT_NE(line().find("no robot that was confirmed keeps its direction"), std::string::npos) << line();
}

TEST_F(ChampionTest, TheWorstScenarioCounts) {
  study_ = read("[robust]\nfrictions = [0.4, 1.2]\nloss_factors = [0.1]\n");
  ConfirmationTest::make("run.sqlite", study_, {hook});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  const std::string design = design_hash(as_simulated(study_.search, archive.fit_designs().front().phenotype), 1);
  const auto evaluators = scenario_evaluators_of(study_);
  // Nothing can be added twice to the archive of a search: its own walks decide the directions.
  std::vector<std::array<double, 3>> directions_m;
  for (const auto& evaluator : evaluators) {
    const auto walk = archive.evaluation({design, 1, io::content_hash(evaluator->physics())});
    ASSERT_TRUE(walk && walk->result.displacement_m);
    directions_m.push_back(*walk->result.displacement_m);
  }
  for (const fem::Fidelity fidelity : {standard, fine}) {
    Study finer = study_;
    finer.silicone.elements.fidelity = fidelity;
    const auto scenarios = scenario_evaluators_of(finer);
    for (std::size_t n = 0; n < scenarios.size(); ++n) {
      Reevaluation made{.design_hash = design,
                        .level = 1,
                        .protocol = scenarios[n]->physics(),
                        .variant = "confirmed",
                        .duration_s = study_.duration_s,
                        .result = result_of({}, 200)};
      const double factor = n == 0 ? 3.0 : -2.0;
      const auto& direction_m = directions_m[n];
      made.result.displacement_m = {factor * direction_m[0], factor * direction_m[1], 0.0};
      archive.add_reevaluations({&made, 1});
    }
  }
  const std::vector<Confirmation> found = confirmations(study_, archive);
  ASSERT_EQ(found.size(), 2U);
  const double back = -2.0 * level_score(study_.search, directions_m[1], 1);
  EXPECT_NEAR(found[0].along.value(), back, 1e-12 * std::abs(back)) << "the robot goes back in one of two scenarios";
  EXPECT_NEAR(found[0].angle_deg.value(), 180.0, 1e-9);
}

TEST_F(ConfirmationTest, FineElementsHaveNoFinerOnes) {
  const Study study = read("[elements]\nfidelity = \"fine\"\n");
  make("run.sqlite", study, {hook});
  RunArchive archive = RunArchive::open_to_extend(folder_ / "run.sqlite");
  ASSERT_EQ(confirm(study, archive, {}), io::RunStatus::completed);
  EXPECT_TRUE(archive.reevaluations().empty());
}

}  // namespace
}  // namespace menger::evolution
