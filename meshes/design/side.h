#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace menger::meshes {

/// The six sides of a cell, an element or a box.
enum class Side { x_min, x_max, y_min, y_max, z_min, z_max };

inline constexpr std::array all_sides{Side::x_min, Side::x_max, Side::y_min, Side::y_max, Side::z_min, Side::z_max};

/// Returns "x min", "x max", ...: the words in files and the labels of boxes.
constexpr std::string_view to_string(Side side) {
  constexpr std::array<std::string_view, 6> words{"x min", "x max", "y min", "y max", "z min", "z max"};
  return words[static_cast<std::size_t>(side)];
}

/// Returns the number of the axis that a side is normal to: 0, 1 or 2 for x, y, z.
constexpr std::size_t axis_of(Side side) { return static_cast<std::size_t>(side) / 2; }

/// Whether a side is the one at the upper end of its axis, such as x max: its normal points along the axis, not against it.
constexpr bool is_max(Side side) { return static_cast<std::size_t>(side) % 2 == 1; }

constexpr Side opposite(Side side) { return static_cast<Side>(static_cast<std::size_t>(side) ^ 1U); }

}  // namespace menger::meshes
