#pragma once

#include <cstddef>

namespace menger::meshes {

/// The median error of displacements up to which a surrogate takes the shape of a body well, if none of them goes the wrong way.
/// It is a choice; it decides words, never numbers.
inline constexpr double largest_shape_error = 0.15;

/// Displacements of at least this, in m, are large enough that a surrogate should give them the right sign.
inline constexpr double smallest_signed_m = 2e-4;

/// Returns whether a surrogate takes the shape of a body well.
/// @param median largest of the median errors inside and outside the range of the fit
/// @param wrong_signs displacements of at least smallest_signed_m that go the wrong way, on both sides of the range
constexpr bool is_shape_close(double median, std::size_t wrong_signs) {
  return median <= largest_shape_error && wrong_signs == 0;
}

}  // namespace menger::meshes
