// Schedules that can be checked by hand.

#include "evolution/evaluation/task_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace menger::evolution {
namespace {

/// Returns tasks whose expected cost is their true time.
std::vector<TimedTask> tasks(const std::vector<double>& seconds) {
  std::vector<TimedTask> all;
  for (const double one : seconds) all.push_back({one, one});
  return all;
}

TEST(ListSchedule, TwoWorkersTakeWhatIsNext) {
  // 3, 1, 2, 4 as asked: the first worker takes 3 and then 4, the second 1 and 2; the second ends at 3, the first at 7.
  const Schedule schedule = list_schedule(tasks({3, 1, 2, 4}), 2, TaskOrder::as_asked);
  EXPECT_EQ(schedule.makespan_s, 7.0);
  EXPECT_EQ(schedule.busy_s, 10.0);
  EXPECT_EQ(schedule.straggling_s, 4.0);
  // Costliest first: 4 | 3, then 2 to the second, 1 to the first: both end at 5.
  const Schedule sorted = list_schedule(tasks({3, 1, 2, 4}), 2, TaskOrder::costliest_first);
  EXPECT_EQ(sorted.makespan_s, 5.0);
  EXPECT_EQ(sorted.straggling_s, 0.0);
}

TEST(ListSchedule, IsAsFarFromTheBestAsGrahamsWorstCases) {
  // As asked: m (m - 1) tasks of 1, then one of m, take 2 m - 1 where m is possible.
  for (const std::size_t workers : {2U, 3U, 8U}) {
    std::vector<double> seconds(workers * (workers - 1), 1.0);
    seconds.push_back(static_cast<double>(workers));
    EXPECT_EQ(list_schedule(tasks(seconds), workers, TaskOrder::as_asked).makespan_s, 2.0 * static_cast<double>(workers) - 1.0);
    EXPECT_EQ(list_schedule(tasks(seconds), workers, TaskOrder::costliest_first).makespan_s, static_cast<double>(workers));
  }
  // Costliest first: two of each of 2 m - 1 ... m + 1 and three of m take 4 m - 1 where 3 m is possible.
  for (const int workers : {2, 3, 8}) {
    std::vector<double> seconds(3, workers);
    for (int one = workers + 1; one < 2 * workers; ++one) seconds.insert(seconds.end(), 2, one);
    EXPECT_EQ(list_schedule(tasks(seconds), static_cast<std::size_t>(workers), TaskOrder::costliest_first).makespan_s,
              4.0 * workers - 1.0);
    EXPECT_EQ(least_makespan_s(tasks(seconds), static_cast<std::size_t>(workers)), 3.0 * workers);
  }
}

TEST(ListSchedule, StaysWithinItsBounds) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> seconds(1 + generator() % 40);
    for (double& one : seconds) one = static_cast<double>(1 + generator() % 1000);
    const std::vector<TimedTask> list = tasks(seconds);
    const std::size_t workers = 1 + generator() % 9;
    const double m = static_cast<double>(workers);
    const double longest = *std::max_element(seconds.begin(), seconds.end());
    for (const TaskOrder order : {TaskOrder::as_asked, TaskOrder::costliest_first}) {
      const Schedule schedule = list_schedule(list, workers, order);
      EXPECT_GE(schedule.makespan_s, least_makespan_s(list, workers));
      // All workers are busy while the last task waits. The factor allows for rounding of the quotients.
      EXPECT_LE(schedule.makespan_s, (schedule.busy_s / m + (1.0 - 1.0 / m) * longest) * (1.0 + 1e-12));
      EXPECT_LE(schedule.straggling_s, longest);
    }
  }
}

TEST(ListSchedule, MoreWorkersThanTasksWaitForTheLongest) {
  const Schedule schedule = list_schedule(tasks({2, 5, 3}), 64, TaskOrder::costliest_first);
  EXPECT_EQ(schedule.makespan_s, 5.0);
  EXPECT_EQ(schedule.straggling_s, 5.0) << "61 workers have nothing to do from the start";
  EXPECT_EQ(list_schedule({}, 3, TaskOrder::as_asked).makespan_s, 0.0);
}

TEST(ListSchedule, ExpectedCostsDecideTheOrderAndTimesTheSchedule) {
  // The task that was expected to be the cheapest takes longest.
  const std::vector<TimedTask> surprising{{1.0, 3.0}, {1.0, 2.0}, {10.0, 1.0}};
  EXPECT_EQ(list_schedule(surprising, 2, TaskOrder::costliest_first).makespan_s, 11.0);
}

}  // namespace
}  // namespace menger::evolution
