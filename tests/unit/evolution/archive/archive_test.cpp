#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/offspring.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* study = "seed = 1\n[population]\nsurvivors = 15\n[body]\nlevels = [1, 2]\n";

Individual some_individual(std::uint64_t id, BodyPlan plan = BodyPlan::fractal) {
  OffspringOptions options;
  options.decoder.plan = plan;
  RandomStream random(id, "individuals");
  Offspring born = random_offspring(options, random);
  return {id, 2, id == 0 ? std::nullopt : std::optional(id - 1), 5, std::move(born.genome), std::move(born.phenotype)};
}

/// A folder of its own.
class Archive : public testing::Test {
 protected:
  [[nodiscard]] RunArchive open(int generations = 3) const { return RunArchive::open(file_, study, generations); }

  /// Makes an archive with enough rows for several pages.
  void fill() const {
    RunArchive archive = open();
    for (int i = 0; i < 300; ++i) {
      Evaluation result;
      result.status = io::RunStatus::completed;
      result.displacement_m = {0.1 * i, 1.0 / 3.0, -0.5};
      archive.add_evaluation({"design " + std::to_string(i), 1, "physics"}, {0, result});
    }
  }

  /// Expects that opening for writing and for reading is refused with all of these words and leaves the file as it is.
  void expect_refused(const std::vector<std::string>& words, std::string_view wanted_study = study) const {
    const std::string before = fs::is_regular_file(file_) ? io::read_whole(file_) : "";
    try {
      (void)RunArchive::open(file_, wanted_study, 3);
      FAIL() << "opened";
    } catch (const io::InputError& error) {
      for (const std::string& word : words) {
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << "\ndoes not say: " << word;
      }
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos) << error.what();
    }
    if (fs::is_regular_file(file_)) {
      EXPECT_EQ(io::read_whole(file_), before);
    }
  }

  const tests::TestFolder folder_;
  fs::path file_ = folder_ / "run.sqlite";
};

TEST_F(Archive, GivesEvaluationsBackExactly) {
  RunArchive archive = open();
  Evaluation completed;
  completed.status = io::RunStatus::completed;
  completed.displacement_m = {1.0 / 3.0, -2e-300, 0.1};
  completed.steps = 44154;
  completed.seconds = 0.25;
  Evaluation diverged;
  diverged.status = io::RunStatus::diverged;
  diverged.reason = "voxel 3: speed";
  diverged.outside_validity = "beams were strained, \"much\"";
  archive.add_evaluation({"a", 1, "p"}, {4, completed});
  archive.add_evaluation({"a", 2, "p"}, {5, diverged});

  const auto first = archive.evaluation({"a", 1, "p"});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->generation, 4);
  EXPECT_EQ(first->result.status, io::RunStatus::completed);
  EXPECT_EQ(first->result.displacement_m, completed.displacement_m);
  EXPECT_EQ(first->result.steps, 44154U);
  EXPECT_EQ(first->result.seconds, 0.25);
  const auto second = archive.evaluation({"a", 2, "p"});
  ASSERT_TRUE(second);
  EXPECT_EQ(second->result.status, io::RunStatus::diverged);
  EXPECT_EQ(second->result.reason, diverged.reason);
  EXPECT_FALSE(second->result.displacement_m);
  EXPECT_EQ(first->result.outside_validity, "");
  EXPECT_EQ(second->result.outside_validity, diverged.outside_validity);
  EXPECT_EQ(archive.evaluations_outside_validity(4, "p"), 0U);
  EXPECT_EQ(archive.evaluations_outside_validity(5, "p"), 1U);
  archive.add_evaluation({"a", 1, "surrogate"}, {5, diverged});
  EXPECT_EQ(archive.evaluations_outside_validity(5, "p"), 1U) << "results of another physics are not counted";
}

TEST_F(Archive, GivesTheOrderOfASteadyStateSearchBack) {
  const std::vector<SearchEvent> first{{0, true}, {1, true}};
  const std::vector<SearchEvent> second{{1, false}, {2, true}};
  std::vector<SearchEvent> all = first;
  all.insert(all.end(), second.begin(), second.end());
  {
    RunArchive archive = open();
    EXPECT_TRUE(archive.events().empty());
    archive.add_events(first, {});
    Evaluation result;
    result.status = io::RunStatus::completed;
    result.displacement_m = {0.1, 0.2, 0.3};
    const std::vector<std::pair<EvaluationKey, ArchivedEvaluation>> results{{{"a", 1, "p"}, {0, result}}};
    archive.add_events(second, results);
    EXPECT_THROW(archive.add_events(first, results), io::InputError) << "the result is there already";
    EXPECT_EQ(archive.events(), all) << "all of a call, or nothing";
    ASSERT_TRUE(archive.evaluation({"a", 1, "p"}));
  }
  EXPECT_EQ(RunArchive::open_to_read(file_).events(), all);
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("UPDATE event SET what = 'gone' WHERE number = 2");
  EXPECT_THROW((void)open().events(), io::InputError);
}

