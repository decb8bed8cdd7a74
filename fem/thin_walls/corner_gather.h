#pragma once

// Nodal values into lanes: what a corner has in memory side by side, x y z, becomes three packs.

#include <array>
#include <cstddef>
#include <cstdint>

#include "fem/thin_walls/lane_number.h"

namespace menger::fem::detail {

/// One corner of each lane. For registers see pack_gather.h: they load four numbers a node, of which the last is not used, and
/// are transposed, some twelve instructions an element in place of 24 loads and stores. @param first_components of the corner in
/// the first lane; those of the next lanes follow `stride` further each
template <class T, std::size_t stride = 8>
struct CornerGather {
  MENGER_HOST_DEVICE static Vector3<T> gather(const std::uint32_t* first_components, const NumberOf<T>* values) {
    constexpr std::size_t width = Lanes<T>::count;
    alignas(64) std::array<NumberOf<T>, 3 * width> buffer;
    for (std::size_t lane = 0; lane < width; ++lane)
      for (std::size_t i = 0; i < 3; ++i) buffer[i * width + lane] = values[first_components[stride * lane] + i];
    return {Lanes<T>::load(buffer.data()), Lanes<T>::load(buffer.data() + width), Lanes<T>::load(buffer.data() + 2 * width)};
  }
};

}  // namespace menger::fem::detail
