#include "io/text/formatted.h"

#include <gtest/gtest.h>

#include "io/text/run_status_words.h"

namespace menger::io {
namespace {

TEST(Formatted, IsWhatTheFormatSays) {
  EXPECT_EQ(formatted("%.3g kPa", 1.23456), "1.23 kPa");
  EXPECT_EQ(formatted("%.1f", 1e300).size(), 301U + 2U) << "however long";
}

TEST(Shown, HasSoManySignificantDigitsAndNoZerosBehindThem) {
  EXPECT_EQ(shown(1.23456), "1.235");
  EXPECT_EQ(shown(2.0), "2");
  EXPECT_EQ(shown(-1.23456e-7, 3), "-1.23e-07");
}

TEST(Padded, PutsZerosBeforeAShortNumberOnly) {
  EXPECT_EQ(padded(7, 4), "0007");
  EXPECT_EQ(padded(12345, 4), "12345");
}

TEST(ColumnPart, KeepsLettersAndDigits) { EXPECT_EQ(column_part("plenum 0, top"), "plenum_0__top"); }

TEST(RunStatusWords, AreTheWordsOfAllStatuses) {
  EXPECT_EQ(run_status_words().size(), 8U);
  for (const auto& [word, status] : run_status_words()) EXPECT_EQ(word, to_string(status));
}

TEST(Formatted, CountsInWords) {
  EXPECT_EQ(counted(1, "chamber"), "1 chamber");
  EXPECT_EQ(counted(0, "chamber"), "0 chambers");
  EXPECT_EQ(counted(12, "boundary face"), "12 boundary faces");
  EXPECT_EQ(counted(2, "body", "bodies"), "2 bodies");
  EXPECT_EQ(counted(1, "body", "bodies"), "1 body");
}

}  // namespace
}  // namespace menger::io