TEST_F(Archive, GivesDisplacementsByPeriodAndElementsBack) {
  RunArchive archive = open();
  Evaluation walked;
  walked.status = io::RunStatus::completed;
  walked.displacement_m = {1.0, 2.0, 3.0};
  for (int n = 0; n < 12; ++n) walked.period_displacements_m.push_back({1.0 / (3.0 + n), -2e-300, 0.1 * n});
  walked.elements = 652;
  walked.fidelity = "draft";
  Evaluation refused;
  refused.status = io::RunStatus::diverged;
  refused.fidelity = "draft";
  Evaluation as_voxels;
  as_voxels.status = io::RunStatus::completed;
  as_voxels.displacement_m = {1.0, 2.0, 3.0};
  archive.add_evaluation({"a", 1, "p"}, {0, as_voxels});
  EXPECT_EQ(SQLite::Database(file_.string()).tableExists("period_displacement"), false) << "a search on voxels has no such table";
  archive.add_evaluation({"a", 1, "q"}, {0, walked});
  archive.add_evaluation({"b", 1, "q"}, {0, refused});
  for (const auto& [key, added] : {std::pair{EvaluationKey{"a", 1, "q"}, walked}, std::pair{EvaluationKey{"b", 1, "q"}, refused},
                                   std::pair{EvaluationKey{"a", 1, "p"}, as_voxels}}) {
    const auto found = archive.evaluation(key);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->result.period_displacements_m, added.period_displacements_m);
    EXPECT_EQ(found->result.elements, added.elements);
    EXPECT_EQ(found->result.fidelity, added.fidelity);
  }
}

TEST_F(Archive, NoSearchGoesOnWithAnArchiveFromBeforeThereWereModels) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 5");
  expect_refused({"schema version 5", "no search can be resumed", "menger export and menger reevaluate can read it"});
  const auto found = RunArchive::open_to_read(file_).evaluation({"design 7", 1, "the physics of now"});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->result.displacement_m, (std::array{0.1 * 7, 1.0 / 3.0, -0.5}));
}

TEST_F(Archive, NoSearchGoesOnWithAnArchiveFromBeforeThereWereScenarios) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 6");
  expect_refused({"schema version 6", "no search can be resumed", "menger export and menger reevaluate can read it"});
  const RunArchive archive = RunArchive::open_to_read(file_);
  EXPECT_TRUE(archive.evaluation({"design 7", 1, "physics"}));
  EXPECT_FALSE(archive.evaluation({"design 7", 1, "the physics of now"})) << "its results have the keys of now";
}

TEST_F(Archive, NoSearchGoesOnWithAnArchiveInWhichFallsDiverged) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 7");
  expect_refused({"schema version 7, in which bodies that fell have no displacements", "no search can be resumed",
                  "menger export and menger reevaluate can read it"});
  EXPECT_TRUE(RunArchive::open_to_read(file_).evaluation({"design 7", 1, "physics"}));
}

TEST_F(Archive, KeepsHowFarABodyGotThatFell) {
  RunArchive archive = open();
  Evaluation fallen;
  fallen.status = io::RunStatus::fell;
  fallen.reason = "the body has fallen";
  fallen.left_out_m = {0.3, -0.1, 0.0};
  fallen.period_displacements_m = {{0.1, -0.1, 0.0}, {0.2, 0.0, 0.0}};
  archive.add_evaluation({"a", 1, "p"}, {2, fallen});
  const auto found = RunArchive::open_to_read(file_).evaluation({"a", 1, "p"});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->result.status, io::RunStatus::fell);
  EXPECT_FALSE(found->result.displacement_m);
  EXPECT_EQ(found->result.left_out_m, fallen.left_out_m);
  EXPECT_EQ(found->result.period_displacements_m, fallen.period_displacements_m);
}

