#include "fem/contact/self_contact_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace menger::fem {
namespace {

constexpr std::size_t nodes_per_block = 64;
constexpr std::size_t boxes_per_block = 1024;

/// Adds the tree over some faces: halves of them, by their middles along the axis on which these lie furthest apart.
void add_tree(std::span<std::uint32_t> faces, const std::vector<Point>& middles, FaceBoxes& tree) {
  const std::size_t at = tree.nodes.size();
  tree.nodes.emplace_back();
  if (faces.size() == 1) {
    tree.nodes[at].face = faces.front();
  } else {
    Box all;
    for (const std::uint32_t face : faces) all.add(middles[face]);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (all.high[i] - all.low[i] > all.high[axis] - all.low[axis]) axis = i;
    const auto half = static_cast<std::ptrdiff_t>(faces.size() / 2);
    std::nth_element(faces.begin(), faces.begin() + half, faces.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
    });
    add_tree(faces.first(faces.size() / 2), middles, tree);
    add_tree(faces.subspan(faces.size() / 2), middles, tree);
  }
  tree.nodes[at].end = static_cast<std::uint32_t>(tree.nodes.size());
}

/// Calls consider(face) for the faces of a tree whose box is nearer to a point than a reach.
template <class Consider>
void visit(const FaceBoxes& tree, const Point& point, double squared_reach, const Consider& consider) {
  for (std::size_t n = 0; n < tree.nodes.size();) {
    const FaceBoxes::Node& node = tree.nodes[n];
    if (squared_distance(point, node.box) >= squared_reach) {
      n = node.end;
    } else {
      if (++n == node.end) consider(node.face);
    }
  }
}

struct Found {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> faces;
  double smallest_square;
};

}  // namespace

ContactSearch::ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points) : surfaces_(surfaces) {
  std::vector<Point> middles;
  for (std::size_t face = 0; face < surfaces.face_count(); ++face) middles.push_back(centre(surfaces.corners(face, points)));
  for (std::size_t s = 0; s < surfaces.surface_count(); ++s) {
    std::vector<std::uint32_t> faces(surfaces.surface_faces()[s + 1] - surfaces.surface_faces()[s]);
    std::iota(faces.begin(), faces.end(), surfaces.surface_faces()[s]);
    trees_.emplace_back();
    if (!faces.empty()) add_tree(faces, middles, trees_.back());
  }
}

/// Updates the boxes of all trees: first those of the faces, then those that contain others.
void ContactSearch::fit_boxes(std::span<const Point> points, const BlockLoop& loop) {
  for (FaceBoxes& tree : trees_) {
    std::vector<FaceBoxes::Node>& nodes = tree.nodes;
    const auto is_leaf = [&](std::size_t n) { return nodes[n].end == n + 1; };
    loop.run(nodes.size(), boxes_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        nodes[n].box = Box{};
        if (!is_leaf(n)) continue;
        for (const Point& corner : surfaces_.corners(nodes[n].face, points)) nodes[n].box.add(corner);
      }
    });
    for (std::size_t n = nodes.size(); n-- > 0;) {
      if (is_leaf(n)) continue;
      nodes[n].box.add(nodes[n + 1].box);
      nodes[n].box.add(nodes[nodes[n + 1].end].box);
    }
  }
}

ContactCandidates ContactSearch::near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop) {
  const double squared_reach = reach_m * reach_m;
  fit_boxes(points, loop);
  std::vector<Found> parts(BlockLoop::block_count(points.size(), nodes_per_block));
  loop.run(points.size(), nodes_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    Found& part = parts[block];
    part.smallest_square = squared_reach;
    for (std::size_t node = begin; node < end; ++node) {
      const std::size_t first = part.faces.size();
      visit(trees_[surfaces_.surface(node)], points[node], squared_reach, [&](std::uint32_t face) {
        if (surfaces_.is_of_element_behind(node, face)) return;
        const double square = nearest_on_face(surfaces_.corners(face, points), points[node]).distance_square_m2;
        if (square >= squared_reach) return;
        part.smallest_square = std::min(part.smallest_square, square);
        part.faces.push_back(face);
      });
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
