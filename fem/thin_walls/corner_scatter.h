#pragma once

// Lanes into memory: three packs become what each corner has side by side, x y z and a zero.

#include <array>
#include <cstddef>
#include <cstdint>

#include "fem/thin_walls/lane_number.h"
#include "fem/thin_walls/lane_places.h"

namespace menger::fem::detail {

/// Writes one corner of each lane: four numbers for each lane, in an order that needs whole registers only, aligned to 64 bytes.
/// A node can then add up its slots four numbers at a time.
template <class T>
struct CornerScatter {
  /// The place of a lane among the slots of a corner.
  MENGER_HOST_DEVICE static constexpr std::size_t place(std::size_t lane) { return lane; }

  MENGER_HOST_DEVICE static void scatter(const Vector3<T>& value, NumberOf<T>* slots) {
    constexpr std::size_t width = Lanes<T>::count;
    alignas(64) std::array<NumberOf<T>, 3 * width> buffer;
    for (std::size_t i = 0; i < 3; ++i) Lanes<T>::store(value[i], buffer.data() + i * width);
    for (std::size_t lane = 0; lane < width; ++lane) {
      NumberOf<T>* slot = slots + 4 * lane;
      for (std::size_t i = 0; i < 3; ++i) slot[i] = buffer[i * width + lane];
      slot[3] = NumberOf<T>(0);
    }
  }
};

/// The places of all lanes among the slots of a corner.
template <class T>
MENGER_HOST_DEVICE constexpr LanePlaces lane_places() {
  LanePlaces places{};
  for (std::size_t lane = 0; lane < Lanes<T>::count; ++lane)
    places[lane] = static_cast<std::uint8_t>(CornerScatter<T>::place(lane));
  return places;
}

}  // namespace menger::fem::detail
