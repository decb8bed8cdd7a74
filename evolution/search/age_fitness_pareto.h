#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// What selection knows of an individual.
struct Contestant {
  std::uint64_t id = 0;  ///< unique; a newer individual has a larger one
  int age = 0;           ///< generations of its lineage, less is better
  std::optional<double>
      fitness;  ///< a number, more is better; none for an individual that failed, which is worse than any number

  bool operator==(const Contestant&) const = default;
};

/// Whether a dominates b: a is at least as good in fitness and in age, and better in one of them or newer.
bool dominates(const Contestant& a, const Contestant& b);

/// The level of every contestant, in the order of the pool: the number of contestants that dominate it, plus 2 `survivors` if it
/// has no fitness.
std::vector<std::size_t> domination_levels(std::span<const Contestant> pool, std::size_t survivors);

/// Positions in the pool, best first: level ascending, fitness descending, age ascending, newest first.
std::vector<std::size_t> selection_order(std::span<const Contestant> pool, std::size_t survivors);

/// The ids of the survivors, in the order in which they were taken.
///
/// Levels are taken whole, lowest first, while they fit. Of the first level that does not fit, with L members in selection order,
/// the first is taken, then members at the index floor(L^u) with u uniform in [0, 1) until `survivors` are taken (an index that
/// was taken already is drawn again). Only that draws. A pool no larger than `survivors` survives whole.
std::vector<std::uint64_t> select_survivors(std::span<const Contestant> pool, std::size_t survivors, RandomStream& random);

}  // namespace menger::evolution
