// The best robots of a search on finer elements.

#include "evolution/report/confirmation.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "evolution/report/study_view.h"
#include "evolution/study/walk_evaluator.h"
#include "io/text/content_hash.h"
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

/// Returns a row of a robot of this rank. @param score none if it failed
Confirmation row(std::size_t rank, fem::Fidelity fidelity, std::optional<double> score) {
  Confirmation one;
  one.rank = rank;
  one.fidelity = fidelity;
  one.score = score;
  return one;
}

TEST_F(ConfirmationTest, TheBestWalksOnAllFinerElements) {
  const Study study = read();
  const auto best = [&](const std::vector<Confirmation>& confirmed) {
    const std::optional<Confirmation> found = best_confirmed(study, confirmed);
    return found ? found->rank : 0;
  };
  using enum fem::Fidelity;
  EXPECT_EQ(best({row(1, standard, 0.5), row(1, fine, 0.2), row(2, standard, 0.3), row(2, fine, 0.3)}), 2U)
      << "the finest elements decide";
  EXPECT_EQ(best({row(1, standard, std::nullopt), row(1, fine, 0.9), row(2, standard, 0.1), row(2, fine, 0.1)}), 2U)
      << "the first falls on standard elements";
  EXPECT_EQ(best({row(1, standard, 0.9), row(1, fine, std::nullopt)}), 0U);
  EXPECT_EQ(best({row(1, fine, 0.9), row(2, standard, 0.9)}), 0U) << "walks are missing";
  EXPECT_EQ(best({}), 0U);
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
