#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// The corners of a face, which run around it such that (1 - 0) x (3 - 0) points into the air.
using FaceCorners = std::array<Point, 4>;

/// The point of a face that is nearest to another point.
struct NearestOnFace {
  Point point{};
  std::array<double, 4> weights{};  ///< of the corners: point = sum of weight times corner; >= 0, their sum is 1
  double distance_square_m2 = 0.0;
  /// Where the point lies on the rim: the corners of an edge, or twice the same corner; nothing within the face is -1.
  std::array<int, 2> rim{-1, -1};
  std::size_t part = 0;            ///< the triangle of the point: that at the edge from this corner to the next
  std::array<double, 3> shares{};  ///< of that triangle's corners: this one, the next, the centre
};

/// Four flat triangles between the edges of a face and the mean of its corners stand for the face: they have its edges and its
/// centre, turn and mirror with it, and are a quarter of a corner's height over the mean plane away from the bilinear face at
/// most. The first of several nearest points is taken.
NearestOnFace nearest_on_face(const FaceCorners& corners, const Point& point);

/// The area of a face times its mean normal, m^2.
inline Point area_vector(const FaceCorners& corners) {
  return scaled(0.5, cross(difference(corners[2], corners[0]), difference(corners[3], corners[1])));
}

inline Point centre(const FaceCorners& corners) {
  return scaled(0.25, sum(sum(corners[0], corners[1]), sum(corners[2], corners[3])));
}

}  // namespace menger::fem
