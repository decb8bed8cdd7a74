#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "fem/contact/self_contact_surface.h"

namespace menger::fem {

/// Where the surfaces' nodes are, and the unit mean normals of their faces.
struct SurfaceShape {
  std::span<const Point> points;
  std::span<const Point> normals;
};

/// Where a node is behind its own surface.
struct NodeDepth {
  std::size_t face;
  NearestOnFace nearest;
  Point behind_m;  ///< from the nearest point to the node; its length is the depth
};

/// How deep a node is behind some faces of its surface; nothing if it is not.
///
/// Only faces count that a face at the node looks at (their normals differ by more than 107 degrees), in whose nearest point the
/// distance to all of them has a minimum, none of their neighbours by a corner being nearer, and behind which the node is: on the
/// inner side of the normals there, added up by the angles of the flat parts. So the depth begins and ends at zero where a node
/// crosses the surface, and does not jump where it passes from one face to the next. Beside faces that do not look at the node it
/// may be by a tenth of its depth: nodes of limbs with flush sides are above the very edge, and further out they are in the air.
/// From a fifth of an edge (0.4 of the largest depth) on that is too coarse: there the faces around the one found count, too, if
/// they are turned from one at the node by more than 98 degrees, and a nearer one of them says whether and how deep the node is
/// behind the surface. Of several parts of the surface the nearest counts.
///
/// A nearest point at a corner or on an edge of an element at the node does not count: the line between them runs in that
/// element, so that they meet only if it is squeezed flat. Pairs that coincide at rest because cells meet along an edge have no
/// element in common and count; they push from where one is behind the other.
/// @param faces those less than largest_depth_m away among them @param shape of these faces and of those around the node
std::optional<NodeDepth> depth_of(const ContactSurfaces& surfaces, std::size_t node, std::span<const std::uint32_t> faces,
                                  const SurfaceShape& shape, double largest_depth_m);

}  // namespace menger::fem
