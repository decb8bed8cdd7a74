#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/space/node_exchange.h"
#include "fem/space/space.h"
#include "fem/statics/body.h"

namespace menger::fem {

/// Which displacement components the supports of a body hold at zero and its plates where they are: 1 or 0 per component of the
/// local nodes.
std::vector<std::uint8_t> held_components(const Space& space, const Body& body, const NodeExchange& exchange);

/// Whether the supports leave a body no rigid motion: three translations and three rotations. The ground counts as a support
/// along z of all faces that may touch it. Collective; the same answer on all ranks. @param held as held_components gives them
bool is_held(const Space& space, const Body& body, std::span<const std::uint8_t> held);

/// The rank and local number of the node nearest to a point of the reference configuration, the same answer on all ranks. Of
/// several that are equally near (within 1e-9 of the distance) it is the one with the least x, of these with the least y, then
/// z, so that the answer does not depend on how nodes are shared among ranks. Collective.
struct NearestNode {
  int rank = 0;
  Index local = -1;  ///< on that rank, -1 on the others
  Point position{};  ///< of the node
};
NearestNode nearest_node(const Space& space, const Point& point);

}  // namespace menger::fem
