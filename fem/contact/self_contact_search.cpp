#include "fem/contact/self_contact_search.h"

#include <algorithm>
#include <cmath>

#include "fem/surfaces/triangle.h"

namespace menger::fem {
namespace {

constexpr std::size_t nodes_per_block = 64;

/// The tree over the faces of one surface, counted from its first face.
FaceTree tree_of(const ContactSurfaces& surfaces, std::size_t surface, std::span<const Point> points) {
  std::vector<Triangle> triangles;
  for (std::size_t f = surfaces.surface_faces()[surface]; f < surfaces.surface_faces()[surface + 1]; ++f) {
    const FaceCorners at = surfaces.corners(f, points);  // the search uses only their boxes
    triangles.push_back(triangle(at[0], at[1], at[2]));
    triangles.push_back(triangle(at[0], at[2], at[3]));
  }
  return face_tree(triangles, 2);
}

/// Calls consider(face) for the faces of a tree whose box is nearer to a point than a reach.
template <class Consider>
void visit(const FaceTree& tree, std::size_t root, const Point& point, double squared_reach, const Consider& consider) {
  const FaceTree::Node& node = tree.nodes[root];
  if (squared_distance(point, node.box) >= squared_reach) return;
  if (node.is_leaf()) {
    consider(node.face);
    return;
  }
  for (const std::size_t child : node.children) visit(tree, child, point, squared_reach, consider);
}

struct Found {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> faces;
  double smallest_square;
};

}  // namespace

ContactSearch::ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points) : surfaces_(surfaces) {
  for (std::size_t s = 0; s < surfaces.surface_count(); ++s) trees_.push_back(tree_of(surfaces, s, points));
}

/// Updates the boxes of all trees. Children come before their parents in the list.
void ContactSearch::fit_boxes(std::span<const Point> points) {
  for (std::size_t s = 0; s < trees_.size(); ++s) {
    std::vector<FaceTree::Node>& nodes = trees_[s].nodes;
    for (FaceTree::Node& node : nodes) {
      node.box = Box{};
      if (node.is_leaf()) {
        for (const Point& corner : surfaces_.corners(surfaces_.surface_faces()[s] + node.face, points)) node.box.add(corner);
      } else {
        for (const std::size_t child : node.children) node.box.add(nodes[child].box);
      }
    }
  }
}

ContactCandidates ContactSearch::near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop) {
  const double squared_reach = reach_m * reach_m;
  fit_boxes(points);
  std::vector<Found> parts(BlockLoop::block_count(points.size(), nodes_per_block));
  loop.run(points.size(), nodes_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    Found& part = parts[block];
    part.smallest_square = squared_reach;
    for (std::size_t node = begin; node < end; ++node) {
      const std::size_t surface = surfaces_.surface(node);
      const FaceTree& tree = trees_[surface];
      const std::size_t first = part.faces.size();
      for (const std::size_t root : tree.roots) {
        visit(tree, root, points[node], squared_reach, [&](std::size_t counted) {
          const std::size_t face = surfaces_.surface_faces()[surface] + counted;
          if (surfaces_.is_of_element_behind(node, face)) return;
          const double square = nearest_on_face(surfaces_.corners(face, points), points[node]).distance_square_m2;
          if (square >= squared_reach) return;
          part.smallest_square = std::min(part.smallest_square, square);
          part.faces.push_back(static_cast<std::uint32_t>(face));
        });
      }
      if (part.faces.size() == first) continue;
      std::sort(part.faces.begin() + static_cast<std::ptrdiff_t>(first), part.faces.end());
      part.nodes.push_back(static_cast<std::uint32_t>(node));
      part.counts.push_back(static_cast<std::uint32_t>(part.faces.size() - first));
    }
  });
  ContactCandidates result;
  result.offsets.push_back(0);
  double smallest_square = squared_reach;
  for (const Found& part : parts) {
    result.nodes.insert(result.nodes.end(), part.nodes.begin(), part.nodes.end());
    result.faces.insert(result.faces.end(), part.faces.begin(), part.faces.end());
    for (const std::uint32_t count : part.counts) result.offsets.push_back(result.offsets.back() + count);
    smallest_square = std::min(smallest_square, part.smallest_square);
  }
  result.smallest_m = std::sqrt(smallest_square);
  return result;
}

}  // namespace menger::fem
