#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evolution/archive/pool_member.h"
#include "evolution/genome/random_stream.h"

namespace menger::evolution {

/// Returns whether a dominates b: a is at least as fit and at most as old as b, and fitter, younger or newer (of larger id).
bool dominates(const PoolMember& a, const PoolMember& b);

/// Returns the domination level of every member, in the order of the pool: the number of members that dominate it, plus 2
/// `survivors` if it has no fitness.
std::vector<std::size_t> domination_levels(std::span<const PoolMember> pool, std::size_t survivors);

/// Returns positions in the pool, best first: by level ascending, fitness descending, age ascending, newest first.
std::vector<std::size_t> selection_order(std::span<const PoolMember> pool, std::size_t survivors);

/// Selects the survivors of a pool. Returns their ids in the order in which they were taken.
///
/// Levels are taken whole, lowest first, while they fit. Of the first level that does not fit, with L members in selection order,
/// the first member is taken, then members at the index floor(L^u), with u uniform in [0, 1), until `survivors` are taken in all.
/// An index that was taken already is drawn again. Nothing else draws from `random`. A pool no larger than `survivors` survives
/// whole.
std::vector<std::uint64_t> select_survivors(std::span<const PoolMember> pool, std::size_t survivors, RandomStream& random);

}  // namespace menger::evolution
