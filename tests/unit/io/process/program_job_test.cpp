#include "io/process/program_job.h"

#include <gtest/gtest.h>

#include "io/text/input_error.h"
#include "io/text/whole_file.h"
#include "tests/support/test_folder.h"

namespace menger::io {
namespace {

namespace fs = std::filesystem;

/// A folder with a shell script that notes its calls in the file `calls`.
class ProgramJobTest : public testing::Test {
 protected:
  ProgramJobTest() { options_.runs = folder_ / "runs"; }

  [[nodiscard]] ProgramJob script(const std::string& lines) const {
    const fs::path file = folder_ / "script";
    write_whole(file, "#!/bin/sh\necho call >>'" + (folder_ / "calls").string() + "'\n" + lines + "\n");
    fs::permissions(file, fs::perms::owner_all);
    ProgramJob job;
    job.name = "job";
    job.program = file;
    job.arguments = {"input.txt"};
    job.inputs = {{"input.txt", "content"}};
    return job;
  }

  [[nodiscard]] std::size_t calls() const { return read_whole(folder_ / "calls").size() / 5; }

  const tests::TestFolder folder_;
  ProgramJobOptions options_;
};

TEST_F(ProgramJobTest, RunsInAFolderWithItsInputs) {
  const ProgramJobResult result = run_job(script("cp \"$1\" copy"), options_);
  EXPECT_TRUE(result.has_result());
  EXPECT_TRUE(result.repeated);
  EXPECT_EQ(read_whole(result.folder / "copy"), "content");
}

TEST_F(ProgramJobTest, FinishedRunsAreNotRepeatedAndKeepTheirCosts) {
  const ProgramJob job = script("sleep 0.05; exit 3");
  const ProgramJobResult first = run_job(job, options_);
  const ProgramJobResult second = run_job(job, options_);
  EXPECT_EQ(calls(), 1U);
  EXPECT_TRUE(second.has_result());
  EXPECT_FALSE(second.repeated);
  EXPECT_EQ(second.outcome.exit_code, 3);
  EXPECT_EQ(second.outcome.wall_s, first.outcome.wall_s);
  EXPECT_EQ(second.outcome.cpu_s, first.outcome.cpu_s);
  EXPECT_EQ(second.outcome.peak_memory_bytes, first.outcome.peak_memory_bytes);
}

TEST_F(ProgramJobTest, OtherInputArgumentsOrProgramIsAnotherRun) {
  ProgramJob job = script("");
  const std::string hash = job_hash(job);
  ProgramJob other = job;
  other.inputs["input.txt"] = "other";
  EXPECT_NE(job_hash(other), hash);
  other = job;
  other.arguments.emplace_back("-x");
  EXPECT_NE(job_hash(other), hash);
  other = script("exit 0");
  EXPECT_NE(job_hash(other), hash);
  EXPECT_EQ(job_hash(script("")), hash);
}

TEST_F(ProgramJobTest, FailuresAreToldAndTriedAgain) {
  const ProgramJob job = script("echo first >&2; echo 'key = 3: must be 4' >&2; exit 2");
  const ProgramJobResult result = run_job(job, options_);
  EXPECT_FALSE(result.has_result());
  EXPECT_EQ(result.failure(), "exit code 2: key = 3: must be 4");
  (void)run_job(job, options_);
  EXPECT_EQ(calls(), 2U);
}

TEST_F(ProgramJobTest, ARunWhoseTimeWasUpIsTriedAgainWithMoreTimeOnly) {
  ProgramJob job = script("trap 'exit 130' INT; while :; do sleep 0.02; done");
  job.time_limit_s = 0.5;  // within which the shell has noted its call on a busy machine, too
  EXPECT_EQ(run_job(job, options_).outcome.end, ChildEnd::timed_out);
  const ProgramJobResult again = run_job(job, options_);
  EXPECT_EQ(calls(), 1U);
  EXPECT_FALSE(again.has_result());
  EXPECT_NE(again.failure().find("time limit"), std::string::npos);
  job.time_limit_s = 1.0;
  (void)run_job(job, options_);
  EXPECT_EQ(calls(), 2U);
}

TEST_F(ProgramJobTest, AResultThatComesJustAtTheTimeLimitIsKept) {
  ProgramJob job = script("trap 'exit 0' INT; while :; do sleep 0.02; done");
  job.time_limit_s = 0.5;
  EXPECT_TRUE(run_job(job, options_).has_result());
  const ProgramJobResult again = run_job(job, options_);
  EXPECT_TRUE(again.has_result());
  EXPECT_FALSE(again.repeated);
  EXPECT_EQ(calls(), 1U);
}

TEST_F(ProgramJobTest, AStoppedRunBeginsAgainInAnEmptyFolder) {
  const std::string flag = "'" + (folder_ / "second").string() + "'";
  const ProgramJob job = script("if [ -e " + flag + " ]; then test ! -e left; exit; fi; trap 'exit 130' INT; touch left " + flag +
                                "; while :; do sleep 0.02; done");
  std::atomic<bool> stop{false};
  options_.stop = &stop;
  options_.waiting = [&](double) { stop = fs::exists(folder_ / "second"); };
  EXPECT_TRUE(run_job(job, options_).is_stopped());
  stop = false;
  options_.waiting = nullptr;  // it would stop the second run if that has to be waited for
  EXPECT_TRUE(run_job(job, options_).has_result());
  EXPECT_EQ(calls(), 2U);
}

TEST_F(ProgramJobTest, AKeptFolderKeepsWhatIsThereAndIsAlwaysCalled) {
  ProgramJob job = script("echo x >>grows");
  job.kept_folder = folder_ / "kept";
  (void)run_job(job, options_);
  (void)run_job(job, options_);
  EXPECT_EQ(read_whole(job.kept_folder / "grows"), "x\nx\n");
}

TEST_F(ProgramJobTest, AMissingProgramIsWrongInput) {
  ProgramJob job = script("");
  job.program = folder_ / "missing";
  EXPECT_THROW((void)run_job(job, options_), InputError);
}

}  // namespace
}  // namespace menger::io
