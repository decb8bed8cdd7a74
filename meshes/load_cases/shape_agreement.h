#pragma once

namespace menger::meshes {

/// The median error of displacements up to which a surrogate takes the shape of a body well, if none of them goes the wrong way.
/// It is a choice; it decides words, never numbers.
inline constexpr double largest_shape_error = 0.15;

/// Displacements of at least this, in m, are large enough that a surrogate should give them the right sign.
inline constexpr double smallest_signed_m = 2e-4;

}  // namespace menger::meshes
