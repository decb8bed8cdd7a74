#pragma once

#include <optional>

#include "evolution/archive/run_archive.h"

namespace menger::evolution {

/// A survivor of a generation: the individual, and its entry in the pool now.
struct Survivor {
  Individual individual;
  PoolMember member;
  std::optional<double> surrogate{};  ///< its score by the evaluator of the search; set before a round of reference evaluations
};

}  // namespace menger::evolution
