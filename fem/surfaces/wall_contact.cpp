#include "fem/surfaces/wall_contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "fem/surfaces/face.h"
#include "fem/surfaces/face_tree.h"
#include "fem/surfaces/triangle.h"

namespace menger::fem {
namespace {

constexpr double least_facing_angle = 2.0 * std::numbers::pi / 3.0;
constexpr double largest_facing_cosine = -0.5;        // cosine of that angle
constexpr double least_sight_cosine = 0.70710678118;  // cosine of 45 degrees

// A crossing must be deeper by this factor to replace another one: on flat walls all points are equally deep except for rounding.
constexpr double least_growth = 1.0 + 1e-6;

template <std::size_t n>
constexpr std::size_t triangles_per_face = 2 * face_degree<n>* face_degree<n>;

template <std::size_t n>
std::vector<Triangle> triangles_of(std::span<const std::array<std::size_t, n>> faces, std::span<const Point> nodes) {
  constexpr std::size_t degree = face_degree<n>;
  constexpr std::size_t width = degree + 1;
  std::vector<Triangle> triangles;
  triangles.reserve(faces.size() * triangles_per_face<n>);
  for (const auto& face : faces) {
    const auto at = [&](std::size_t i, std::size_t j) -> const Point& {
      assert(face[i + width * j] < nodes.size());
      return nodes[face[i + width * j]];
    };
    for (std::size_t j = 0; j < degree; ++j) {
      for (std::size_t i = 0; i < degree; ++i) {
        triangles.push_back(triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1)));
        triangles.push_back(triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1)));
      }
    }
  }
  return triangles;
}

