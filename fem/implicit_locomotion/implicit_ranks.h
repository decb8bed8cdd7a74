#pragma once

#include <span>
#include <vector>

#include "fem/motion/implicit_state.h"
#include "fem/space/node_exchange.h"

namespace menger::fem {

/// Three numbers per owned node of all ranks, in the order of global node numbers, on the first rank; nothing elsewhere.
/// Collective. @param field 3 per local node
std::vector<double> field_of_all_ranks(const Space& space, std::span<const double> field);

/// The state of a body that several ranks move, on the first of them: fields as above, nodes of the ground rank after rank.
/// Elsewhere it has no fields. Collective.
ImplicitState state_of_all_ranks(const Space& space, const ImplicitState& own);

/// The part of this rank of such a state, ghosts up to date. Collective.
/// @param all counts on the first rank alone @param ground_node_count of this rank
ImplicitState state_of_this_rank(const Space& space, const NodeExchange& exchange, const ImplicitState& all,
                                 std::size_t ground_node_count);

}  // namespace menger::fem
