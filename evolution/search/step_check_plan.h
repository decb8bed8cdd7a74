#pragma once

#include <cstddef>

namespace menger::evolution {

/// How often a search looks at what its time step does to its best designs. Checks change nothing in the course of a search.
struct StepCheckPlan {
  int every = 25;           ///< generations from one check to the next, >= 1; the first is of generation 0
  std::size_t designs = 1;  ///< the best distinct survivors that are checked each time, >= 1

  bool operator==(const StepCheckPlan&) const = default;
};

}  // namespace menger::evolution
