#include "io/text/formatted.h"

#include <gtest/gtest.h>

#include "io/text/run_status_words.h"

namespace menger::io {
namespace {

TEST(Formatted, IsWhatTheFormatSays) {
  EXPECT_EQ(formatted("%.3g kPa", 1.23456), "1.23 kPa");
  EXPECT_EQ(formatted("%.1f", 1e300).size(), 301U + 2U) << "however long";
}

TEST(RunStatusWords, AreTheWordsOfAllStatuses) {
  EXPECT_EQ(run_status_words().size(), 7U);
  for (const auto& [word, status] : run_status_words()) EXPECT_EQ(word, to_string(status));
}

}  // namespace
}  // namespace menger::io
