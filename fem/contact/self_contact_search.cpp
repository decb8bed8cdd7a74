#include "fem/contact/self_contact_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace menger::fem {
namespace {

constexpr std::size_t nodes_per_group = 8;
constexpr std::size_t groups_per_block = 4;
constexpr std::size_t boxes_per_block = 1024;
constexpr std::size_t boxes_of_faces_per_block = 1024;
constexpr double distance_about = 2.0;   // relative to the reach
constexpr double distance_around = 4.0;  // relative to the reach

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

/// Calls consider(face) for the faces of a tree whose box is nearer to another box than a reach.
template <class Consider>
void visit(const FaceBoxes& tree, const Box& box, double squared_reach, const Consider& consider) {
  for (std::size_t n = 0; n < tree.nodes.size();) {
    const FaceBoxes::Node& node = tree.nodes[n];
    if (squared_distance(box, node.box) >= squared_reach) {
      n = node.end;
    } else {
      if (++n == node.end) consider(node.face);
    }
  }
}

/// Boxes of some faces, number by number, so that their distances from a point are computed several at once.
struct BoxList {
  std::vector<std::uint32_t> faces;
  std::array<std::vector<double>, 3> low;
  std::array<std::vector<double>, 3> high;
  std::vector<double> squares;  ///< of the distances, at the last call of measure

  void clear() {
    faces.clear();
    for (std::size_t i = 0; i < 3; ++i) {
      low[i].clear();
      high[i].clear();
    }
  }
  void add(std::uint32_t face, const Box& box) {
    faces.push_back(face);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i].push_back(box.low[i]);
      high[i].push_back(box.high[i]);
    }
  }
  void measure(const Point& point) {
    squares.assign(faces.size(), 0.0);
    double* __restrict result = squares.data();
    for (std::size_t i = 0; i < 3; ++i) {
      const double* lower = low[i].data();
      const double* upper = high[i].data();
      const double at = point[i];
      for (std::size_t n = 0; n < faces.size(); ++n) {
        const double apart = positive_part(larger(at - upper[n], lower[n] - at));
        result[n] += apart * apart;
      }
    }
  }
};

/// What was found for one node of a group.
struct FoundFaces {
  std::uint32_t node;
  std::vector<std::uint32_t> faces;
};

/// The diagonal of a box: no two points in it are further apart.
double diagonal_m(const Box& box) { return norm(difference(box.high, box.low)); }

}  // namespace

ContactSearch::ContactSearch(const ContactSurfaces& surfaces, std::span<const Point> points) : surfaces_(surfaces) {
  std::vector<Point> middles;
  for (std::size_t face = 0; face < surfaces.face_count(); ++face) middles.push_back(centre(surfaces.corners(face, points)));
  for (std::size_t s = 0; s < surfaces.surface_count(); ++s) {
    std::vector<std::uint32_t> faces(surfaces.surface_faces()[s + 1] - surfaces.surface_faces()[s]);
    std::iota(faces.begin(), faces.end(), surfaces.surface_faces()[s]);
    trees_.emplace_back();
    if (faces.empty()) continue;
    add_tree(faces, middles, trees_.back());
    add_groups(s);
  }
  face_boxes_.resize(surfaces.face_count());
  face_ways_.resize(surfaces.face_count());
  faces_around_.resize(groups_.size());
  faces_about_.resize(groups_.size());
}

/// Groups the nodes of a surface in the order of the faces in its tree.
void ContactSearch::add_groups(std::size_t surface) {
  std::vector<char> is_grouped(surfaces_.node_count(), 0);
  const std::size_t first = grouped_nodes_.size();
  const std::vector<FaceBoxes::Node>& nodes = trees_[surface].nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].end != n + 1) continue;
    for (const std::uint32_t node : surfaces_.face(nodes[n].face)) {
      if (is_grouped[node] == 0) grouped_nodes_.push_back(node);
      is_grouped[node] = 1;
    }
  }
  for (std::size_t begin = first; begin < grouped_nodes_.size(); begin += nodes_per_group)
    groups_.push_back({surface, begin, std::min(begin + nodes_per_group, grouped_nodes_.size())});
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
        face_boxes_[nodes[n].face] = nodes[n].box;
      }
    });
    for (std::size_t n = nodes.size(); n-- > 0;) {
      if (is_leaf(n)) continue;
      nodes[n].box.add(nodes[n + 1].box);
      nodes[n].box.add(nodes[nodes[n + 1].end].box);
    }
  }
}

/// Sets the boxes of the faces, and the lists of the faces that are far around each group where these may lack one.
void ContactSearch::set_faces_around(std::span<const Point> points, double reach_m, const BlockLoop& loop) {
  const bool has_lists = !listed_points_.empty() && reach_m == reach_m_;
  set_face_ways(points, listed_points_, loop);
  if (has_lists && largest_way_m() < (distance_around - distance_about) * reach_m) {
    loop.run(face_boxes_.size(), boxes_of_faces_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t face = begin; face < end; ++face) {
        face_boxes_[face] = Box{};
        for (const Point& corner : surfaces_.corners(face, points)) face_boxes_[face].add(corner);
      }
    });
    return;
  }
  listed_points_.assign(points.begin(), points.end());
  fit_boxes(points, loop);
  const double squared_distance_around = distance_around * distance_around * reach_m * reach_m;
  loop.run(groups_.size(), groups_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      faces_around_[g].clear();
      visit(trees_[groups_[g].surface], box_of(groups_[g], points), squared_distance_around,
            [&](std::uint32_t face) { faces_around_[g].push_back(face); });
    }
  });
}