TEST_F(Archive, KnowsAResultOnlyUnderItsWholeKey) {
  RunArchive archive = open();
  Evaluation result;
  result.status = io::RunStatus::completed;
  result.displacement_m = {1.0, 2.0, 3.0};
  archive.add_evaluation({"a", 1, "p"}, {0, result});
  EXPECT_FALSE(archive.evaluation({"b", 1, "p"}));
  EXPECT_FALSE(archive.evaluation({"a", 2, "p"}));
  EXPECT_FALSE(archive.evaluation({"a", 1, "q"}));
  EXPECT_THROW(archive.add_evaluation({"a", 1, "p"}, {0, result}), io::InputError) << "a result must not be replaced";
}

TEST_F(Archive, GivesGenerationsBackAfterReopening) {
  const GenerationRecord record{0, 7, 8, 9, 1.5, "state a", "state b"};
  const std::vector<Individual> born{some_individual(0), some_individual(1, BodyPlan::nonfractal), some_individual(2)};
  const std::vector<PoolMember> members{{0, 3, 1.0 / 7.0, Knowledge::evaluated, std::nullopt, 1},
                                        {1, 0, std::nullopt, Knowledge::failed, std::nullopt, 0},
                                        {2, 1, std::nullopt, Knowledge::bounded, 0.25, std::nullopt}};
  open().add_generation(record, born, members);

  const RunArchive archive = open();
  EXPECT_EQ(archive.last_generation(), 0);
  EXPECT_EQ(archive.generation(0), record);
  EXPECT_EQ(archive.pool(0), members);
  for (const Individual& individual : born) EXPECT_EQ(archive.individual(individual.id), individual);
  EXPECT_EQ(archive.next_id(), 3U);
  EXPECT_EQ(archive.study(), study);
  EXPECT_THROW((void)archive.individual(3), io::InputError);
  EXPECT_THROW((void)archive.generation(1), io::InputError);
}

TEST_F(Archive, HoldsNothingOfAGenerationThatCouldNotBeAddedWhole) {
  RunArchive archive = open();
  const GenerationRecord record{0, 0, 0, 0, 0.0, "a", "b"};
  const std::vector<Individual> twice{some_individual(4), some_individual(4)};
  EXPECT_THROW(archive.add_generation(record, twice, {}), io::InputError);
  EXPECT_FALSE(archive.last_generation());
  EXPECT_EQ(archive.next_id(), 0U);
}

