#include "io/text/run_status.h"

#include <gtest/gtest.h>

#include "io/text/input_error.h"
#include "io/text/run_status_words.h"

namespace menger::io {
namespace {

TEST(RunStatus, HasOneWordForEachOutcome) {
  EXPECT_EQ(to_string(RunStatus::completed), "completed");
  EXPECT_EQ(to_string(RunStatus::diverged), "diverged");
  EXPECT_EQ(to_string(RunStatus::not_converged), "not_converged");
  EXPECT_EQ(to_string(RunStatus::limit_point), "limit_point");
  EXPECT_EQ(to_string(RunStatus::inverted_element), "inverted_element");
  EXPECT_EQ(to_string(RunStatus::wall_contact), "wall_contact");
  EXPECT_EQ(to_string(RunStatus::fell), "fell");
  EXPECT_EQ(to_string(RunStatus::stopped), "stopped");
}

TEST(RunStatus, IsFoundByItsWord) {
  for (const auto& [word, status] : run_status_words()) EXPECT_EQ(run_status_of(word), status);
  EXPECT_THROW(run_status_of("done"), InputError);
}

TEST(RunStatus, IsFoundByItsNumber) {
  for (const auto& [word, status] : run_status_words()) EXPECT_EQ(run_status_of(static_cast<int>(status)), status) << word;
  EXPECT_THROW(run_status_of(-1), InputError);
  EXPECT_THROW(run_status_of(static_cast<int>(run_status_words().size())), InputError);
}

}  // namespace
}  // namespace menger::io
