#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/offspring.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* reevaluated_study = "seed = 1\n";

Individual individual_of_id(std::uint64_t id) {
  RandomStream random(id, "individuals");
  Offspring born = random_offspring({}, random);
  return {id, 0, std::nullopt, 0, std::move(born.genome), std::move(born.phenotype)};
}

Reevaluation completed_run(const std::string& design, const std::string& protocol) {
  Reevaluation run;
  run.design_hash = design;
  run.protocol = protocol;
  run.variant = "reference";
  run.duration_s = 2.0;
  run.result.status = io::RunStatus::completed;
  run.result.displacement_m = {1.0 / 3.0, -2e-300, 0.1};
  run.result.steps = 44154;
  run.result.seconds = 0.25;
  return run;
}

/// A folder of its own.
class ArchiveReevaluations : public testing::Test {
 protected:
  [[nodiscard]] RunArchive open() const { return RunArchive::open(file_, reevaluated_study, 3); }

  /// Turns the archive into one of version 2.
  void make_old() const {
    (void)open();
    SQLite::Database database(file_.string(), SQLite::OPEN_READWRITE);
    database.exec("DROP TABLE reevaluation");
    database.exec("DROP TABLE protocol");
    database.exec("PRAGMA user_version = 2");
  }

  [[nodiscard]] int version() const {
    SQLite::Database database(file_.string(), SQLite::OPEN_READONLY);
    return database.execAndGet("PRAGMA user_version").getInt();
  }

  const tests::TestFolder folder_;
  fs::path file_ = folder_ / "run.sqlite";
};

TEST_F(ArchiveReevaluations, AreGivenBackExactly) {
  (void)open();
  Reevaluation limited = completed_run("b", "protocol 2");
  limited.level = 2;
  limited.variant = "E 107 kPa";
  limited.result.status = io::RunStatus::limit_point;
  limited.result.displacement_m.reset();
  limited.result.reason = "at 5 kPa";
  Reevaluation failed = completed_run("c", "protocol 1");
  failed.has_result = false;
  failed.result.displacement_m.reset();
  failed.result.reason = "exit code 1";
  const std::vector<Reevaluation> added{completed_run("a", "protocol 1"), limited, failed};
  RunArchive::open_to_extend(file_).add_reevaluations(added);

  const std::vector<Reevaluation> found = RunArchive::open_to_read(file_).reevaluations();
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t n = 0; n < found.size(); ++n) {
    EXPECT_EQ(found[n].design_hash, added[n].design_hash);
    EXPECT_EQ(found[n].level, added[n].level);
    EXPECT_EQ(found[n].protocol, added[n].protocol);
    EXPECT_EQ(found[n].variant, added[n].variant);
    EXPECT_EQ(found[n].duration_s, 2.0);
    EXPECT_EQ(found[n].has_result, added[n].has_result);
    EXPECT_EQ(found[n].result.displacement_m, added[n].result.displacement_m);
    EXPECT_EQ(found[n].result.reason, added[n].result.reason);
    EXPECT_EQ(found[n].result.steps, 44154U);
    EXPECT_EQ(found[n].result.seconds, 0.25);
  }
  EXPECT_EQ(found[1].result.status, io::RunStatus::limit_point);
}

TEST_F(ArchiveReevaluations, ReplaceThoseOfTheSameDesignLevelAndProtocol) {
  (void)open();
  Reevaluation run = completed_run("a", "protocol");
  RunArchive::open_to_extend(file_).add_reevaluations(std::vector{run});
  run.result.displacement_m = {7.0, 8.0, 9.0};
  RunArchive::open_to_extend(file_).add_reevaluations(std::vector{run});
  const std::vector<Reevaluation> found = RunArchive::open_to_read(file_).reevaluations();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].result.displacement_m, run.result.displacement_m);
}

TEST_F(ArchiveReevaluations, AnOldArchiveIsReadAsItIsAndExtendedWhenItIsWritten) {
  make_old();
  const std::string before = io::read_whole(file_);
  EXPECT_TRUE(RunArchive::open_to_read(file_).reevaluations().empty());
  EXPECT_EQ(io::read_whole(file_), before);
  EXPECT_EQ(version(), 2);
  RunArchive::open_to_extend(file_).add_reevaluations(std::vector{completed_run("a", "protocol")});
  EXPECT_EQ(version(), 3) << "its study still has keys of earlier names";
  EXPECT_EQ(RunArchive::open_to_read(file_).reevaluations().size(), 1U);
  EXPECT_EQ(RunArchive::open_to_read(file_).study(), reevaluated_study);
}

TEST_F(ArchiveReevaluations, NoSearchGoesOnWithAnArchiveFromBeforeKeysHadTheirNames) {
  make_old();
  for (const int old : {2, 3}) {
    if (old == 3) RunArchive::open_to_extend(file_).add_reevaluations({});
    ASSERT_EQ(version(), old);
    const std::string message = tests::message_of([&] { (void)open(); });
    EXPECT_NE(message.find("schema version " + std::to_string(old) + ", with earlier keys of studies"), std::string::npos)
        << message;
    EXPECT_EQ(version(), old) << "it is left as it is";
  }
}

