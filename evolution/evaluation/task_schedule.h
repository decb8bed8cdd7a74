#pragma once

#include <cstddef>
#include <span>

namespace menger::evolution {

/// A task that took a known time, with the cost that was expected of it.
struct TimedTask {
  double seconds = 0.0;  ///< >= 0
  double cost = 0.0;     ///< in any unit; decides the order only
};

enum class TaskOrder {
  as_asked,        ///< as they stand
  costliest_first  ///< by expected cost, of equals as they stand: what WorkerPool does
};

/// What workers make of a list of tasks that are all known at the start.
struct Schedule {
  double makespan_s = 0.0;    ///< until the last task is done
  double busy_s = 0.0;        ///< of all workers together: the sum of the tasks
  double straggling_s = 0.0;  ///< of the makespan, while some worker has nothing left to do
};

/// List scheduling: a worker that is free takes the next task of the list; of several free ones the first.
///
/// It takes at most 2 - 1/m times the best possible time on m workers, costliest first with true costs at most 4/3 - 1/(3 m)
/// times it. @cite graham1969bounds
/// @param workers >= 1
Schedule list_schedule(std::span<const TimedTask> tasks, std::size_t workers, TaskOrder order);

/// What no schedule can go below, s: the longest task, and the sum over the workers.
double least_makespan_s(std::span<const TimedTask> tasks, std::size_t workers);

}  // namespace menger::evolution
