#pragma once

#include <array>
#include <cstddef>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// The corners of a face in their order around it, such that (1 - 0) x (3 - 0) points into the air.
using FaceCorners = std::array<Point, 4>;

/// The point of a face that is nearest to another point.
struct NearestOnFace {
  Point point{};
  std::array<double, 4> weights{};  ///< of the corners: point = sum of weight times corner; >= 0, with sum 1
  double distance_square_m2 = 0.0;
  /// If the point lies on the rim: the two corners of its edge, or the same corner twice. -1: it lies within the face.
  std::array<int, 2> rim{-1, -1};
  std::size_t part = 0;            ///< the triangle that holds the point: the one at the edge from this corner to the next
  std::array<double, 3> shares{};  ///< weights of that triangle's corners: this corner, the next, the centre
};

/// Returns the point of a face that is nearest to a point. The face is represented by four flat triangles between its edges and
/// the mean of its corners. They have the edges and the centre of the bilinear face, and rotate and mirror with it. They differ
/// from it by at most a quarter of a corner's height over the mean plane. Of several nearest points it returns the first.
NearestOnFace nearest_on_face(const FaceCorners& corners, const Point& point);

/// Returns the smaller of two squares, m^2: a given one, and that of the distance between a face and a point.
double smaller_square_m2(double square_m2, const FaceCorners& corners, const Point& point);

/// The area of a face times its mean normal, m^2.
inline Point area_vector(const FaceCorners& corners) {
  return scaled(0.5, cross(difference(corners[2], corners[0]), difference(corners[3], corners[1])));
}

inline Point centre(const FaceCorners& corners) {
  return scaled(0.25, sum(sum(corners[0], corners[1]), sum(corners[2], corners[3])));
}

}  // namespace menger::fem
