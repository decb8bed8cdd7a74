#include "fem/contact/self_contact_face.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "fem/surfaces/face_tree.h"

namespace menger::fem {
namespace {

/// The weights of a triangle's corners at its point nearest to p; exactly 0 for corners that do not contribute. It depends on the
/// region of the plane that p lies in front of: a corner, an edge or the inside (Ericson, Real-Time Collision Detection, 2005).
std::array<double, 3> nearest_weights(const Point& a, const Point& b, const Point& c, const Point& p) {
  const Point ab = difference(b, a);
  const Point ac = difference(c, a);
  const Point ap = difference(p, a);
  const double ab_a = dot(ab, ap);
  const double ac_a = dot(ac, ap);
  if (ab_a <= 0.0 && ac_a <= 0.0) return {1.0, 0.0, 0.0};
  const Point bp = difference(p, b);
  const double ab_b = dot(ab, bp);
  const double ac_b = dot(ac, bp);
  if (ab_b >= 0.0 && ac_b <= ab_b) return {0.0, 1.0, 0.0};
  const double share_c = ab_a * ac_b - ab_b * ac_a;
  if (share_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) {
    const double along = ab_a / (ab_a - ab_b);
    return {1.0 - along, along, 0.0};
  }
  const Point cp = difference(p, c);
  const double ab_c = dot(ab, cp);
  const double ac_c = dot(ac, cp);
  if (ac_c >= 0.0 && ab_c <= ac_c) return {0.0, 0.0, 1.0};
  const double share_b = ab_c * ac_a - ab_a * ac_c;
  if (share_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) {
    const double along = ac_a / (ac_a - ac_c);
    return {1.0 - along, 0.0, along};
  }
  const double share_a = ab_b * ac_c - ab_c * ac_b;
  if (share_a <= 0.0 && ac_b >= ab_b && ab_c >= ac_c) {
    const double along = (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c));
    return {0.0, 1.0 - along, along};
  }
  const double whole = share_a + share_b + share_c;
  return {1.0 - share_b / whole - share_c / whole, share_b / whole, share_c / whole};
}

/// The square of the distance of a point from the box of three others, a lower bound of that from their triangle.
double box_distance_square(const Point& a, const Point& b, const Point& c, const Point& p) {
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = std::min(std::min(a[i], b[i]), c[i]) - p[i];
    const double high = p[i] - std::max(std::max(a[i], b[i]), c[i]);
    const double apart = low > high ? low : high;
    const double outside = 0.5 * (apart + std::abs(apart));  // without a branch
    square += outside * outside;
  }
  return square;
}

std::array<int, 2> rim_of(const std::array<double, 3>& weights, int corner, int next) {
  if (weights[2] > 0.0) return {-1, -1};
  if (weights[1] == 0.0) return {corner, corner};
  if (weights[0] == 0.0) return {next, next};
  return {corner, next};
}

}  // namespace

NearestOnFace nearest_on_face(const FaceCorners& corners, const Point& point) {
  const Point middle = centre(corners);
  NearestOnFace nearest;
  nearest.distance_square_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    if (!(box_distance_square(corners[i], corners[next], middle, point) < nearest.distance_square_m2)) continue;
    const std::array<double, 3> w = nearest_weights(corners[i], corners[next], middle, point);
    const Point at = sum(sum(scaled(w[0], corners[i]), scaled(w[1], corners[next])), scaled(w[2], middle));
    const Point apart = difference(point, at);
    if (dot(apart, apart) >= nearest.distance_square_m2) continue;
    nearest = {at, {}, dot(apart, apart), rim_of(w, static_cast<int>(i), static_cast<int>(next)), i, w};
    nearest.weights.fill(0.25 * w[2]);
    nearest.weights[i] += w[0];
    nearest.weights[next] += w[1];
  }
  return nearest;
}

double smaller_square_m2(double square_m2, const FaceCorners& corners, const Point& point) {
  Box box;
  for (const Point& corner : corners) box.add(corner);
  if (squared_distance(point, box) >= square_m2) return square_m2;
  return std::min(square_m2, nearest_on_face(corners, point).distance_square_m2);
}

}  // namespace menger::fem
