#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace menger::meshes {

/// The median error of displacements, and that of chamber volumes, up to which a surrogate takes the shape of a body well, if no
/// displacement goes the wrong way. It is a choice; it decides words, never numbers.
inline constexpr double largest_shape_error = 0.15;

/// By how much more fingers bend on quadratic elements with one layer through the wall, at most (likewise).
inline constexpr double largest_quadratic_bend_excess = 0.03;

/// Returns by how much less fingers of thin walls bend than those of quadratic elements with two layers through the wall, of what
/// they bend (fem/walk/README.md): "17 to 26 %". @param fidelity "draft", "standard" or "fine"; otherwise that of all of them
std::string thin_wall_bend_deficit_text(std::string_view fidelity = {});

/// Displacements of at least this, in m, are large enough that a surrogate should give them the right sign.
inline constexpr double smallest_signed_m = 2e-4;

/// Returns whether a surrogate takes the shape of a body well.
/// @param displacement largest of the median errors of displacements inside and outside the range of the fit
/// @param volume likewise of chamber volumes; 0 if none was compared
/// @param wrong_signs displacements of at least smallest_signed_m that go the wrong way, on both sides of the range
constexpr bool is_shape_close(double displacement, double volume, std::size_t wrong_signs) {
  return displacement <= largest_shape_error && volume <= largest_shape_error && wrong_signs == 0;
}

}  // namespace menger::meshes
