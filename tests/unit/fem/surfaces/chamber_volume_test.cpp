#include "fem/surfaces/chamber_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/fem/surfaces/face_samples.h"

namespace menger::fem {
namespace {

template <std::size_t n>
double enclosed(const SampleSurface<n>& surface, const Point& origin = {}) {
  double volume = 0.0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) volume += chamber_volume(surface.positions(f), origin);
  return volume;
}

template <std::size_t n>
FaceNodes<n> bent_face() {
  SampleSurface<n> surface;
  add_rectangle(surface, {0.3, -0.2, 0.4}, {0.9, 0.1, 0.2}, {-0.1, 0.8, 0.3}, 1, 1);
  surface.deform(bent);
  return surface.positions(0);
}

/// int N_a x_u x x_v du dv by a rule of four points each way, which is exact.
template <std::size_t n>
std::array<Point, n> area_vectors(const FaceNodes<n>& nodes) {
  constexpr std::size_t degree = face_degree<n>;
  constexpr std::size_t width = degree + 1;
  std::array<Point, n> result{};
  for (const auto& at_v : gauss_rule<4>()) {
    for (const auto& at_u : gauss_rule<4>()) {
      const auto nu = shape_values<degree>(at_u.position);
      const auto nv = shape_values<degree>(at_v.position);
      Point by_u{};
      Point by_v{};
      for (std::size_t a = 0; a < n; ++a) {
        by_u = sum(by_u, scaled(shape_derivatives<degree>(at_u.position)[a % width] * nv[a / width], nodes[a]));
        by_v = sum(by_v, scaled(nu[a % width] * shape_derivatives<degree>(at_v.position)[a / width], nodes[a]));
      }
      const Point normal = scaled(at_u.weight * at_v.weight, cross(by_u, by_v));
      for (std::size_t a = 0; a < n; ++a) result[a] = sum(result[a], scaled(nu[a % width] * nv[a / width], normal));
    }
  }
  return result;
}

template <std::size_t n>
void expect_volume_of_sheared_box() {
  auto surface = box_chamber<n>({0.1, -0.2, 0.3}, {0.5, 0.7, 1.1}, 2);
  EXPECT_NEAR(enclosed(surface), 0.5 * 0.7 * 1.1, 1e-14);
  // An affine map of determinant 1.2 * 0.9 * 1.5 - 0.3 * 0.2 * 1.5.
  surface.deform([](const Point& p) -> Point {
    return {1.2 * p[0] + 0.3 * p[1], 0.2 * p[0] + 0.9 * p[1], 1.5 * p[2] + 0.4 * p[0]};
  });
  EXPECT_NEAR(enclosed(surface), 0.5 * 0.7 * 1.1 * 1.53, 1e-14);
  EXPECT_NEAR(enclosed(surface, {3.0, -2.0, 5.0}), 0.5 * 0.7 * 1.1 * 1.53, 1e-13);
}

TEST(ChamberVolume, IsThatOfAShearedBox) {
  expect_volume_of_sheared_box<4>();
  expect_volume_of_sheared_box<9>();
}

/// One biquadratic face per wall represents these walls exactly: below z = c (1 - x^2)(1 - y^2) on [-1, 1]^2, int = 16 c / 9.
TEST(ChamberVolume, IsExactForBiquadraticBulges) {
  auto surface = box_chamber<9>({-1.0, -1.0, 0.0}, {2.0, 2.0, 1.0}, 1);
  surface.deform([](const Point& p) -> Point {
    return {p[0], p[1], p[2] * (1.0 + 0.6 * (1.0 - p[0] * p[0]) * (1.0 - p[1] * p[1]))};
  });
  EXPECT_NEAR(enclosed(surface), 4.0 + 0.6 * 16.0 / 9.0, 1e-14);
}

/// The bilinear roof over the corner heights 1, 2, 3, 5 of the unit square: their mean.
TEST(ChamberVolume, IsExactForTwistedBilinearFaces) {
  auto surface = box_chamber<4>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, 1);
  surface.deform([](const Point& p) -> Point { return {p[0], p[1], p[2] * (1.0 + p[0] + 2.0 * p[1] + p[0] * p[1])}; });
  EXPECT_NEAR(enclosed(surface), (1.0 + 2.0 + 3.0 + 5.0) / 4.0, 1e-14);
}

