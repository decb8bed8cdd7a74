#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "voxel/parameters.h"

namespace menger::voxel {

/// Instruction set of the step's kernels. The results of all of them are the same bytes: no kernel fuses a multiplication with an
/// addition.
enum class InstructionSet { best, scalar, sse2, avx2, avx512 };

/// How a simulation runs, never what it computes.
struct KernelOptions {
  InstructionSet instruction_set = InstructionSet::best;  ///< the best this machine has, or one by name
  bool every_term = false;     ///< keep all terms in the loop and do collision work at every step, for comparison
  bool energy_ledger = false;  ///< keep the energy balance (slow: scalar, with separate sums for every kind of force)
};

/// Work done for collisions.
struct CollisionCounts {
  std::uint64_t steps_with_pairs = 0;  ///< steps that looked at pairs
  std::uint64_t steps_skipped = 0;     ///< steps whose displacement bound ruled every contact out
  std::uint64_t list_rebuilds = 0;
  std::uint64_t pairs_in_list = 0;  ///< now
};

}  // namespace menger::voxel
