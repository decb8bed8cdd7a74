#include "io/process/checkpoint_file.h"

#include <gtest/gtest.h>

#include <string>

#include "io/text/whole_file.h"
#include "tests/support/input_error_message.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

class Checkpoint : public testing::Test {
 protected:
  [[nodiscard]] CheckpointFile of(const std::string& identity, const std::string& title = "state of a test 1") const {
    return {folder_ / "run.checkpoint", title, identity};
  }
  [[nodiscard]] static std::string refusal(const CheckpointFile& file) {
    return tests::message_of([&] { (void)file.read(); });
  }
  const tests::TestFolder folder_;
};

TEST_F(Checkpoint, GivesTheStateBackToTheSameRun) {
  EXPECT_EQ(of("a").read(), std::nullopt);
  const std::string state("1\n2\0three", 9);
  of("a").write(state);
  EXPECT_EQ(of("a").read(), state);
  of("a").write("");
  EXPECT_EQ(of("a").read(), "");
}

TEST_F(Checkpoint, IsRefusedByAnotherRunAndByAnotherVersion) {
  of("a").write("state");
  EXPECT_NE(refusal(of("b")).find("run.checkpoint: belongs to another study or another number of processes; "
                                  "give --restart to start again from the beginning"),
            std::string::npos)
      << refusal(of("b"));
  EXPECT_NE(refusal(of("a", "state of a test 2")).find("is not a checkpoint of this version of menger"), std::string::npos);
}

TEST_F(Checkpoint, IsRefusedIfAnyByteIsWrongOrMissing) {
  of("a").write("state");
  const std::string whole = read_whole(folder_ / "run.checkpoint");
  for (std::size_t n = 0; n < whole.size(); ++n) {
    std::string changed = whole;
    changed[n] = changed[n] == 'x' ? 'y' : 'x';
    write_whole(folder_ / "run.checkpoint", changed);
    EXPECT_NE(refusal(of("a")), "no error") << n;
    write_whole(folder_ / "run.checkpoint", whole.substr(0, n));
    EXPECT_NE(refusal(of("a")), "no error") << n;
  }
}

}  // namespace
}  // namespace menger::io
