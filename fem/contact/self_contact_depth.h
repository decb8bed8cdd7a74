#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "fem/contact/self_contact_surface.h"

namespace menger::fem {

/// The positions of the surfaces' nodes and the unit mean normals of their faces.
struct SurfaceShape {
  std::span<const Point> points;
  std::span<const Point> normals;
};

/// The place where a node is behind its own surface.
struct NodeDepth {
  std::size_t face;
  NearestOnFace nearest;
  Point behind_m;  ///< from the nearest point to the node; its length is the depth
};

/// Returns how deep a node is behind some faces of its surface; nothing if it is behind none of them. Of several parts of the
/// surface the nearest counts.
///
/// A face counts under three conditions. First, one of the faces at the node is turned towards it: their normals differ by more
/// than 107 degrees. Second, its nearest point is a minimum of the distance to all faces that meet the first condition: no such
/// face that shares a node with it is nearer. Third, the node lies behind it, on the inner side of the normals at the nearest
/// point, summed with the angles of the flat parts as weights. The depth then starts and ends at zero where a node crosses the
/// surface, and does not jump where the node passes from one face to the next.
///
/// Faces at the nearest point that are not turned towards the node are tested differently. The node may be on their outer side by
/// up to a tenth of its depth: nodes of limbs with flush sides lie exactly above the edge, and nodes further out are in the air.
/// From a depth of a fifth of an edge on (0.4 of the largest depth) this is too coarse. There the faces around the one that was
/// found count, too, if their normals differ from that of a face at the node by more than 98 degrees. If one of them is nearer,
/// it decides whether and how deep the node is behind the surface.
///
/// A nearest point at a corner or on an edge of an element at the node does not count. The line between the two lies in that
/// element, so that they meet only if it is squeezed flat. Pairs that coincide at rest because cells meet along an edge have no
/// element in common. They count, and push as soon as one is behind the other.
/// @param faces must contain all that are less than largest_depth_m away @param shape of these faces and of those around the node
std::optional<NodeDepth> depth_of(const ContactSurfaces& surfaces, std::size_t node, std::span<const std::uint32_t> faces,
                                  const SurfaceShape& shape, double largest_depth_m);

}  // namespace menger::fem