TEST_F(Archive, IsEmptyAtFirstAndLeavesNoOtherFilesBehind) {
  {
    const RunArchive archive = open();
    EXPECT_FALSE(archive.last_generation());
    EXPECT_EQ(archive.next_id(), 0U);
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
  EXPECT_EQ(files, std::vector{file_});
}

TEST_F(Archive, KeepsTheLatestGoal) {
  { EXPECT_EQ(open(3).generation_goal(), 3); }
  { EXPECT_EQ(open(10).generation_goal(), 10); }
  EXPECT_EQ(RunArchive::open_to_read(file_).generation_goal(), 10);
}

TEST_F(Archive, CanBeReadWhileItIsWritten) {
  RunArchive writer = open();
  const GenerationRecord record{0, 0, 0, 0, 0.0, "a", "b"};
  const RunArchive before = RunArchive::open_to_read(file_);
  EXPECT_FALSE(before.last_generation());
  writer.add_generation(record, {}, {});
  EXPECT_FALSE(before.last_generation()) << "a reader sees one state";
  EXPECT_EQ(RunArchive::open_to_read(file_).last_generation(), 0);
}

TEST_F(Archive, RefusesASecondWriter) {
  {
    const RunArchive writer = open();
    try {
      (void)open();
      FAIL() << "opened twice";
    } catch (const io::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("another process is writing"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW((void)open()) << "the first writer has let go";
}

TEST_F(Archive, TakesTheLockThatADeadProcessLeft) {
  io::write_whole(file_.string() + ".lock", "");
  EXPECT_NO_THROW((void)open());
}

TEST_F(Archive, TakesAnEmptyFileForANewArchive) {
  // A process that is killed at its start leaves an empty file.
  io::write_whole(file_, "");
  EXPECT_EQ(open().study(), study);
}

TEST_F(Archive, RefusesOtherFiles) {
  io::write_whole(file_, "generation,fitness\n1,2\n");
  expect_refused({"is not an archive"});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
}

TEST_F(Archive, RefusesOtherDatabases) {
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE shopping (item TEXT)");
  expect_refused({"is not an archive", "something else"});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
}

TEST_F(Archive, RefusesAnotherSchemaVersion) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  expect_refused({"schema version 99", "version " + std::to_string(RunArchive::schema_version)});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
}

TEST_F(Archive, RefusesAnotherStudyAndNamesTheDifference) {
  fill();
  expect_refused({"another study", "[population]", "survivors = 15", "survivors = 16"},
                 "seed = 1\n[population]\nsurvivors = 16\n[body]\nlevels = [1, 2]\n");
  expect_refused({"another study", "[body]", "levels = [1, 2]", "levels = [1]"},
                 "seed = 1\n[population]\nsurvivors = 15\n[body]\nlevels = [1]\n");
}

TEST_F(Archive, RefusesATruncatedFile) {
  fill();
  fs::resize_file(file_, fs::file_size(file_) / 2);
  expect_refused({});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
}

TEST_F(Archive, RefusesAFileWithDamagedPages) {
  fill();
  std::fstream damaged(file_, std::ios::in | std::ios::out | std::ios::binary);
  damaged.seekp(static_cast<std::streamoff>(fs::file_size(file_)) / 2);
  damaged << std::string(9000, '\x55');
  damaged.close();
  expect_refused({});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
}

TEST_F(Archive, RefusesRowsThatContradictEachOther) {
  // Pages of SQLite have no checksums, so its own check does not find such damage.
  for (const char* damage :
       {"UPDATE study SET resolved = resolved || ' '", "UPDATE evaluation SET dy_m = NULL WHERE design_hash = 'design 7'",
        "UPDATE evaluation SET status = 'diverged' WHERE design_hash = 'design 8'"}) {
    fs::remove(file_);
    fill();
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(damage);
    expect_refused({"is damaged"});
    EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError) << damage;
  }
}

TEST_F(Archive, RefusesInfiniteNumbersWithTableAndColumn) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE evaluation SET dx_m = 9e999 WHERE design_hash = 'design 7'");
  expect_refused({"evaluation.dx_m = inf: must be a finite number"});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
  fs::remove(file_);
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE evaluation SET seconds = -9e999 WHERE design_hash = 'design 7'");
  expect_refused({"evaluation.seconds = -inf: must be a finite number"});
}

/// The journal mode in the header of a database: 1 without a log, 2 with one.
int header_version(const fs::path& file) { return io::read_whole(file).at(18); }

TEST_F(Archive, IsOneFileWithoutALogOnceItIsClosed) {
  fill();
  EXPECT_EQ(header_version(file_), 1);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
  EXPECT_EQ(files, std::vector{file_});
  RunArchive::open_to_extend(file_).add_reevaluations({});
  EXPECT_EQ(header_version(file_), 1);
}

TEST_F(Archive, KeepsItsLogWhileOthersReadIt) {
  auto writer = std::make_unique<RunArchive>(open());
  writer->add_generation({0, 0, 0, 0, 0.0, "a", "b"}, {}, {});
  const RunArchive reader = RunArchive::open_to_read(file_);
  writer->add_generation({1, 0, 0, 0, 0.0, "a", "b"}, {}, {});
  writer.reset();
  EXPECT_EQ(reader.last_generation(), 0);
  EXPECT_EQ(RunArchive::open_to_read(file_).last_generation(), 1);
}

TEST_F(Archive, IsWrittenWhileOthersReadItAfterItWasClosed) {
  { open().add_generation({0, 0, 0, 0, 0.0, "a", "b"}, {}, {}); }
  const RunArchive reader = RunArchive::open_to_read(file_);
  open().add_generation({1, 0, 0, 0, 0.0, "a", "b"}, {}, {});
  EXPECT_EQ(reader.last_generation(), 0);
  EXPECT_EQ(RunArchive::open_to_read(file_).last_generation(), 1);
  EXPECT_EQ(header_version(file_), 1);
}

TEST_F(Archive, OfAKilledProcessIsRefusedWithoutItsLog) {
  const fs::path copy = folder_ / "copy.sqlite";
  {
    RunArchive writer = open();
    writer.add_generation({0, 0, 0, 0, 0.0, "a", "b"}, {}, {});
    fs::copy_file(file_, copy);  // as a kill leaves it at this moment
    fs::copy_file(file_.string() + "-wal", folder_ / "log");
  }
  fs::rename(copy, file_);
  expect_refused({"is only a part of an archive", file_.string() + "-wal is missing"});
  EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError);
  EXPECT_THROW((void)RunArchive::open_to_extend(file_), io::InputError);
  EXPECT_FALSE(fs::exists(file_.string() + "-wal"));

  fs::rename(folder_ / "log", file_.string() + "-wal");
  EXPECT_EQ(open().last_generation(), 0) << "both files together are the archive";
}

