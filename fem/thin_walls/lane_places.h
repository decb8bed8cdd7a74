#pragma once

#include <array>
#include <cstdint>

namespace menger::fem {

/// Where kernels put the forces of each of their lanes: among the slots of one corner of a batch, this slot. Only the first
/// entries are of meaning, one for each lane.
using LanePlaces = std::array<std::uint8_t, 16>;

}  // namespace menger::fem
