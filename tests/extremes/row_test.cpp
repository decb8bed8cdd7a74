// The checks of a row must be able to fail.

#include "tests/extremes/row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "io/process/exit_code.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/extremes/table.h"
#include "tests/support/program_run.h"
#include "tests/support/test_folder.h"

namespace menger::extremes {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_as_expected(const std::function<void(Outcome&)>& run) {
  return run_row({.name = "row", .done = {}, .expected = {}, .run = run}).is_as_expected;
}

TEST(Outcome, HoldsWithinItsTolerance) {
  EXPECT_TRUE(is_as_expected([](Outcome& outcome) { outcome.expect_near("a", 1.009, 1.0, 0.01); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_near("a", 1.011, 1.0, 0.01); }));
  EXPECT_TRUE(is_as_expected([](Outcome& outcome) { outcome.expect_at_most("a", -2.0, 2.0); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_at_most("a", -2.1, 2.0); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_between("a", 0.9, 1.0, 2.0); }));
}

TEST(Outcome, IsNeverExpectedToBeNotANumber) {
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_near("a", nan, 1.0, 0.01); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_at_most("a", nan, 1.0); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_between("a", nan, 0.0, 1.0); }));
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) { outcome.expect_energy_error(nan, 1.0); }));
}

TEST(Outcome, OneFailureIsNotMendedByWhatFollows) {
  EXPECT_FALSE(is_as_expected([](Outcome& outcome) {
    outcome.expect_status(io::RunStatus::diverged, io::RunStatus::completed);
    outcome.expect_status(io::RunStatus::completed, io::RunStatus::completed);
  }));
}

TEST(Outcome, KeepsTheLargestEnergyError) {
  Outcome outcome;
  for (const double error : {1e-3, -2e-2, 1e-4}) outcome.expect_energy_error(error, 0.1);
  EXPECT_EQ(outcome.energy_error(), 2e-2);
}

TEST(Row, ThatThrowsOrLooksAtNothingIsNotAsExpected) {
  EXPECT_FALSE(is_as_expected([](Outcome&) { throw std::runtime_error("out of reach"); }));
  EXPECT_FALSE(is_as_expected([](Outcome&) {}));
}

class Table : public testing::Test {
 protected:
  const tests::TestFolder scratch_;
  const fs::path folder_ = scratch_ / "new";  ///< does not exist before a test writes
};

Row row(const std::string& name, bool holds, bool is_slow) {
  return {.name = name, .done = "a | b", .expected = "c", .is_slow = is_slow, .run = [holds](Outcome& outcome) {
            outcome.expect(holds, "d");
          }};
}

TEST_F(Table, HoldsSlowRowsOnlyInFullRuns) {
  const Part part{.name = "voxel", .rows = {row("fast", true, false), row("slow", false, true)}};
  EXPECT_EQ(run_part(part, false, folder_), io::exit_code::done);
  EXPECT_EQ(io::read_csv(part_file(folder_, "voxel")).row_count(), 1U);
  EXPECT_EQ(run_part(part, true, folder_), io::exit_code::numerical);
  const io::CsvContents table = io::read_csv(part_file(folder_, "voxel"));
  ASSERT_EQ(table.row_count(), 2U);
  EXPECT_EQ(table.text(0, "as_expected"), "yes");
  EXPECT_EQ(table.text(1, "as_expected"), "no");
}

TEST_F(Table, OfAllPartsIsJoined) {
  for (const char* name : {"voxel", "fem"}) {
    EXPECT_EQ(run_part({.name = name, .rows = {row("one", true, false)}}, false, folder_), io::exit_code::done);
  }
  EXPECT_EQ(run_part({.name = "calibration", .rows = {row("two", false, false)}}, false, folder_), io::exit_code::numerical);
  join_parts(folder_, {"voxel", "fem", "calibration"}, false);
  EXPECT_EQ(io::read_csv(folder_ / "extremes.csv").row_count(), 3U);
  EXPECT_FALSE(fs::exists(part_file(folder_, "voxel")));
  const std::string markdown = io::read_whole(folder_ / "extremes.md");
  EXPECT_NE(markdown.find("| one | a \\| b | c | d |"), std::string::npos) << markdown;
  EXPECT_NE(markdown.find("2 of 3 cases"), std::string::npos) << markdown;
  EXPECT_THROW(join_parts(folder_, {"voxel"}, false), io::InputError);
}

TEST_F(Table, SaysHowItWasMade) {
  const Part part{.name = "voxel", .rows = {row("one", true, false)}};
  const auto introduction = [&](bool is_full) {
    EXPECT_EQ(run_part(part, is_full, folder_), io::exit_code::done);
    join_parts(folder_, {"voxel"}, is_full);
    const std::string markdown = io::read_whole(folder_ / "extremes.md");
    return markdown.substr(0, markdown.find("\n##"));
  };
  EXPECT_NE(introduction(true).find("`menger extremes --part voxel --full`:"), std::string::npos);
  EXPECT_NE(introduction(false).find("`menger extremes --part voxel`, without the slow cases:"), std::string::npos);
}

/// The copied program finds the parts beside it. Built parts are links to /bin/true, which does nothing.
TEST_F(Table, IsNotWrittenWhilePartsAreNotBuilt) {
  fs::create_directories(folder_ / "bin");
  fs::copy_file(fs::path(MENGER_PROGRAM_DIR) / "menger-extremes", folder_ / "bin/menger-extremes");
  fs::create_symlink("/bin/true", folder_ / "bin/menger-extremes-voxel");
  const test_support::Outcome outcome = test_support::ProgramRun(folder_, folder_ / "bin/menger-extremes", {"-o", "out"}).wait();
  EXPECT_EQ(outcome.code, io::exit_code::bad_input);
  EXPECT_NE(outcome.err.find("menger-extremes-fem, "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("menger-extremes-calibration"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("menger-extremes-voxel"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace menger::extremes
