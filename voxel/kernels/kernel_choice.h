#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace menger::voxel {

/// Instruction set of the kernels of a step. All of them give the same bytes, because no kernel fuses a multiplication with an
/// addition.
enum class InstructionSet { best, scalar, sse2, avx2, avx512 };

/// Terms that are kept in the loop where they cannot matter, to measure what leaving them out saves. Any of them also keeps
/// blocks out of lanes: compare with `blocks_in_lanes = false`.
struct KeptTerms {
  bool coefficients = false;  ///< of every voxel and beam, even where all are the same
  bool floor = false;
  bool gravity = false;
  bool actuation = false;
  /// Pairs are searched in every step, even where a bound on the displacements rules contact out.
  bool collisions = false;

  bool operator==(const KeptTerms&) const = default;
};

inline constexpr KeptTerms all_terms{.coefficients = true, .floor = true, .gravity = true, .actuation = true, .collisions = true};

/// How a simulation runs. These options never change what it computes.
struct KernelOptions {
  InstructionSet instruction_set = InstructionSet::best;  ///< the best this machine has, or one by name
  KeptTerms kept{};                                       ///< for comparison
  bool every_term = false;      ///< keep all terms, and search for close pairs anew in every step; for comparison
  bool blocks_in_lanes = true;  ///< of an aggregate, where that is faster; otherwise voxel by voxel
  int threads = 1;              ///< >= 1; they share every step of an aggregate whose blocks go in lanes
  bool energy_ledger = false;   ///< keep the energy balance (slow: scalar, with separate sums for every kind of force)

  /// Returns the terms that these options keep, one by one or all together.
  [[nodiscard]] KeptTerms kept_terms() const { return every_term ? all_terms : kept; }
};

/// Counts of the work done for collisions.
struct CollisionCounts {
  std::uint64_t steps_with_pairs = 0;  ///< steps that searched pairs
  std::uint64_t steps_skipped = 0;     ///< steps in which a bound on the displacements ruled every contact out
  std::uint64_t list_rebuilds = 0;
  std::uint64_t pairs_in_list = 0;  ///< now
};

}  // namespace menger::voxel
