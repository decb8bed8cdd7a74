#include "fem/surfaces/cap_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/surfaces/chamber_volume.h"
#include "tests/unit/fem/surfaces/face_samples.h"

namespace menger::fem {
namespace {

/// The rim of an open top, round which the air is on the left as seen from above: (first - c) x (last - c) points up.
template <std::size_t k>
struct SampleCap {
  Rim<k> rim;
  std::vector<Point> nodes;
};

/// A loop of `count` segments about the point c, from the angle `start` over the angle `sweep`.
template <std::size_t k, class Map>
SampleCap<k> loop(std::size_t count, double start, double sweep, const Map& map) {
  SampleCap<k> cap;
  const std::size_t steps = (k - 1) * count;
  const bool is_closed = sweep > 1.99 * std::numbers::pi;
  for (std::size_t s = 0; s < steps + (is_closed ? 0 : 1); ++s) {
    const double angle = start + sweep * static_cast<double>(s) / static_cast<double>(steps);
    cap.nodes.push_back(map(Point{std::cos(angle), std::sin(angle), 0.0}));
  }
  for (std::size_t s = 0; s < count; ++s) {
    std::array<std::size_t, k> segment{};
    for (std::size_t i = 0; i < k; ++i) segment[i] = ((k - 1) * s + i) % cap.nodes.size();
    cap.rim.segments.push_back(segment);
  }
  return cap;
}

Point unchanged(const Point& p) { return p; }

/// The rim of a box without its top, all of whose nodes are nodes of the walls.
template <std::size_t n>
auto rim_of_open_box(const SampleSurface<n>& surface, double top, std::size_t cells, const Point& low, const Point& size) {
  constexpr std::size_t k = face_degree<n> + 1;
  SampleCap<k> cap;
  const std::array<Point, 4> corners{{{low[0], low[1], top},
                                      {low[0] + size[0], low[1], top},
                                      {low[0] + size[0], low[1] + size[1], top},
                                      {low[0], low[1] + size[1], top}}};
  const std::size_t steps = (k - 1) * cells;
  for (std::size_t side = 0; side < 4; ++side) {
    for (std::size_t s = 0; s < steps; ++s) {
      const double t = static_cast<double>(s) / static_cast<double>(steps);
      const Point p = sum(scaled(1.0 - t, corners[side]), scaled(t, corners[(side + 1) % 4]));
      const auto node =
          std::find_if(surface.nodes.begin(), surface.nodes.end(), [&](const Point& q) { return norm(difference(p, q)) < 1e-9; });
      EXPECT_NE(node, surface.nodes.end());
      cap.nodes.push_back(*node);
    }
  }
  for (std::size_t s = 0; s < 4 * cells; ++s) {
    std::array<std::size_t, k> segment{};
    for (std::size_t i = 0; i < k; ++i) segment[i] = ((k - 1) * s + i) % cap.nodes.size();
    cap.rim.segments.push_back(segment);
  }
  return cap;
}

template <std::size_t n>
void expect_open_box_with_cap() {
  const Point low{0.2, -0.3, 0.1};
  const Point size{0.8, 1.0, 0.5};
  auto surface = box_chamber<n>(low, size, 2, false);
  auto cap = rim_of_open_box(surface, low[2] + size[2], 2, low, size);
  const auto total = [&](const Point& origin) {
    double volume = cap_volume(cap.rim, std::span<const Point>(cap.nodes), origin);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) volume += chamber_volume(surface.positions(f), origin);
    return volume;
  };
  EXPECT_NEAR(total({}), 0.4, 1e-14);
  EXPECT_NEAR(total({2.0, 7.0, -3.0}), 0.4, 1e-13);
  // Bent, the fan still closes the surface: the volume does not depend on the origin.
  surface.deform(bent);
  std::transform(cap.nodes.begin(), cap.nodes.end(), cap.nodes.begin(), bent);
  EXPECT_NEAR(total({2.0, 7.0, -3.0}), total({}), 1e-13);
  EXPECT_GT(std::abs(total({}) - 0.4), 0.01);
}

TEST(CapVolume, ClosesAnOpenBox) {
  expect_open_box_with_cap<4>();
  expect_open_box_with_cap<9>();
}

/// A flat polygon and a flat loop of parabolas at the height 0.7 under the origin's cone: V = 0.7 area / 3.
TEST(CapVolume, OfAFlatRimIsAConeOfItsArea) {
  const auto raised = [](const Point& p) -> Point { return {2.0 * p[0], p[1], 0.7}; };
  const auto polygon = loop<2>(6, 0.0, 2.0 * std::numbers::pi, raised);
  EXPECT_NEAR(cap_volume(polygon.rim, std::span<const Point>(polygon.nodes)), 0.7 * 2.0 * (3.0 * std::sqrt(3.0) / 2.0) / 3.0,
              1e-14);

  // A parabola adds two thirds of chord times sagitta to the polygon through its ends.
  const auto round = loop<3>(6, 0.0, 2.0 * std::numbers::pi, raised);
  const double segment = 2.0 / 3.0 * 1.0 * (1.0 - std::cos(std::numbers::pi / 6.0));
  EXPECT_NEAR(cap_volume(round.rim, std::span<const Point>(round.nodes)),
              0.7 * 2.0 * (3.0 * std::sqrt(3.0) / 2.0 + 6.0 * segment) / 3.0, 1e-14);
}

TEST(CapVolume, OfStraightParabolasIsThatOfTheirChords) {
  const auto chords = loop<2>(5, 0.3, 2.0 * std::numbers::pi, bent);
  SampleCap<3> straight;
  for (std::size_t s = 0; s < 5; ++s) {
    straight.nodes.push_back(chords.nodes[s]);
    straight.nodes.push_back(scaled(0.5, sum(chords.nodes[s], chords.nodes[(s + 1) % 5])));
    straight.rim.segments.push_back({2 * s, 2 * s + 1, (2 * s + 2) % 10});
  }
  EXPECT_NEAR(cap_volume(straight.rim, std::span<const Point>(straight.nodes)),
              cap_volume(chords.rim, std::span<const Point>(chords.nodes)), 1e-15);
}

/// A quarter of a round cap on a saddle, cut by the planes x = 0 and y = 0, against the whole cap.
template <std::size_t k>
void expect_quarter_of_cap() {
  const auto saddle = [](const Point& p) -> Point { return {p[0], p[1], 0.5 + 0.2 * p[0] * p[0] - 0.1 * p[1] * p[1]}; };
  const auto whole = loop<k>(8, 0.0, 2.0 * std::numbers::pi, saddle);
  auto quarter = loop<k>(2, 0.0, 0.5 * std::numbers::pi, saddle);
  quarter.rim.mirrored = {true, true, false};
  EXPECT_NEAR(4.0 * cap_volume(quarter.rim, std::span<const Point>(quarter.nodes)),
              cap_volume(whole.rim, std::span<const Point>(whole.nodes)), 1e-14);
}

TEST(CapVolume, OfAMirroredPartIsItsPartOfTheWhole) {
  expect_quarter_of_cap<2>();
  expect_quarter_of_cap<3>();
}

template <std::size_t k>
void expect_derivatives(const SampleCap<k>& cap) {
  const Point origin{0.3, -0.2, 0.1};
  const std::size_t size = 3 * cap.nodes.size();
  const auto gradient = cap_volume_gradient(cap.rim, std::span<const Point>(cap.nodes), origin);
  const auto hessian = cap_volume_hessian(cap.rim, std::span<const Point>(cap.nodes), origin);
  ASSERT_EQ(gradient.size(), size);
  ASSERT_EQ(hessian.size(), size * size);
  double largest_gradient = 0.0;
  double largest_hessian = 0.0;
  for (std::size_t j = 0; j < size; ++j) {
    // V is quadratic in each coordinate: central differences are exact but for rounding.
    auto plus = cap.nodes;
    auto minus = cap.nodes;
    plus[j / 3][j % 3] += 0.5;
    minus[j / 3][j % 3] -= 0.5;
    const std::span<const Point> high(plus);
    const std::span<const Point> low(minus);
    EXPECT_NEAR(gradient[j], cap_volume(cap.rim, high, origin) - cap_volume(cap.rim, low, origin), 1e-14);
    const auto high_gradient = cap_volume_gradient(cap.rim, high, origin);
    const auto low_gradient = cap_volume_gradient(cap.rim, low, origin);
    for (std::size_t i = 0; i < size; ++i) {
      EXPECT_NEAR(hessian[i * size + j], high_gradient[i] - low_gradient[i], 1e-14);
      EXPECT_EQ(hessian[i * size + j], hessian[j * size + i]);
      largest_hessian = std::max(largest_hessian, std::abs(hessian[i * size + j]));
    }
    largest_gradient = std::max(largest_gradient, std::abs(gradient[j]));
  }
  EXPECT_GT(largest_gradient, 0.01);
  EXPECT_GT(largest_hessian, 0.01);
}

TEST(CapVolume, DerivativesMatchDifferences) {
  expect_derivatives(loop<2>(5, 0.2, 2.0 * std::numbers::pi, bent));
  expect_derivatives(loop<3>(4, 0.2, 2.0 * std::numbers::pi, bent));
  auto part = loop<3>(2, 0.0, 0.5 * std::numbers::pi, unchanged);
  part.rim.mirrored = {true, true, false};
  expect_derivatives(part);
}

/// Pushing a closed chamber as a whole does no work against its pressure: faces and cap together.
TEST(CapVolume, PressureOnCapAndWallsBalances) {
  const Point low{0.2, -0.3, 0.1};
  const Point size{0.8, 1.0, 0.5};
  auto surface = box_chamber<9>(low, size, 2, false);
  auto cap = rim_of_open_box(surface, low[2] + size[2], 2, low, size);
  surface.deform(bent);
  std::transform(cap.nodes.begin(), cap.nodes.end(), cap.nodes.begin(), bent);
  Point force{};
  Point on_cap{};
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto gradient = chamber_volume_gradient(surface.positions(f));
    for (std::size_t j = 0; j < gradient.size(); ++j) force[j % 3] += gradient[j];
  }
  const auto gradient = cap_volume_gradient(cap.rim, std::span<const Point>(cap.nodes));
  for (std::size_t j = 0; j < gradient.size(); ++j) on_cap[j % 3] += gradient[j];
  EXPECT_LT(norm(sum(force, on_cap)), 1e-14);
  EXPECT_GT(norm(on_cap), 0.1);
}

}  // namespace
}  // namespace menger::fem