/// Copies an archive as a kill in the middle of a change to the file itself leaves it: with the journal that takes it back.
void copy_with_half_a_change(const fs::path& from, const fs::path& to) {
  SQLite::Database connection(from.string(), SQLite::OPEN_READWRITE);
  connection.exec("BEGIN; DELETE FROM evaluation; DROP TABLE generation");
  ASSERT_EQ(sqlite3_db_cacheflush(connection.getHandle()), SQLITE_OK);  // writes the change before it is committed
  for (const char* end : {"", "-journal"}) fs::copy_file(from.string() + end, to.string() + end);
}

TEST_F(Archive, OfAProcessKilledInTheMiddleOfAChangeIsReadAsItWasBefore) {
  fill();
  const fs::path copy = folder_ / "copy.sqlite";
  copy_with_half_a_change(file_, copy);
  ASSERT_NE(io::read_whole(copy), io::read_whole(file_));
  EXPECT_TRUE(RunArchive::open_to_read(copy).evaluation({"design 7", 1, "physics"}));
  EXPECT_FALSE(fs::exists(copy.string() + "-journal"));
}

TEST_F(Archive, IsNotBegunOverADatabaseWhoseTablesAreInAMissingLog) {
  {
    SQLite::Database half(file_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    half.exec("PRAGMA journal_mode = WAL");
    half.exec("CREATE TABLE study (row INTEGER)");
    fs::copy_file(file_, folder_ / "copy.sqlite");
  }
  fs::rename(folder_ / "copy.sqlite", file_);
  expect_refused({"is only a part of an archive", "-wal is missing"});
}

TEST_F(Archive, WithALogThatWasClosedAsByEarlierVersionsIsReadAndContinued) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA journal_mode = WAL");
  ASSERT_EQ(header_version(file_), 2);
  EXPECT_TRUE(RunArchive::open_to_read(file_).evaluation({"design 7", 1, "physics"}));
  EXPECT_EQ(open().study(), study);
  EXPECT_EQ(header_version(file_), 1);
}

TEST_F(Archive, RefusesTriggersViewsAndTablesThatNoArchiveHas) {
  for (const auto& [change, name] : std::map<std::string, std::string>{
           {"CREATE TRIGGER spy AFTER INSERT ON evaluation BEGIN DELETE FROM evaluation; END", "trigger \"spy\""},
           {"CREATE VIEW best AS SELECT * FROM evaluation", "view \"best\""},
           {"CREATE TABLE mine (row INTEGER)", "table \"mine\""},
           {"CREATE INDEX fast ON evaluation (steps)", "index \"fast\""},
           {"ALTER TABLE generation RENAME TO hidden; CREATE VIEW generation AS SELECT * FROM hidden", "\""}}) {
    fs::remove(file_);
    fill();
    SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec(change);
    expect_refused({"which no archive of menger has", name});
    EXPECT_THROW((void)RunArchive::open_to_read(file_), io::InputError) << change;
    EXPECT_THROW((void)RunArchive::open_to_extend(file_), io::InputError) << change;
  }
}

TEST_F(Archive, IsLockedUnderAllItsNames) {
  fs::create_symlink(file_, folder_ / "link.sqlite");
  const RunArchive writer = open();
  EXPECT_THROW((void)RunArchive::open(folder_ / "link.sqlite", study, 3), io::InputError);
  EXPECT_THROW((void)RunArchive::open_to_extend(folder_ / "link.sqlite"), io::InputError);
}

