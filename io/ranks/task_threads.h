#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace menger::io {

/// What a rank does with a task: from its bytes to those of its result. Called by several threads at once.
/// @param stop when set, it returns soon; what it returns then may be a part of the result
/// @param threads returns how many threads the task may use now, >= 1, its own included; the number changes
using RankWork =
    std::function<std::string(const std::string& task, const std::atomic<bool>& stop, const std::function<int()>& threads)>;

/// The threads of a rank, each with a task at a time.
class TaskThreads {
 public:
  /// @param threads >= 1; may be more than the machine has cores @throws std::system_error if they cannot be started
  TaskThreads(int threads, RankWork work);

  /// Drops what is not done, and waits for its threads.
  ~TaskThreads();
  TaskThreads(const TaskThreads&) = delete;
  TaskThreads& operator=(const TaskThreads&) = delete;

  /// A task that is done.
  struct Done {
    std::uint64_t id = 0;
    std::string result;
    std::exception_ptr fault;  ///< what the work threw instead
  };

  /// Gives a task to the next free thread.
  void begin(std::uint64_t id, std::string task);

  /// Returns a task that is done, and waits for one up to a time.
  [[nodiscard]] std::optional<Done> take(std::chrono::microseconds patience);

  /// Returns how many more tasks could begin at once.
  [[nodiscard]] int free() const;

  /// Makes the tasks that are under way return soon, and waits for them. Their results can be taken. No further task begins.
  void stop();

 private:
  struct Task {
    std::uint64_t id = 0;
    std::string bytes;
  };
  void work_on();

  RankWork work_;
  int threads_that_run_;
  int count_;
  std::atomic<bool> stop_{false};
  std::atomic<int> busy_{0};
  mutable std::mutex access_;
  std::condition_variable_any has_task_;
  std::condition_variable has_done_;
  std::deque<Task> waiting_;
  std::deque<Done> done_;
  std::size_t under_way_ = 0;
  std::vector<std::jthread> threads_;  ///< last, so that they end first
};

}  // namespace menger::io
