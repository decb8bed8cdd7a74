#include "io/process/progress.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace menger::io {
namespace {

TEST(ProgressLine, TellsPartTimeLeftAndNote) {
  EXPECT_EQ(progress_line("simulate", 0.25, 10.0, "3 steps/s", 79), "simulate [#####...............] 25 %, 30 s left, 3 steps/s");
}

TEST(ProgressLine, PromisesNoTimeBeforeAnythingIsDone) {
  EXPECT_EQ(progress_line("evolve", 0.0, 5.0, "", 79), "evolve [....................] 0 %");
}

TEST(ProgressLine, StaysInsideTheBarForAnyFraction) {
  EXPECT_EQ(progress_line("a", 1.5, 5.0, "", 79), "a [####################] 100 %, 0 s left");
  EXPECT_EQ(progress_line("a", -1.0, 5.0, "", 79), "a [....................] 0 %");
  EXPECT_EQ(progress_line("a", std::numeric_limits<double>::quiet_NaN(), 5.0, "", 79), "a [....................] 0 %");
}

TEST(ProgressLine, FitsItsWidth) { EXPECT_EQ(progress_line("simulate", 0.5, 1.0, std::string(200, 'x'), 40).size(), 40U); }

TEST(DurationText, ChoosesTheUnitsOfPeople) {
  EXPECT_EQ(duration_text(7.6), "8 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 05 min");
  EXPECT_EQ(duration_text(4 * 86400 + 3 * 3600), "4 d 03 h");
  EXPECT_EQ(duration_text(-1), "0 s");
}

TEST(Progress, DrawsAndClearsItsLine) {
  std::ostringstream out;
  {
    Progress progress("job", 2.0, {.out = &out, .quiet_s = 0.0, .interval_s = 0.0, .width = 79});
    progress.update(1.0);
  }
  EXPECT_NE(out.str().find("job [##########..........] 50 %"), std::string::npos);
  EXPECT_TRUE(out.str().ends_with("\r\x1b[K"));
}

TEST(Progress, DrawsNothingForAJobThatIsSoonDone) {
  std::ostringstream out;
  {
    Progress progress("job", 2.0, {.out = &out, .quiet_s = 3600.0, .interval_s = 0.0, .width = 79});
    progress.update(1.0);
    progress.clear();
  }
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, WaitsBetweenTwoDrawings) {
  std::ostringstream out;
  Progress progress("job", 2.0, {.out = &out, .quiet_s = 0.0, .interval_s = 3600.0, .width = 79});
  progress.update(1.0);
  progress.update(1.5);
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, DrawsNothingWithoutAPlace) {
  Progress progress("job", 2.0, ProgressStyle{.out = nullptr, .quiet_s = 0.0});
  EXPECT_NO_THROW(progress.update(1.0));
}

}  // namespace
}  // namespace menger::io