/// A folder as on a medium that cannot be written to, also for root: a bind mount that is read-only, in a mount namespace of the
/// process that runs the test. @return whether the system lets this process make one
bool mount_read_only(const fs::path& folder) {
  const std::string name = folder.string();
  return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount(name.c_str(), name.c_str(), nullptr, MS_BIND, nullptr) == 0 &&
         ::mount("none", name.c_str(), nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0;
}

/// Reads an archive in a process that cannot write to its folder.
/// @return what went wrong; nothing if the system does not let it make such a folder
std::optional<std::string> reading_without_writing(const fs::path& file) {
  constexpr int not_possible = 77;
  const fs::path report = file.parent_path().parent_path() / (file.parent_path().filename().string() + ".report");
  const pid_t child = fork();
  if (child == 0) {
    if (!mount_read_only(file.parent_path())) std::_Exit(not_possible);
    try {
      const bool is_there = RunArchive::open_to_read(file).evaluation({"design 7", 1, "physics"}).has_value();
      io::write_whole(report, is_there ? "" : "an evaluation is missing");
    } catch (const std::exception& error) {
      io::write_whole(report, error.what());
    }
    std::_Exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WEXITSTATUS(status) == not_possible) return std::nullopt;
  const std::string found = io::read_whole(report);
  fs::remove(report);
  return found;
}

class ArchiveOnReadOnlyMedium : public Archive {
 protected:
  ArchiveOnReadOnlyMedium() { fs::create_directory(folder_ / "medium"); }
  void move_to_medium() const {
    for (const char* end : {"", "-wal"})
      if (fs::exists(file_.string() + end)) fs::rename(file_.string() + end, medium_.string() + end);
  }
  const fs::path medium_ = folder_ / "medium/run 100%?.sqlite";
};

TEST_F(ArchiveOnReadOnlyMedium, IsRead) {
  fill();
  move_to_medium();
  const auto wrong = reading_without_writing(medium_);
  if (!wrong) GTEST_SKIP() << "no mount namespaces here";
  EXPECT_EQ(*wrong, "");
}

TEST_F(ArchiveOnReadOnlyMedium, OfAnEarlierVersionIsRead) {
  fill();
  SQLite::Database(file_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA journal_mode = WAL");
  move_to_medium();
  const auto wrong = reading_without_writing(medium_);
  if (!wrong) GTEST_SKIP() << "no mount namespaces here";
  EXPECT_EQ(*wrong, "");
}

TEST_F(ArchiveOnReadOnlyMedium, WithItsLogIsRefusedWithWhatToDo) {
  fill();
  {
    RunArchive writer = open();
    writer.add_generation({0, 0, 0, 0, 0.0, "a", "b"}, {}, {});
    fs::copy_file(file_, medium_);
    fs::copy_file(file_.string() + "-wal", medium_.string() + "-wal");
  }
  const auto wrong = reading_without_writing(medium_);
  if (!wrong) GTEST_SKIP() << "no mount namespaces here";
  EXPECT_NE(wrong->find("copy it and " + medium_.string() + "-wal to another folder"), std::string::npos) << *wrong;
}

TEST_F(ArchiveOnReadOnlyMedium, WithHalfAChangeIsRefusedWithWhatToDo) {
  fill();
  copy_with_half_a_change(file_, medium_);
  const auto wrong = reading_without_writing(medium_);
  if (!wrong) GTEST_SKIP() << "no mount namespaces here";
  EXPECT_NE(wrong->find("copy it and " + medium_.string() + "-journal to another folder"), std::string::npos) << *wrong;
}

TEST_F(Archive, RefusesPlacesWhereNoFileCanBe) {
  io::write_whole(folder_ / "file", "x");
  EXPECT_THROW((void)RunArchive::open(folder_ / "file/run.sqlite", study, 1), io::InputError);
  EXPECT_THROW((void)RunArchive::open(folder_, study, 1), io::InputError);
  EXPECT_THROW((void)RunArchive::open("", study, 1), io::InputError) << "SQLite would make a database that vanishes";
  EXPECT_THROW((void)RunArchive::open_to_read(folder_ / "missing.sqlite"), io::InputError);
  EXPECT_EQ(io::read_whole(folder_ / "file"), "x");
  EXPECT_FALSE(fs::exists(folder_ / "missing.sqlite")) << "reading must not make an archive";
}

TEST(DesignHash, LeavesOutArrangementsThatDoNotMatterAtALevel) {
  Phenotype first = some_individual(1, BodyPlan::nonfractal).phenotype;
  Phenotype second = first;
  second.arrangement_of_arrangements = meshes::Polycube(3, 3, 3);
  second.arrangement_of_arrangements.set({1, 1, 1}, 1);
  ASSERT_NE(first, second);
  EXPECT_EQ(design_hash(first, 1), design_hash(second, 1));
  EXPECT_EQ(design_hash(first, 2), design_hash(second, 2));
  EXPECT_NE(design_hash(first, 3), design_hash(second, 3));
  second.arrangement.set({0, 0, 0}, second.arrangement.at({0, 0, 0}) == 0 ? 1 : 0);
  EXPECT_EQ(design_hash(first, 1), design_hash(second, 1));
  EXPECT_NE(design_hash(first, 2), design_hash(second, 2));
}

}  // namespace
}  // namespace menger::evolution
