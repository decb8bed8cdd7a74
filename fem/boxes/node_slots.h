#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// A range of elements' batches, faces or nodes, from begin up to, but not including, end.
struct IndexRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The slots of each node in an array of forces per element or face. The three components of slot s are `stride` apart.
struct NodeSlots {
  static constexpr std::size_t padding = 32;
  std::vector<std::uint32_t> offsets;  ///< node_count + 1 positions in slots
  /// Index of the first component of each slot, in the order of elements or faces. `padding` further entries, all 0, follow at
  /// the end, so that a loop may read ahead.
  std::vector<std::uint32_t> slots;
  std::size_t stride = 1;

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t node) const {
    return std::span(slots).subspan(offsets[node], offsets[node + 1] - offsets[node]);
  }

  /// Returns the sum of the forces in a node's slots. The forces of later nodes are prefetched, as they do not lie in the nearest
  /// caches.
  [[nodiscard]] Point sum(const double* forces, std::size_t node) const {
    Point total{};
    for (std::size_t n = offsets[node]; n < offsets[node + 1]; ++n) {
      const double* later = forces + slots[n + padding];
      const double* force = forces + slots[n];
      for (std::size_t i = 0; i < 3; ++i) {
        __builtin_prefetch(later + i * stride);
        total[i] += force[i * stride];
      }
    }
    return total;
  }
};

/// The slots of each node in an array of forces where the three components of a slot are side by side and a zero follows, so that
/// a slot is added in one register. Each node has a multiple of four slots, so that the loop over them hardly ever branches:
/// those that are missing are the empty slot, which is the last of the array and holds zeros.
class FourfoldSlots {
 public:
  /// @param nodes node of each slot; slot s is at 4 s
  FourfoldSlots(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> slots, std::size_t node_count,
                std::uint32_t empty_slot);

  /// Returns the sum of the forces in a node's slots; the last number is zero.
  template <class Number>
  [[nodiscard]] std::array<Number, 4> sum(const Number* forces, std::size_t node) const {
    // In one register: compilers would add the third of three numbers apart. `using` would lose the attribute.
    typedef Number Four __attribute__((vector_size(4 * sizeof(Number))));  // NOLINT(modernize-use-using)
    Four total{};
    for (std::size_t n = offsets_[node]; n < offsets_[node + 1]; n += group) {
      Four parts[group];  // std::array would lose it, too
      for (std::size_t k = 0; k < group; ++k) std::memcpy(&parts[k], forces + 4 * std::size_t{slots_[n + k]}, sizeof(Four));
      for (std::size_t half = group / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < half; ++k) parts[k] += parts[k + half];
      total += parts[0];
    }
    std::array<Number, 4> result;
    std::memcpy(result.data(), &total, sizeof(Four));
    return result;
  }

 private:
  static constexpr std::uint32_t group = 4;

  std::vector<std::uint32_t> offsets_;
  std::vector<std::uint32_t> slots_;
};

/// Sorts slots by node.
/// @param nodes node of each slot
/// @param first_component index of the first component of each slot
NodeSlots sorted_by_node(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> first_component,
                         std::size_t node_count, std::size_t stride);

}  // namespace menger::fem