/// An eighth of a bent box that is symmetric to three planes through (2, 3, 4): the faces on the planes add nothing.
TEST(ChamberVolume, PlanesOfSymmetryThroughTheOriginCloseIt) {
  const Point origin{2.0, 3.0, 4.0};
  SampleSurface<9> eighth;
  add_rectangle(eighth, {2.0, 3.0, 5.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 1, 1);
  add_rectangle(eighth, {3.0, 3.0, 4.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 1, 1);
  add_rectangle(eighth, {2.0, 4.0, 4.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1, 1);
  eighth.deform([](const Point& p) -> Point {
    const double x = p[0] - 2.0;
    const double y = p[1] - 3.0;
    return {p[0], p[1], 4.0 + (p[2] - 4.0) * (1.0 - 0.3 * x * x - 0.2 * y * y)};
  });
  EXPECT_NEAR(enclosed(eighth, origin), 1.0 - 0.1 - 0.2 / 3.0, 1e-14);
}

template <std::size_t n>
void expect_gradient_by_differences() {
  const auto nodes = bent_face<n>();
  const Point origin{0.2, 0.5, -0.4};
  const auto gradient = chamber_volume_gradient(nodes, origin);
  for (std::size_t k = 0; k < 3 * n; ++k) {
    // V is linear in each coordinate: differences are exact but for rounding.
    auto plus = nodes;
    auto minus = nodes;
    plus[k / 3][k % 3] += 0.5;
    minus[k / 3][k % 3] -= 0.5;
    EXPECT_NEAR(gradient[k], chamber_volume(plus, origin) - chamber_volume(minus, origin), 1e-14) << n << " " << k;
  }
}

TEST(ChamberVolume, GradientMatchesDifferences) {
  expect_gradient_by_differences<4>();
  expect_gradient_by_differences<9>();
}

template <std::size_t n>
void expect_hessian_by_differences() {
  const auto nodes = bent_face<n>();
  const Point origin{0.2, 0.5, -0.4};
  const auto hessian = chamber_volume_hessian(nodes, origin);
  double largest = 0.0;
  for (std::size_t k = 0; k < 3 * n; ++k) {
    auto plus = nodes;
    auto minus = nodes;
    plus[k / 3][k % 3] += 0.5;
    minus[k / 3][k % 3] -= 0.5;
    const auto high = chamber_volume_gradient(plus, origin);
    const auto low = chamber_volume_gradient(minus, origin);
    for (std::size_t r = 0; r < 3 * n; ++r) {
      EXPECT_NEAR(hessian[r * 3 * n + k], high[r] - low[r], 1e-14) << n << " " << r << " " << k;
      EXPECT_EQ(hessian[r * 3 * n + k], hessian[k * 3 * n + r]);
      largest = std::max(largest, std::abs(hessian[r * 3 * n + k]));
    }
  }
  EXPECT_GT(largest, 0.01);
}

TEST(ChamberVolume, HessianMatchesDifferencesAndIsSymmetricFaceByFace) {
  expect_hessian_by_differences<4>();
  expect_hessian_by_differences<9>();
}

/// The load of a pressure on a deformed closed surface, once as the gradient of the volume and once as -int N_a n dA.
template <std::size_t n>
void expect_follower_load() {
  auto surface = box_chamber<n>({0.0, 0.0, 0.0}, {1.0, 0.8, 0.6}, 2);
  surface.deform(bent);
  std::vector<Point> gradient(surface.nodes.size());
  std::vector<Point> load(surface.nodes.size());
  double largest_difference_on_a_face = 0.0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto from_volume = chamber_volume_gradient(surface.positions(f));
    const auto from_areas = area_vectors(surface.positions(f));
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t i = 0; i < 3; ++i) {
        gradient[surface.faces[f][a]][i] += from_volume[3 * a + i];
        load[surface.faces[f][a]][i] -= from_areas[a][i];
        largest_difference_on_a_face =
            std::max(largest_difference_on_a_face, std::abs(from_volume[3 * a + i] + from_areas[a][i]));
      }
    }
  }
  double largest = 0.0;
  for (std::size_t a = 0; a < load.size(); ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(gradient[a][i], load[a][i], 1e-14);
      largest = std::max(largest, std::abs(load[a][i]));
    }
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_GT(largest_difference_on_a_face, 0.01);
}

TEST(ChamberVolume, GradientIsTheFollowerLoadOfAClosedSurfaceButNotOfAFace) {
  expect_follower_load<4>();
  expect_follower_load<9>();
}

}  // namespace
}  // namespace menger::fem
