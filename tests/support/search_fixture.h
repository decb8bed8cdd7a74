#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "evolution/search/search.h"
#include "tests/support/archive_content.h"
#include "tests/support/fake_evaluator.h"
#include "tests/support/fake_judge.h"
#include "tests/support/test_folder.h"

namespace menger::tests {

/// A search that is over at once.
inline evolution::SearchPlan small_plan(std::uint64_t seed = 3) {
  evolution::SearchPlan plan;
  plan.seed = seed;
  plan.generations = 6;
  plan.survivors = 6;
  plan.mutants = 6;
  return plan;
}

/// Searches with fake evaluators, by the names of their archives.
class SearchFixture : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / (name + ".sqlite"); }
  [[nodiscard]] evolution::RunArchive open(const std::string& name) const {
    return evolution::RunArchive::open(file(name), "a study", 1);
  }

  /// With the judge and with half the step where the plan asks for them.
  io::RunStatus search(const std::string& name, const evolution::SearchPlan& plan, const evolution::SearchOptions& options = {}) {
    evolution::RunArchive archive = open(name);
    return run_search(plan, evaluator_, archive, options, plan.judging ? &judge_ : nullptr, plan.step_checks ? &half_ : nullptr);
  }

  /// The archive after a search that completes.
  [[nodiscard]] evolution::RunArchive searched(const evolution::SearchPlan& plan, const std::string& name = "run") {
    EXPECT_EQ(search(name, plan), io::RunStatus::completed);
    return open(name);
  }

  /// @param names of the archives, before the number of threads
  void expect_the_same_for_any_threads(const evolution::SearchPlan& plan, const std::string& names = "threads_") {
    std::string expected;
    for (const int threads : {1, 2, 8}) {
      const std::string name = names + std::to_string(threads);
      evolution::SearchOptions options;
      options.threads = threads;
      ASSERT_EQ(search(name, plan, options), io::RunStatus::completed);
      const std::string content = test_support::archive_content(file(name));
      if (threads == 1) expected = content;
      EXPECT_EQ(content, expected) << threads << " threads";
    }
  }

  /// Which commits of a search stop it in turn: all, or some.
  struct Stops {
    std::size_t stride = 1;
    std::size_t spared = 0;  ///< last commits after which nothing remains to be stopped
    int threads = 1;
    std::uint64_t rounds = 0;  ///< of judging, that a search which goes on needs at most
  };

  /// A search that was stopped goes on to the archive of one that was not, and judges little anew.
  void expect_the_same_after_stops(const evolution::SearchPlan& plan, const Stops& stops) {
    std::size_t commits = 0;
    evolution::SearchOptions counting;
    counting.after_commit = [&](std::size_t count) { commits = count; };
    ASSERT_EQ(search("whole", plan, counting), io::RunStatus::completed);
    const std::string expected = test_support::archive_content(file("whole"));
    ASSERT_GT(commits, 1 + stops.spared);
    for (std::size_t last = 1; last + stops.spared < commits; last += stops.stride) {
      const std::string name = "stopped_" + std::to_string(last);
      std::atomic<bool> stop{false};
      evolution::SearchOptions options;
      options.threads = stops.threads;
      options.stop = &stop;
      options.after_commit = [&](std::size_t count) { stop = count >= last; };
      ASSERT_EQ(search(name, plan, options), io::RunStatus::stopped) << last;
      const std::uint64_t rounds_before = judge_.calls();
      ASSERT_EQ(search(name, plan), io::RunStatus::completed);
      EXPECT_EQ(test_support::archive_content(file(name)), expected) << "stopped after commit " << last;
      EXPECT_LE(judge_.calls() - rounds_before, stops.rounds);
    }
  }

  const TestFolder folder_;
  test_support::FakeEvaluator evaluator_;

  /// With "half the step" robots go whole tenths of body lengths, and more of them diverge.
  test_support::FakeEvaluator half_{{.failing = 0.3, .coarse = true, .cell_edge_m = 0.01, .before_result = {}}};
  test_support::FakeJudge judge_;
};

}  // namespace menger::tests
