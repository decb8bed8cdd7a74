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
#include "tests/support/test_folder.h"

namespace menger::tests {

/// Returns the plan of a search that takes almost no time.
inline evolution::SearchPlan small_plan(std::uint64_t seed = 3) {
  evolution::SearchPlan plan;
  plan.seed = seed;
  plan.generations = 6;
  plan.survivors = 6;
  plan.mutants = 6;
  return plan;
}

/// Searches with fake evaluators. A search is known by the name of its archive.
class SearchFixture : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / (name + ".sqlite"); }
  [[nodiscard]] evolution::RunArchive open(const std::string& name) const {
    return evolution::RunArchive::open(file(name), "a study", 1);
  }

  /// Runs a search, with half the step if the plan asks for it.
  io::RunStatus search(const std::string& name, const evolution::SearchPlan& plan, const evolution::SearchOptions& options = {}) {
    evolution::RunArchive archive = open(name);
    return run_search(plan, evaluator_, archive, options, plan.step_checks ? &half_ : nullptr);
  }

  /// Runs a search, which must complete, and opens its archive.
  [[nodiscard]] evolution::RunArchive searched(const evolution::SearchPlan& plan, const std::string& name = "run") {
    EXPECT_EQ(search(name, plan), io::RunStatus::completed);
    return open(name);
  }

  /// Expects the same archive for any number of threads. @param names start of the names of the archives, before the number of
  /// threads
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

  /// Where a search is stopped: after every `stride`-th commit.
  struct Stops {
    std::size_t stride = 1;
    std::size_t spared = 0;  ///< number of commits at the end after which there is nothing left to stop
    int threads = 1;
  };

  /// Expects that a search that was stopped and resumed gives the archive of one that was not.
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
      ASSERT_EQ(search(name, plan), io::RunStatus::completed);
      EXPECT_EQ(test_support::archive_content(file(name)), expected) << "stopped after commit " << last;
    }
  }

  const TestFolder folder_;
  test_support::FakeEvaluator evaluator_;

  /// The evaluator for "half the step": displacements are tenths of body lengths, and more robots diverge.
  test_support::FakeEvaluator half_{{.failing = 0.3, .coarse = true, .cell_edge_m = 0.01, .before_result = {}}};
};

}  // namespace menger::tests