Box ContactSearch::box_of(const Group& group, std::span<const Point> points) const {
  Box box;
  for (const std::uint32_t node : nodes_of(group)) box.add(points[node]);
  return box;
}

ContactCandidates ContactSearch::near_pairs(std::span<const Point> points, double reach_m, const BlockLoop& loop) {
  const double squared_reach = reach_m * reach_m;
  const double squared_about = distance_about * distance_about * squared_reach;
  set_faces_around(points, reach_m, loop);
  reach_m_ = reach_m;
  searched_points_.assign(points.begin(), points.end());
  const std::size_t blocks = BlockLoop::block_count(groups_.size(), groups_per_block);
  std::vector<std::vector<FoundFaces>> parts(blocks);
  std::vector<double> smallest_squares(blocks, squared_reach);
  loop.run(groups_.size(), groups_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    BoxList near;
    for (std::size_t g = begin; g < end; ++g) {
      const Box box = box_of(groups_[g], points);
      near.clear();
      faces_about_[g].clear();
      for (const std::uint32_t face : faces_around_[g]) {
        const double square = squared_distance(box, face_boxes_[face]);
        if (square < squared_about) faces_about_[g].push_back(face);
        if (square < squared_reach) near.add(face, face_boxes_[face]);
      }
      for (const std::uint32_t node : nodes_of(groups_[g])) {
        FoundFaces found{node, {}};
        near.measure(points[node]);
        for (std::size_t n = 0; n < near.faces.size(); ++n) {
          const std::uint32_t face = near.faces[n];
          if (near.squares[n] >= squared_reach || surfaces_.is_of_element_behind(node, face)) continue;
          const double square = nearest_on_face(surfaces_.corners(face, points), points[node]).distance_square_m2;
          if (square >= squared_reach) continue;
          smallest_squares[block] = std::min(smallest_squares[block], square);
          found.faces.push_back(face);
        }
        if (found.faces.empty()) continue;
        std::sort(found.faces.begin(), found.faces.end());
        parts[block].push_back(std::move(found));
      }
    }
  });
  std::vector<const FoundFaces*> all;
  for (const std::vector<FoundFaces>& part : parts)
    for (const FoundFaces& found : part) all.push_back(&found);
  std::sort(all.begin(), all.end(), [](const FoundFaces* a, const FoundFaces* b) { return a->node < b->node; });
  ContactCandidates result;
  result.offsets.push_back(0);
  for (const FoundFaces* found : all) {
    result.nodes.push_back(found->node);
    result.faces.insert(result.faces.end(), found->faces.begin(), found->faces.end());
    result.offsets.push_back(static_cast<std::uint32_t>(result.faces.size()));
  }
  double smallest_square = squared_reach;
  for (const double square : smallest_squares) smallest_square = std::min(smallest_square, square);
  result.smallest_m = std::sqrt(smallest_square);
  return result;
}

double ContactSearch::smallest_distance_m(const ContactCandidates& candidates, std::span<const Point> points) const {
  double smallest_square = reach_m_ * reach_m_;
  for (std::size_t n = 0; n < candidates.nodes.size(); ++n) {
    const Point& point = points[candidates.nodes[n]];
    for (std::size_t f = candidates.offsets[n]; f < candidates.offsets[n + 1]; ++f)
      smallest_square = smaller_square_m2(smallest_square, surfaces_.corners(candidates.faces[f], points), point);
  }
  return std::sqrt(smallest_square);
}

/// Sets the displacements of each face's corners since other positions.
void ContactSearch::set_face_ways(std::span<const Point> points, std::span<const Point> since, const BlockLoop& loop) {
  if (since.empty()) return;
  loop.run(face_ways_.size(), boxes_of_faces_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t face = begin; face < end; ++face) {
      Box ways;
      for (const std::uint32_t node : surfaces_.face(face)) ways.add(difference(points[node], since[node]));
      face_ways_[face] = ways;
    }
  });
}

/// Returns the largest difference of two displacements on one surface.
double ContactSearch::largest_way_m() const {
  double largest = 0.0;
  for (std::size_t s = 0; s < surfaces_.surface_count(); ++s) {
    const std::size_t begin = surfaces_.surface_faces()[s];
    const std::size_t end = surfaces_.surface_faces()[s + 1];
    if (begin == end) continue;
    Box all;
    for (std::size_t face = begin; face < end; ++face) all.add(face_ways_[face]);
    largest = std::max(largest, diagonal_m(all));
  }
  return largest;
}

double ContactSearch::largest_approach_m(std::span<const Point> points, const BlockLoop& loop) {
  set_face_ways(points, searched_points_, loop);
  // What is in no list was further apart than a reach by this.
  const double further_m = (distance_about - 1.0) * reach_m_;
  const double largest_m = largest_way_m();
  if (!(largest_m < distance_about * reach_m_)) return std::numeric_limits<double>::infinity();
  std::vector<double> parts(BlockLoop::block_count(groups_.size(), groups_per_block), std::max(0.0, largest_m - further_m));
  loop.run(groups_.size(), groups_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      Box ways;
      for (const std::uint32_t face : faces_about_[g]) ways.add(face_ways_[face]);
      parts[block] = std::max(parts[block], diagonal_m(ways));
    }
  });
  return parts.empty() ? 0.0 : *std::max_element(parts.begin(), parts.end());
}

}  // namespace menger::fem
