#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/space/node_exchange.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// Returns which displacement components are held: by the supports at zero, or by the plates at their position. 1 or 0 per
/// component of the local nodes.
std::vector<std::uint8_t> held_components(const Space& space, const Body& body, const NodeExchange& exchange);

/// Returns whether the supports hold a body against every rigid motion: three translations and three rotations. The ground counts
/// as a support along z of all faces that may touch it. Collective; the same on all ranks. @param held as held_components returns
/// it
bool is_held(const Space& space, const Body& body, std::span<const std::uint8_t> held);

/// The node nearest to a point of the reference configuration, by rank and local number; the same on all ranks. Of several nodes
/// that are equally near (within 1e-9 of the distance) it is the one with the smallest x, of these the one with the smallest y,
/// then z. The result therefore does not depend on how nodes are shared among ranks. Collective.
struct NearestNode {
  int rank = 0;
  Index local = -1;  ///< local number on that rank, -1 on the others
  Point position{};  ///< of the node
};
NearestNode nearest_node(const Space& space, const Point& point);

}  // namespace menger::fem
