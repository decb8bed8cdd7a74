#include "meshes/load_cases/outermost_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace menger::meshes {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
using Place = std::array<double, 3>;

/// The corners of three cubes of 1 cm that form a hook: one on the ground, one beside it, one above the first.
std::vector<Place> hook() {
  std::vector<Place> points;
  for (const Place& cell : {Place{0, 0, 0}, Place{1, 0, 0}, Place{0, 0, 1}})
    for (int corner = 0; corner < 8; ++corner)
      points.push_back({0.01 * (cell[0] + corner % 2), 0.01 * (cell[1] + corner / 2 % 2), 0.01 * (cell[2] + corner / 4)});
  return points;
}

/// Displacements of points that are stretched along z, turned about x and then about z, and moved.
std::vector<double> displaced(const std::vector<Place>& points, double stretch, double about_x, double about_z) {
  std::vector<double> displacements_m;
  for (const Place& point : points) {
    const Place stretched{point[0], point[1], stretch * point[2]};
    const Place tilted{stretched[0], std::cos(about_x) * stretched[1] - std::sin(about_x) * stretched[2],
                       std::sin(about_x) * stretched[1] + std::cos(about_x) * stretched[2]};
    const Place turned{std::cos(about_z) * tilted[0] - std::sin(about_z) * tilted[1],
                       std::sin(about_z) * tilted[0] + std::cos(about_z) * tilted[1], tilted[2]};
    for (std::size_t i = 0; i < 3; ++i) displacements_m.push_back(turned.at(i) + 0.1 - point.at(i));
  }
  return displacements_m;
}

// Tolerance: the fit of the rotation ends at changes of 1e-14, and converges slowly where bodies are nearly alike along two axes.
TEST(OutermostPoints, TheUprightAxisTurnsWithTheBody) {
  const std::vector<Place> points = hook();
  const OutermostPoints outermost(points);
  const auto expect_axis = [&](const std::vector<double>& displacements_m, const Place& expected) {
    const Place axis = outermost.upright_axis(displacements_m);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(axis.at(i), expected.at(i), 1e-6) << i;
  };
  expect_axis(displaced(points, 1.0, 0.0, 0.0), {0.0, 0.0, 1.0});
  expect_axis(displaced(points, 1.3, 0.0, 0.0), {0.0, 0.0, 1.0});
  expect_axis(displaced(points, 1.0, 0.0, 70.0 * degree), {0.0, 0.0, 1.0});
  expect_axis(displaced(points, 1.0, 60.0 * degree, 0.0), {0.0, -std::sin(60.0 * degree), 0.5});
  expect_axis(displaced(points, 0.9, 90.0 * degree, 0.0), {0.0, -1.0, 0.0});
  expect_axis(displaced(points, 1.1, 150.0 * degree, 90.0 * degree), {0.5, 0.0, -std::sin(60.0 * degree)});
}

TEST(OutermostPoints, PointsInsideTheBodyDoNotCount) {
  std::vector<Place> points = hook();
  points.push_back({0.008, 0.005, 0.006});
  std::vector<double> displacements_m(3 * points.size(), 0.0);
  displacements_m.back() = 0.05;
  EXPECT_NEAR(OutermostPoints(points).upright_axis(displacements_m)[2], 1.0, 1e-12);
}

}  // namespace
}  // namespace menger::meshes
