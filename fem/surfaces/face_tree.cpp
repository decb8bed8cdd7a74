#include "fem/surfaces/face_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace menger::fem {
namespace {

/// The angle between two directions. It is accurate for small angles, where the inverse cosine is not.
double angle(const Point& a, const Point& b) { return 2.0 * std::asin(std::min(0.5 * norm(difference(a, b)), 1.0)); }

/// Builds one tree over faces whose leaves are already nodes.
class Builder {
 public:
  explicit Builder(FaceTree& tree) : tree_(tree) {}

  /// Returns the root of a tree over some leaves, and reorders them.
  std::size_t build(std::span<std::size_t> leaves) {
    if (leaves.size() == 1) return leaves.front();
    const std::size_t axis = widest_axis(leaves);
    const auto middle = leaves.size() / 2;
    const auto centre = [&](std::size_t leaf) { return tree_.nodes[leaf].box.low[axis] + tree_.nodes[leaf].box.high[axis]; };
    std::nth_element(leaves.begin(), leaves.begin() + static_cast<std::ptrdiff_t>(middle), leaves.end(),
                     [&](std::size_t a, std::size_t b) {
                       const double centre_a = centre(a);
                       const double centre_b = centre(b);
                       return centre_a != centre_b ? centre_a < centre_b : a < b;
                     });
    FaceTree::Node node;
    node.children[0] = build(leaves.first(middle));
    node.children[1] = build(leaves.subspan(middle));
    for (const std::size_t child : node.children) {
      node.box.add(tree_.nodes[child].box);
      node.normals = merged(node.normals, tree_.nodes[child].normals);
    }
    tree_.nodes.push_back(node);
    return tree_.nodes.size() - 1;
  }

 private:
  [[nodiscard]] std::size_t widest_axis(std::span<const std::size_t> leaves) const {
    Box box;
    for (const std::size_t leaf : leaves) box.add(tree_.nodes[leaf].box);
    const Point size = difference(box.high, box.low);
    return static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  }

  FaceTree& tree_;
};

/// The leaf of a face, with its box and normals. Its cone stays empty if the face has no area.
FaceTree::Node leaf_of(std::span<const Triangle> triangles, std::size_t face) {
  FaceTree::Node leaf;
  leaf.face = face;
  Point mean{};
  for (const Triangle& triangle : triangles) {
    for (const Point& corner : triangle.corners) leaf.box.add(corner);
    mean = sum(mean, triangle.normal);
  }
  const double length = norm(mean);
  if (length > 0.0) leaf.normals.axis = scaled(1.0 / length, mean);
  for (const Triangle& triangle : triangles)
    if (dot(triangle.normal, triangle.normal) > 0.0)
      leaf.normals.half_angle = std::max(leaf.normals.half_angle, angle(leaf.normals.axis, triangle.normal));
  return leaf;
}

/// The half-axis nearest to a direction, from 0 to 5.
std::size_t nearest_half_axis(const Point& direction) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
  return 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
}

}  // namespace

NormalCone merged(const NormalCone& a, const NormalCone& b) {
  if (a.half_angle < 0.0) return b;
  if (b.half_angle < 0.0) return a;
  const Point middle = sum(a.axis, b.axis);
  const double length = norm(middle);
  if (length < 1e-6) return {.axis = a.axis, .half_angle = std::numbers::pi};  // opposite axes have no mean
  const Point axis = scaled(1.0 / length, middle);
  const double reach = std::max(angle(axis, a.axis) + a.half_angle, angle(axis, b.axis) + b.half_angle);
  return {.axis = axis, .half_angle = std::min(reach, std::numbers::pi)};
}

double largest_angle(const NormalCone& a, const NormalCone& b) {
  return std::min(angle(a.axis, b.axis) + a.half_angle + b.half_angle, std::numbers::pi);
}

FaceTree face_tree(std::span<const Triangle> triangles, std::size_t triangles_per_face) {
  FaceTree tree;
  std::array<std::vector<std::size_t>, 6> leaves;
  for (std::size_t face = 0; (face + 1) * triangles_per_face <= triangles.size(); ++face) {
    const auto leaf = leaf_of(triangles.subspan(face * triangles_per_face, triangles_per_face), face);
    if (leaf.normals.half_angle < 0.0) continue;
    leaves[nearest_half_axis(leaf.normals.axis)].push_back(tree.nodes.size());
    tree.nodes.push_back(leaf);
  }
  Builder builder(tree);
  for (auto& group : leaves)
    if (!group.empty()) tree.roots.push_back(builder.build(group));
  return tree;
}

}  // namespace menger::fem
