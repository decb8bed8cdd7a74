#pragma once

#include <cstddef>
#include <string>

namespace menger::evolution {

/// How a dearer judge takes part in a search. Budgets are counted in steps: an element-step is one finite element for one time
/// step, a voxel-step one voxel for one time step.
struct JudgingPlan {
  int every = 10;                     ///< generations from one judging to the next, >= 1; the first is before generation `every`
  std::size_t designs = 2;            ///< robots that are judged each time, >= 1
  double budget_element_steps = 0.0;  ///< that judging may take over the whole search, >= 0
  double voxel_steps_per_element_step = 2.6;  ///< what an element-step costs, > 0: joins both costs to one number

  /// Hash of what decides the judge's results beside the body (DesignJudge::protocol): names the judge in the archive.
  std::string protocol;

  bool operator==(const JudgingPlan&) const = default;
};

}  // namespace menger::evolution
