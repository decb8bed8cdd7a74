#include "evolution/evaluation/task_schedule.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace menger::evolution {

Schedule list_schedule(std::span<const TimedTask> tasks, std::size_t workers, TaskOrder order) {
  assert(workers >= 1);
  std::vector<TimedTask> list(tasks.begin(), tasks.end());
  if (order == TaskOrder::costliest_first) std::ranges::stable_sort(list, std::ranges::greater{}, &TimedTask::cost);
  std::vector<double> free_at_s(workers, 0.0);
  Schedule schedule;
  for (const TimedTask& task : list) {
    *std::ranges::min_element(free_at_s) += task.seconds;
    schedule.busy_s += task.seconds;
  }
  schedule.makespan_s = *std::ranges::max_element(free_at_s);
  // No worker waits before the first one has nothing left to do: until then the list is not empty.
  schedule.straggling_s = schedule.makespan_s - *std::ranges::min_element(free_at_s);
  return schedule;
}

double least_makespan_s(std::span<const TimedTask> tasks, std::size_t workers) {
  assert(workers >= 1);
  double longest = 0.0;
  double sum = 0.0;
  for (const TimedTask& task : tasks) {
    longest = std::max(longest, task.seconds);
    sum += task.seconds;
  }
  return std::max(longest, sum / static_cast<double>(workers));
}

}  // namespace menger::evolution
