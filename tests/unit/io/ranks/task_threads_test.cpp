#include "io/ranks/task_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <barrier>
#include <chrono>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "io/text/whole_file.h"

namespace menger::io {
namespace {

constexpr std::chrono::microseconds long_time = std::chrono::seconds(60);

TEST(TaskThreads, DoTasksAtTheSameTime) {
  std::barrier meeting(3);
  TaskThreads threads(3, [&](const std::string& task, const std::atomic<bool>&, const std::function<int()>&) {
    meeting.arrive_and_wait();
    return task + task;
  });
  EXPECT_EQ(threads.free(), 3);
  for (std::uint64_t id = 5; id < 8; ++id) threads.begin(id, std::to_string(id));
  std::set<std::string> results;
  for (int n = 0; n < 3; ++n) {
    const auto done = threads.take(long_time);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->result, std::to_string(done->id) + std::to_string(done->id));
    results.insert(done->result);
  }
  EXPECT_EQ(results, (std::set<std::string>{"55", "66", "77"}));
  EXPECT_EQ(threads.free(), 3);
}

TEST(TaskThreads, HandOverWhatATaskThrows) {
  TaskThreads threads(1, [](const std::string& task, const std::atomic<bool>&, const std::function<int()>&) -> std::string {
    throw std::runtime_error("no " + task);
  });
  threads.begin(1, "bread");
  const auto done = threads.take(long_time);
  ASSERT_TRUE(done && done->fault);
  EXPECT_THROW(std::rethrow_exception(done->fault), std::runtime_error);
}

TEST(TaskThreads, DropWhatHasNotBegunWhenTheyStop) {
  std::atomic<int> begun{0};
  TaskThreads threads(1, [&](const std::string&, const std::atomic<bool>& stop, const std::function<int()>&) {
    ++begun;
    while (!stop) std::this_thread::yield();
    return std::string("a part");
  });
  threads.begin(1, "");
  threads.begin(2, "");
  while (begun == 0) std::this_thread::yield();
  threads.stop();
  EXPECT_EQ(begun, 1);
  const auto done = threads.take(long_time);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->result, "a part");
  EXPECT_FALSE(threads.take(std::chrono::microseconds(0)));
}

#if !defined(__SANITIZE_ADDRESS__)  // which cannot do with little memory
/// Starts more threads than fit into the memory that this process may have, and tells by its exit code how that went.
[[noreturn]] void start_too_many_threads() {
  alarm(60);  // for threads that wait for each other
  const auto pages = static_cast<rlim_t>(std::stoull(io::read_whole("/proc/self/statm")));
  constexpr rlim_t room = 200UL << 20U;  // for some of them
  const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + room;
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  try {
    const TaskThreads threads(
        10000, [](const std::string& task, const std::atomic<bool>&, const std::function<int()>&) { return task; });
  } catch (const std::system_error&) {
    std::_Exit(3);
  }
  std::_Exit(4);
}

TEST(TaskThreads, ThatCannotAllBeStartedEnd) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(start_too_many_threads(), testing::ExitedWithCode(3), "");
}
#endif

}  // namespace
}  // namespace menger::io
