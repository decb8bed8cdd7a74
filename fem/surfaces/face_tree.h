#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "fem/surfaces/point.h"
#include "fem/surfaces/triangle.h"

namespace menger::fem {

/// A box along the axes; empty until points are added.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};

  void add(const Point& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  void add(const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
};

/// The larger of two numbers, without a branch.
inline double larger(double a, double b) { return a > b ? a : b; }

/// A number, or 0 where it is negative, without a branch: signs of distances do not follow a pattern.
inline double positive_part(double a) { return 0.5 * (a + std::abs(a)); }

/// Returns the square of the distance between two boxes, m^2; 0 if they meet.
inline double squared_distance(const Box& a, const Box& b) {
  double result = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double apart = positive_part(larger(a.low[i] - b.high[i], b.low[i] - a.high[i]));
    result += apart * apart;
  }
  return result;
}

/// Returns the square of the distance of a point from a box, m^2; 0 inside.
inline double squared_distance(const Point& point, const Box& box) {
  double result = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double apart = positive_part(larger(point[i] - box.high[i], box.low[i] - point[i]));
    result += apart * apart;
  }
  return result;
}

/// A cone that contains directions.
struct NormalCone {
  Point axis{0.0, 0.0, 1.0};  ///< unit vector
  double half_angle = -1.0;   ///< rad, up to pi; negative for a cone without directions
};

/// Returns a cone that contains two cones; it is not always the narrowest one.
NormalCone merged(const NormalCone& a, const NormalCone& b);

/// Returns the largest angle between a direction of one cone and one of the other, rad, at most pi. @param a, b not empty
double largest_angle(const NormalCone& a, const NormalCone& b);

/// A tree over faces that are cut into triangles.
struct FaceTree {
  /// A node of the tree; box and cone contain all faces below it.
  struct Node {
    Box box;
    NormalCone normals;
    std::size_t children[2] = {0, 0};  ///< both 0: a leaf
    std::size_t face = 0;              ///< of a leaf

    [[nodiscard]] bool is_leaf() const { return children[0] == children[1]; }
  };

  std::vector<Node> nodes;

  /// The roots of up to six trees, one for each half-axis (+x, -x, ...) that a face's mean normal can be nearest to. Walls of
  /// different directions share no node, so that cones stay narrow.
  std::vector<std::size_t> roots;
};

/// Builds the tree of the faces. Face f consists of the triangles from f * triangles_per_face on. Faces without area are left
/// out.
FaceTree face_tree(std::span<const Triangle> triangles, std::size_t triangles_per_face);

}  // namespace menger::fem
