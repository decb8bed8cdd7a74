#include "fem/contact/self_contact_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fem/surfaces/face_tree.h"
#include "fem/surfaces/triangle.h"

namespace menger::fem {
namespace {

constexpr double largest_facing_cosine = -0.3;
constexpr double largest_deep_cosine = -0.15;  // normals of flush sides differ by less
constexpr double largest_beside_sine = 0.1;
constexpr double largest_shallow_depth = 0.4;  // relative to the largest depth
constexpr double surely_nearer = 1.0 - 1e-6;   // distances of faces that share their nearest point differ by rounding

/// A face that faces the node, and its nearest point.
struct Near {
  std::size_t face;
  NearestOnFace nearest;
};

/// Whether one of the faces around a node faces the face with this normal.
bool looks_at(const ContactSurfaces& surfaces, std::size_t node, const Point& normal, std::span<const Point> normals,
              double largest_cosine) {
  const auto around = surfaces.faces_around(node);
  return std::any_of(around.begin(), around.end(),
                     [&](std::uint32_t face) { return dot(normals[face], normal) < largest_cosine; });
}

/// Whether a point is further than a distance from a face, by its height over the mean plane.
bool is_clear_of(const FaceCorners& corners, const Point& normal, const Point& point, double distance) {
  const Point middle = centre(corners);
  const double warp = std::abs(dot(difference(corners[0], middle), normal));
  return std::abs(dot(difference(point, middle), normal)) > warp + distance;
}

/// Whether a point is further than a distance from the box of a face.
bool is_outside_box(const FaceCorners& corners, const Point& point, double distance) {
  Box box;
  for (const Point& corner : corners) box.add(corner);
  return squared_distance(point, box) >= distance * distance;
}

Point part_normal(const FaceCorners& corners, std::size_t part) {
  return triangle(corners[part], corners[(part + 1) % 4], centre(corners)).normal;
}

double angle_between(const Point& a, const Point& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// The sum of the normals of the two flat parts at a corner, weighted by their angles there.
Point corner_normal(const FaceCorners& corners, std::size_t corner) {
  const std::size_t before = (corner + 3) % 4;
  const Point inward = difference(centre(corners), corners[corner]);
  const double next_angle = angle_between(inward, difference(corners[(corner + 1) % 4], corners[corner]));
  const double before_angle = angle_between(inward, difference(corners[before], corners[corner]));
  return sum(scaled(next_angle, part_normal(corners, corner)), scaled(before_angle, part_normal(corners, before)));
}

/// The corner or edge that holds a nearest point, by nodes, so that all faces that share it can use it.
struct SharedRim {
  std::uint32_t first;   // node
  std::uint32_t second;  // equal to the first: a corner
};

std::size_t corner_of(const std::array<std::uint32_t, 4>& face, std::uint32_t node) {
  return static_cast<std::size_t>(std::find(face.begin(), face.end(), node) - face.begin());
}

/// The normal of a face at a corner or an edge of it.
Point rim_normal(const ContactSurfaces& surfaces, std::size_t face, const SharedRim& rim, std::span<const Point> points) {
  const FaceCorners corners = surfaces.corners(face, points);
  const std::size_t first = corner_of(surfaces.face(face), rim.first);
  if (rim.first == rim.second) return corner_normal(corners, first);
  const std::size_t second = corner_of(surfaces.face(face), rim.second);
  return part_normal(corners, (first + 1) % 4 == second ? first : second);
}

/// The normal of a face at a nearest point that is not on its rim, so that no other face contributes.
Point inner_normal(const FaceCorners& corners, const NearestOnFace& nearest) {
  const std::size_t part = nearest.part;
  if (nearest.shares[0] > 0.0 && nearest.shares[1] > 0.0) return part_normal(corners, part);
  if (nearest.shares[0] > 0.0) return sum(part_normal(corners, part), part_normal(corners, (part + 3) % 4));
  if (nearest.shares[1] > 0.0) return sum(part_normal(corners, part), part_normal(corners, (part + 1) % 4));
  Point normal{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Point middle = centre(corners);
    const double angle = angle_between(difference(corners[i], middle), difference(corners[(i + 1) % 4], middle));
    normal = sum(normal, scaled(angle, part_normal(corners, i)));
  }
  return normal;
}

bool share_a_node(const std::array<std::uint32_t, 4>& face, const std::array<std::uint32_t, 4>& other) {
  return std::any_of(face.begin(), face.end(),
                     [&](std::uint32_t node) { return std::find(other.begin(), other.end(), node) != other.end(); });
}

/// Whether no face that shares a node with this one is nearer. If one is, it decides on which side the node is.
bool is_nearest_around(const ContactSurfaces& surfaces, const Near& near, const std::vector<Near>& all) {
  return std::none_of(all.begin(), all.end(), [&](const Near& other) {
    return other.nearest.distance_square_m2 < surely_nearer * near.nearest.distance_square_m2 &&
           share_a_node(surfaces.face(near.face), surfaces.face(other.face));
  });
}

/// Whether the nearest point is a corner or on an edge of an element at the node.
bool is_in_element_at(const ContactSurfaces& surfaces, std::size_t node, const Near& near) {
  if (near.nearest.rim[0] < 0) return false;
  const auto& corners = surfaces.face(near.face);
  return surfaces.are_of_one_element(node, corners[static_cast<std::size_t>(near.nearest.rim[0])],
                                     corners[static_cast<std::size_t>(near.nearest.rim[1])]);
}

bool is_behind_rim(const ContactSurfaces& surfaces, const Near& near, const std::vector<Near>& all, const Point& offset,
                   std::span<const Point> points) {
  const auto& corners = surfaces.face(near.face);
  const SharedRim rim{corners[static_cast<std::size_t>(near.nearest.rim[0])],
                      corners[static_cast<std::size_t>(near.nearest.rim[1])]};
  Point normal{};
  for (const std::uint32_t other : surfaces.faces_around(rim.first)) {
    const auto& others = surfaces.face(other);
    if (std::find(others.begin(), others.end(), rim.second) == others.end()) continue;
    const Point part = rim_normal(surfaces, other, rim, points);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Near& n) { return n.face == other; });
    if (found == all.end()) {
      if (dot(offset, part) >= largest_beside_sine * norm(offset) * norm(part)) return false;
    } else {
      if (found->nearest.distance_square_m2 < surely_nearer * near.nearest.distance_square_m2) return false;
      normal = sum(normal, part);
    }
  }
  return dot(offset, normal) < 0.0;
}

bool is_behind(const ContactSurfaces& surfaces, const Near& near, const std::vector<Near>& all, const Point& offset,
               std::span<const Point> points) {
  if (near.nearest.rim[0] >= 0) return is_behind_rim(surfaces, near, all, offset, points);
  return dot(offset, inner_normal(surfaces.corners(near.face, points), near.nearest)) < 0.0;
}

/// Returns the faces that face the node and are less than a distance away.
std::vector<Near> near_faces(const ContactSurfaces& surfaces, std::size_t node, std::span<const std::uint32_t> faces,
                             const SurfaceShape& shape, double distance_m, double largest_cosine) {
  const Point& point = shape.points[node];
  std::vector<Near> all;
  for (const std::uint32_t face : faces) {
    const FaceCorners corners = surfaces.corners(face, shape.points);
    const Point& normal = shape.normals[face];
    if (is_clear_of(corners, normal, point, distance_m) || is_outside_box(corners, point, distance_m)) continue;
    if (!looks_at(surfaces, node, normal, shape.normals, largest_cosine)) continue;
    const NearestOnFace nearest = nearest_on_face(corners, point);
    if (nearest.distance_square_m2 < distance_m * distance_m) all.push_back({face, nearest});
  }
  return all;
}

/// Returns the depth behind the nearest face that the node is behind. @param around only faces that share a node with this face
/// count; nothing: all count
std::optional<NodeDepth> depth_among(const ContactSurfaces& surfaces, std::size_t node, const std::vector<Near>& all,
                                     std::span<const Point> points, std::optional<std::size_t> around) {
  std::optional<NodeDepth> depth;
  for (const Near& near : all) {
    if (depth && near.nearest.distance_square_m2 >= depth->nearest.distance_square_m2) continue;
    if (around && !share_a_node(surfaces.face(near.face), surfaces.face(*around))) continue;
    if (!is_nearest_around(surfaces, near, all) || is_in_element_at(surfaces, node, near)) continue;
    const Point offset = difference(points[node], near.nearest.point);
    if (is_behind(surfaces, near, all, offset, points)) depth = NodeDepth{near.face, near.nearest, offset};
  }
  return depth;
}

}  // namespace

std::optional<NodeDepth> depth_of(const ContactSurfaces& surfaces, std::size_t node, std::span<const std::uint32_t> faces,
                                  const SurfaceShape& shape, double largest_depth_m) {
  const std::vector<Near> all = near_faces(surfaces, node, faces, shape, largest_depth_m, largest_facing_cosine);
  const std::optional<NodeDepth> depth = depth_among(surfaces, node, all, shape.points, std::nullopt);
  const double shallow_depth_m = largest_shallow_depth * largest_depth_m;
  if (!depth || depth->nearest.distance_square_m2 < shallow_depth_m * shallow_depth_m) return depth;
  const std::vector<Near> more = near_faces(surfaces, node, faces, shape, largest_depth_m, largest_deep_cosine);
  return depth_among(surfaces, node, more, shape.points, depth->face);
}

}  // namespace menger::fem
