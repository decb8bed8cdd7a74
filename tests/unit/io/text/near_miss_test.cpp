#include "io/text/near_miss.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace menger::io {
namespace {

TEST(NearMiss, IsTheWordThatFewestChangesLeadTo) {
  const std::vector<std::string> words{"time", "times", "duration_s", "ground"};
  EXPECT_EQ(near_miss("tims", words), "time");
  EXPECT_EQ(near_miss("timess", words), "times");
  EXPECT_EQ(near_miss("durationn", words), "duration_s");
  EXPECT_EQ(near_miss("gruond", words), "ground");
  EXPECT_EQ(near_miss("wakl", std::vector<std::string>{"drive", "walk"}), "walk");
}

TEST(NearMiss, IsNothingForAnotherWord) {
  const std::vector<std::string> words{"time", "ground"};
  EXPECT_EQ(near_miss("gas", words), std::nullopt);
  EXPECT_EQ(near_miss("friction", words), std::nullopt);
  EXPECT_EQ(near_miss("time", {}), std::nullopt);
}

TEST(NearMiss, MayLackAUnit) {
  const std::vector<std::string> words{"frequency_Hz", "pressure_Pa", "pressure_ratio"};
  EXPECT_EQ(near_miss("frequency", words), "frequency_Hz");
  EXPECT_EQ(near_miss("pressure", words), std::nullopt);  // it may be either
  EXPECT_EQ(near_miss("freq", words), std::nullopt);
  EXPECT_EQ(near_miss("volume", std::vector<std::string>{"volume_ratio", "volume_change"}), std::nullopt);
}

}  // namespace
}  // namespace menger::io
