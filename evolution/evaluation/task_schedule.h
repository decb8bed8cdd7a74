#pragma once

#include <cstddef>
#include <span>

namespace menger::evolution {

/// A finished task: the time it took and the cost that was expected.
struct TimedTask {
  double seconds = 0.0;  ///< >= 0
  double cost = 0.0;     ///< in any unit; decides the order only
};

/// The order in which workers take the tasks of a list.
enum class TaskOrder {
  as_asked,        ///< in the order of the list
  costliest_first  ///< by expected cost, ties in the order of the list; WorkerPool does this
};

/// The times that workers need for a list of tasks that are all known at the start.
struct Schedule {
  double makespan_s = 0.0;    ///< time until the last task is done
  double busy_s = 0.0;        ///< working time of all workers together: the sum of the tasks
  double straggling_s = 0.0;  ///< part of the makespan in which at least one worker has nothing left to do
};

/// Computes a list schedule: a free worker takes the next task of the list. If several are free, the first of them takes it.
///
/// The makespan is at most 2 - 1/m times the best possible one on m workers; with the costliest first and true costs, at most 4/3
/// - 1/(3 m) times. @cite graham1969bounds
/// @param workers >= 1
Schedule list_schedule(std::span<const TimedTask> tasks, std::size_t workers, TaskOrder order);

/// Returns a lower bound of the makespan of every schedule, in s: the longest task, or the sum of the tasks divided by the number
/// of workers, whichever is larger.
double least_makespan_s(std::span<const TimedTask> tasks, std::size_t workers);

}  // namespace menger::evolution
