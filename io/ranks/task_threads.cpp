#include "io/ranks/task_threads.h"

#include <oneapi/tbb/info.h>

#include <algorithm>
#include <utility>

namespace menger::io {

TaskThreads::TaskThreads(int threads, RankWork work)
    : work_(std::move(work)), threads_that_run_(std::min(threads, oneapi::tbb::info::default_concurrency())), count_(threads) {
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int n = 0; n < threads; ++n) threads_.emplace_back([this] { work_on(); });
  } catch (...) {
    stop();  // those that have begun would wait for tasks for ever
    throw;
  }
}

TaskThreads::~TaskThreads() { stop(); }

void TaskThreads::begin(std::uint64_t id, std::string task) {
  const std::lock_guard guard(access_);
  waiting_.push_back({id, std::move(task)});
  has_task_.notify_one();
}

std::optional<TaskThreads::Done> TaskThreads::take(std::chrono::microseconds patience) {
  std::unique_lock lock(access_);
  if (!has_done_.wait_for(lock, patience, [&] { return !done_.empty(); })) return std::nullopt;
  Done one = std::move(done_.front());
  done_.pop_front();
  return one;
}

int TaskThreads::free() const {
  const std::lock_guard guard(access_);
  return count_ - static_cast<int>(waiting_.size() + under_way_);
}

void TaskThreads::stop() {
  {
    const std::lock_guard guard(access_);
    stop_ = true;
    waiting_.clear();
    has_task_.notify_all();
  }
  threads_.clear();  // joins
}

void TaskThreads::work_on() {
  // Tasks share the threads that have none.
  const auto threads = [this] { return std::max(1, threads_that_run_ / std::max(1, busy_.load())); };
  std::unique_lock lock(access_);
  while (true) {
    has_task_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
    if (stop_) return;
    const Task task = std::move(waiting_.front());
    waiting_.pop_front();
    ++under_way_;
    ++busy_;
    lock.unlock();
    Done done{.id = task.id, .result = {}, .fault = {}};
    try {
      done.result = work_(task.bytes, stop_, threads);
    } catch (...) {
      done.fault = std::current_exception();
    }
    lock.lock();
    --busy_;
    --under_way_;
    done_.push_back(std::move(done));
    has_done_.notify_one();
  }
}

}  // namespace menger::io