/// The smallest and largest coordinate of a triangle's corners along a direction.
std::pair<double, double> extent(const Triangle& triangle, const Point& direction) {
  const double a = dot(triangle.corners[0], direction);
  const double b = dot(triangle.corners[1], direction);
  const double c = dot(triangle.corners[2], direction);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

/// The largest coordinate of a box along a direction.
double highest(const Box& box, const Point& direction) {
  double result = 0.0;
  for (std::size_t i = 0; i < 3; ++i) result += std::max(box.low[i] * direction[i], box.high[i] * direction[i]);
  return result;
}

Box box_of(const Triangle& triangle) {
  Box box;
  for (const Point& corner : triangle.corners) box.add(corner);
  return box;
}

/// Visits pairs of nodes of the tree and keeps the smallest gap and the deepest crossing.
template <std::size_t n>
class GapSearch {
 public:
  GapSearch(std::span<const std::array<std::size_t, n>> faces, std::span<const Point> nodes, double largest_depth,
            double largest_gap)
      : faces_(faces),
        triangles_(triangles_of(faces, nodes)),
        tree_(face_tree(triangles_, triangles_per_face<n>)),
        largest_depth_(largest_depth),
        least_distance_(largest_gap) {}

  std::optional<WallGap> result() {
    for (std::size_t a = 0; a < tree_.roots.size(); ++a)
      for (std::size_t b = a; b < tree_.roots.size(); ++b) visit(tree_.roots[a], tree_.roots[b]);
    return crossing_ ? crossing_ : gap_;
  }

 private:
  void visit(std::size_t a, std::size_t b) {
    const FaceTree::Node& first = tree_.nodes[a];
    const FaceTree::Node& second = tree_.nodes[b];
    // The margin is larger than the rounding of the cones.
    if (largest_angle(first.normals, second.normals) < least_facing_angle - 1e-6) return;
    const double squared = squared_distance(first.box, second.box);
    if (!may_matter(first, second, squared)) return;
    if (first.is_leaf() && second.is_leaf()) {
      if (a != b && !share_a_corner(first.face, second.face)) compare(first.face, second.face);
    } else if (a == b) {
      visit(first.children[0], first.children[1]);
      visit(first.children[0], first.children[0]);
      visit(first.children[1], first.children[1]);
    } else if (second.is_leaf() || (!first.is_leaf() && diagonal(first.box) > diagonal(second.box))) {
      visit_nearer_first(first.children, b);
    } else {
      visit_nearer_first(second.children, a);
    }
  }

  /// Whether parts at this distance or more can contain the smallest gap. Once walls cross, no gap is needed.
  [[nodiscard]] bool may_be_nearest(double squared_distance) const {
    return !crossing_ && squared_distance < least_distance_ * least_distance_;
  }

  /// Whether parts can contain the smallest gap or the deepest crossing. All directions along which depths are measured lie
  /// within `spread` of the cones' mean direction. Pairs of points that count lie within another 45 degrees of it or of its
  /// reverse.
  [[nodiscard]] bool may_matter(const FaceTree::Node& first, const FaceTree::Node& second, double squared_distance) const {
    const bool is_near = may_be_nearest(squared_distance);
    const bool is_in_reach = squared_distance < squared_reach();
    if (!is_near && !is_in_reach) return false;
    const double spread = first.normals.half_angle + second.normals.half_angle;
    const Point facing = difference(first.normals.axis, second.normals.axis);
    if (spread > 0.25 * std::numbers::pi - 0.1 || dot(facing, facing) < 1.0) return true;  // too wide to decide
    const Point direction = scaled(1.0 / norm(facing), facing);
    const Point reverse = scaled(-1.0, direction);
    const double least_height = std::cos(0.25 * std::numbers::pi + spread) * std::sqrt(squared_distance);
    if (is_near && highest(second.box, direction) + highest(first.box, reverse) >= least_height) return true;
    const double overlap = highest(first.box, direction) + highest(second.box, reverse);
    return is_in_reach && overlap >= least_height &&
           overlap + std::sqrt(squared_reach()) * std::sin(spread) > deepest_ * least_growth;
  }

  /// The square of the largest distance of two points that count as crossing: 45 degrees off the direction of the depth.
  [[nodiscard]] double squared_reach() const {
    return largest_depth_ * largest_depth_ / (least_sight_cosine * least_sight_cosine);
  }

  void visit_nearer_first(const std::size_t (&children)[2], std::size_t other) {
    const Box& box = tree_.nodes[other].box;
    const bool swaps = squared_distance(tree_.nodes[children[1]].box, box) < squared_distance(tree_.nodes[children[0]].box, box);
    visit(children[swaps ? 1 : 0], other);
    visit(children[swaps ? 0 : 1], other);
  }

  static double diagonal(const Box& box) { return norm(difference(box.high, box.low)); }

  [[nodiscard]] bool share_a_corner(std::size_t a, std::size_t b) const {
    constexpr std::size_t degree = face_degree<n>;
    constexpr std::array<std::size_t, 4> corners{0, degree, n - 1 - degree, n - 1};
    return std::any_of(corners.begin(), corners.end(), [&](std::size_t i) {
      return std::any_of(corners.begin(), corners.end(), [&](std::size_t j) { return faces_[a][i] == faces_[b][j]; });
    });
  }

  void compare(std::size_t a, std::size_t b) {
    const std::span<const Triangle> all(triangles_);
    for (const Triangle& first : all.subspan(a * triangles_per_face<n>, triangles_per_face<n>))
      for (const Triangle& second : all.subspan(b * triangles_per_face<n>, triangles_per_face<n>)) compare(first, second, {a, b});
  }

  void compare(const Triangle& first, const Triangle& second, const std::array<std::size_t, 2>& faces) {
    if (dot(first.normal, second.normal) > largest_facing_cosine) return;
    const Point facing = difference(first.normal, second.normal);
    const Point direction = scaled(1.0 / norm(facing), facing);
    const auto [first_low, first_high] = extent(first, direction);
    const auto [second_low, second_high] = extent(second, direction);
    const double overlap = first_high - second_low;
    if (-overlap >= least_distance_) return;
    const double squared = squared_distance(box_of(first), box_of(second));
    const bool may_be_deepest =
        overlap > deepest_ * least_growth && squared < squared_reach() && squared <= 2.001 * overlap * overlap;
    if (!may_be_deepest && !(may_be_nearest(squared) && second_high >= first_low)) return;
    for_each_near_pair(first, second, [&](const Point& x, const Point& y) {
      const Point to_second = difference(y, x);
      const double ahead = dot(to_second, direction);
      const double distance = norm(to_second);
      if (std::abs(ahead) < least_sight_cosine * distance) return;
      if (ahead >= 0.0) {
        if (!crossing_ && distance < least_distance_) {
          least_distance_ = distance;
          gap_ = {.gap_m = distance, .is_crossing = false, .points = {x, y}, .faces = faces};
        }
      } else if (-ahead > deepest_ && -ahead <= largest_depth_) {
        deepest_ = -ahead;
        crossing_ = {.gap_m = ahead, .is_crossing = true, .points = {x, y}, .faces = faces};
      }
    });
  }

  std::span<const std::array<std::size_t, n>> faces_;
  std::vector<Triangle> triangles_;
  FaceTree tree_;
  double largest_depth_;
  double least_distance_;  // so far
  double deepest_ = 0.0;
  std::optional<WallGap> gap_;
  std::optional<WallGap> crossing_;
};

}  // namespace

template <std::size_t n>
std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, n>> faces, std::span<const Point> nodes,
                                         double largest_depth_m, double largest_gap_m) {
  return GapSearch<n>(faces, nodes, largest_depth_m, largest_gap_m).result();
}

template std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, 4>>, std::span<const Point>, double,
                                                  double);
template std::optional<WallGap> smallest_wall_gap(std::span<const std::array<std::size_t, 9>>, std::span<const Point>, double,
                                                  double);

}  // namespace menger::fem
