#include "io/ranks/rank_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "io/text/input_error.h"
#include "tests/support/wait_until.h"

namespace menger::io {
namespace {

const RankWork doubled = [](const std::string& task, const std::atomic<bool>&, const std::function<int()>&) {
  if (task == "wrong") throw InputError("a wrong task");
  return task + task;
};

/// A team of the one process that nobody started as a rank.
class TeamOfOne : public testing::Test {
 protected:
  [[nodiscard]] RankTeam team(const RankWork& work = doubled, int threads = 2) {
    return {session_, work, call_roll(session_, facts_of(session_, threads, {}), 1.0), {.threads = threads}};
  }

  RankSession session_;
};

TEST_F(TeamOfOne, IsARankAlone) {
  EXPECT_EQ(session_.count(), 1);
  EXPECT_TRUE(session_.is_first());
  EXPECT_GE(session_.usual_threads(), 1);
  EXPECT_EQ(team().threads(), 2);
}

TEST_F(TeamOfOne, HandsOverEachResultUnderItsTask) {
  std::map<std::size_t, std::string> results;
  RankTeam one = team();
  for (int again = 0; again < 2; ++again) {
    results.clear();
    const RunStatus status = one.run({"a", "b", "c"}, nullptr, [&](std::size_t task, const std::string& result) {
      EXPECT_TRUE(results.emplace(task, result).second);
      return std::vector<std::string>();
    });
    EXPECT_EQ(status, RunStatus::completed);
    EXPECT_EQ(results, (std::map<std::size_t, std::string>{{0, "aa"}, {1, "bb"}, {2, "cc"}}));
  }
}

TEST_F(TeamOfOne, DoesTasksThatFollowFromResults) {
  std::vector<std::string> results;
  const RunStatus status = team(doubled, 1).run({"a"}, nullptr, [&](std::size_t task, const std::string& result) {
    EXPECT_EQ(task, results.size());
    results.push_back(result);
    return results.size() < 4 ? std::vector<std::string>{result} : std::vector<std::string>();
  });
  EXPECT_EQ(status, RunStatus::completed);
  EXPECT_EQ(results, (std::vector<std::string>{"aa", "aaaa", std::string(8, 'a'), std::string(16, 'a')}));
}

TEST_F(TeamOfOne, BeginsWithTheFirstTasks) {
  std::vector<std::size_t> order;
  (void)team(doubled, 1).run({"a", "b", "c"}, nullptr, [&](std::size_t task, const std::string&) {
    order.push_back(task);
    return std::vector<std::string>();
  });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2}));
}

TEST_F(TeamOfOne, EndsWithWhatATaskOrItsReceiverThrows) {
  const auto nothing = [](std::size_t, const std::string&) { return std::vector<std::string>(); };
  EXPECT_THROW((void)team().run({"a", "wrong", "b"}, nullptr, nothing), InputError);
  const auto full = [](std::size_t, const std::string&) -> std::vector<std::string> { throw std::runtime_error("disk full"); };
  EXPECT_THROW((void)team().run({"a", "b"}, nullptr, full), std::runtime_error);
}

TEST_F(TeamOfOne, HasAllItsThreadsAfterRunsThatThrew) {
  RankTeam one = team([](const std::string& task, const std::atomic<bool>& stop, const std::function<int()>&) {
    while (task == "slow" && !stop) std::this_thread::yield();
    return task + task;
  });
  std::atomic<bool> is_over{false};
  std::atomic<bool> stop{false};
  const std::jthread ends_a_test_that_fails([&] {
    (void)test_support::wait_until([&] { return is_over.load(); });
    stop = true;
  });
  const auto full = [](std::size_t, const std::string&) -> std::vector<std::string> { throw std::runtime_error("disk full"); };
  for (int times = 0; times < 2; ++times) EXPECT_THROW((void)one.run({"slow", "a"}, &stop, full), std::runtime_error);
  std::map<std::size_t, std::string> results;
  const RunStatus status = one.run({"b", "c"}, &stop, [&](std::size_t task, const std::string& result) {
    results[task] = result;
    return std::vector<std::string>();
  });
  is_over = true;
  EXPECT_EQ(status, RunStatus::completed);
  EXPECT_EQ(results, (std::map<std::size_t, std::string>{{0, "bb"}, {1, "cc"}}));
}

TEST_F(TeamOfOne, MayBeEndedByWhatReceivesResults) {
  RankTeam one = team();
  int handed_over = 0;
  const RunStatus status = one.run(std::vector<std::string>(100, "a"), nullptr,
                                   [&](std::size_t, const std::string&) -> std::optional<std::vector<std::string>> {
                                     if (++handed_over == 3) return std::nullopt;
                                     return std::vector<std::string>();
                                   });
  EXPECT_EQ(status, RunStatus::completed);
  EXPECT_EQ(handed_over, 3);
  std::vector<std::string> results;
  (void)one.run({"b"}, nullptr, [&](std::size_t, const std::string& result) {
    results.push_back(result);
    return std::vector<std::string>();
  });
  EXPECT_EQ(results, std::vector<std::string>{"bb"}) << "nothing of the run before";
}

TEST_F(TeamOfOne, CountsItsTasks) {
  RankTeam one = team();
  (void)one.run({"a", "b"}, nullptr, [](std::size_t, const std::string&) { return std::vector<std::string>(); });
  EXPECT_EQ(one.shares().find("each process did from 2 (rank 0 on "), 0U) << one.shares();
}

TEST(RankMessages, HaveASizeThatMpiCanSend) {
  EXPECT_EQ(message_size(0), 0);
  EXPECT_EQ(message_size(std::size_t{0x7fffffff}), 0x7fffffff);
  EXPECT_THROW((void)message_size(std::size_t{0x80000000}), std::length_error);
  EXPECT_THROW((void)message_size(std::size_t{0x100000001}), std::length_error) << "not one byte";
}

TEST_F(TeamOfOne, StopsAndHandsOverWhatEndsWhenItIsToldTo) {
  std::atomic<bool> stop{false};
  const RankWork slow = [&](const std::string& task, const std::atomic<bool>& told, const std::function<int()>&) {
    while (task != "a" && !told) std::this_thread::yield();
    return task + task;
  };
  std::map<std::size_t, std::string> results;
  const RunStatus status = team(slow).run({"a", "b", "c", "d"}, &stop, [&](std::size_t task, const std::string& result) {
    results[task] = result;
    if (task == 0) stop = true;
    return std::vector<std::string>();
  });
  EXPECT_EQ(status, RunStatus::stopped);
  EXPECT_EQ(results, (std::map<std::size_t, std::string>{{0, "aa"}, {1, "bb"}})) << "and no task begins";
}

TEST_F(TeamOfOne, StopsAndHandsOverWhatWasDone) {
  std::atomic<bool> stop{false};
  int handed_over = 0;
  const RunStatus status = team(doubled, 1).run(std::vector<std::string>(1000, "a"), &stop, [&](std::size_t, const std::string&) {
    if (++handed_over == 3) stop = true;
    return std::vector<std::string>();
  });
  EXPECT_EQ(status, RunStatus::stopped);
  EXPECT_LT(handed_over, 1000);
}

}  // namespace
}  // namespace menger::io