TEST_F(ArchiveReevaluations, ResultsOfAnEarlierVersionAreFoundWhateverTheTextOfTheirPhysicsWas) {
  ArchivedEvaluation known;
  known.result.status = io::RunStatus::completed;
  known.result.displacement_m = {1.0, 2.0, 3.0};
  known.result.left_out_m = {0.5, 0.0, 0.0};
  ArchivedEvaluation halved = known;
  halved.result.left_out_m.reset();
  halved.result.steps = 7;
  {
    RunArchive archive = open();
    archive.add_evaluation({"a", 1, "text of then"}, known);
    archive.add_step_check({"a", 1, "half of then"}, halved);
    EXPECT_FALSE(archive.evaluation({"a", 1, "text of now"}));
  }
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 3");
  const RunArchive archive = RunArchive::open_to_read(file_);
  ASSERT_TRUE(archive.evaluation({"a", 1, "text of now"}));
  EXPECT_EQ(archive.evaluation({"a", 1, "text of now"})->result.displacement_m, known.result.displacement_m);
  EXPECT_EQ(archive.evaluation({"a", 1, "text of now"})->result.left_out_m, known.result.left_out_m);
  EXPECT_EQ(archive.step_check({"a", 1, "text of now"})->result.steps, 7U);
  EXPECT_FALSE(archive.evaluation({"b", 1, "text of now"}));
}

TEST_F(ArchiveReevaluations, ResultsOfMoreThanOnePhysicsInAnEarlierArchiveAreRefused) {
  ArchivedEvaluation known;
  known.result.status = io::RunStatus::completed;
  known.result.displacement_m = {1.0, 2.0, 3.0};
  {
    RunArchive archive = open();
    archive.add_evaluation({"a", 1, "text of then"}, known);
    archive.add_evaluation({"b", 1, "another text"}, known);
  }
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 3");
  const std::string message = tests::message_of([&] {
    (void)RunArchive::open_to_read(file_).evaluation({"a", 1, "text of now"});
  });
  EXPECT_NE(message.find("is damaged: its results in evaluation are of more than one physics"), std::string::npos) << message;
}

TEST_F(ArchiveReevaluations, AreAddedWholeOrNotAtAll) {
  (void)open();
  Reevaluation broken = completed_run("b", "protocol");
  broken.result.reason = std::string("cut off");
  RunArchive archive = RunArchive::open_to_extend(file_);  // it would refuse the trigger
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE)
      .exec(
          "CREATE TRIGGER full BEFORE INSERT ON reevaluation WHEN NEW.design_hash = 'b' BEGIN SELECT RAISE(ABORT, 'full'); END");
  EXPECT_THROW(archive.add_reevaluations(std::vector{completed_run("a", "protocol"), broken}), io::InputError);
  EXPECT_TRUE(archive.reevaluations().empty());
}

TEST_F(ArchiveReevaluations, AreNotAddedToWhatIsNoArchive) {
  EXPECT_THROW((void)RunArchive::open_to_extend(file_), io::InputError);
  EXPECT_FALSE(fs::exists(file_));
  io::write_whole(file_, "generation,fitness\n");
  EXPECT_THROW((void)RunArchive::open_to_extend(file_), io::InputError);
  fs::remove(file_);
  const RunArchive writer = open();
  EXPECT_THROW((void)RunArchive::open_to_extend(file_), io::InputError) << "a search is writing";
}

TEST_F(ArchiveReevaluations, RowsThatContradictThemselvesAreDamage) {
  (void)open();
  RunArchive::open_to_extend(file_).add_reevaluations(std::vector{completed_run("a", "protocol")});
  for (const char* damage : {"UPDATE reevaluation SET status = NULL", "UPDATE reevaluation SET protocol_hash = 'x'"}) {
    const std::string sound = io::read_whole(file_);
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(damage);
    EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError) << damage;
    io::write_whole(file_, sound);
  }
}

TEST_F(ArchiveReevaluations, DesignsWithAFitnessComeOncePerPhenotypeTheBestFirst) {
  RunArchive archive = open();
  std::vector<Individual> born{individual_of_id(0), individual_of_id(1), individual_of_id(2), individual_of_id(3)};
  born[2].phenotype = born[0].phenotype;
  const std::vector<PoolMember> members{{0, 0, 0.5, Knowledge::evaluated, std::nullopt, 1},
                                        {1, 0, 0.75, Knowledge::evaluated, std::nullopt, 0},
                                        {2, 0, 0.5, Knowledge::evaluated, std::nullopt, std::nullopt},
                                        {3, 0, std::nullopt, Knowledge::failed, std::nullopt, std::nullopt}};
  archive.add_generation({0, 0, 0, 0, 0.0, "a", "b"}, born, members);
  const std::vector<FitDesign> designs = archive.fit_designs();
  ASSERT_EQ(designs.size(), 2U);
  EXPECT_EQ(designs[0].individual, 1U);
  EXPECT_EQ(designs[0].fitness, 0.75);
  EXPECT_EQ(designs[0].phenotype, born[1].phenotype);
  EXPECT_EQ(designs[1].individual, 0U);
}

}  // namespace
}  // namespace menger::evolution
