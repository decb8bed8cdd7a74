#pragma once

namespace menger::meshes {

/// The median error of displacements up to which a surrogate takes the shape of a body well, if none of them goes the wrong way.
/// It is a choice; it decides words, never numbers.
inline constexpr double largest_shape_error = 0.15;

}  // namespace menger::meshes
