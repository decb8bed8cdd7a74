#include "fem/walk/body_posture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fem/walk/walk_input.h"
#include "fem/walk/walk_result.h"

namespace menger::fem {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The mesh of a hook of three cells.
PreparedWalk prepared_hook() {
  PreparedWalk walk;
  walk.design = {"hook", meshes::Polycube::from_digits(2, 1, 2, "1110"), 0.01};
  walk.hollow.wall_thickness_m = 2e-3;
  walk.elements.fidelity = Fidelity::draft;
  walk.silicone.law.law = materials::NeoHookean{5e4};
  walk.silicone.density_kg_per_m3 = 1070.0;
  walk.drive = SurrogateDrive{.pressure_Pa = {0.0, 4e3}, .frequency_Hz = 20.0};
  prepare(walk);
  return walk;
}

/// Displacements of points that are stretched along z, turned about x and then about z, and moved.
std::vector<double> displaced(const meshes::HexahedralMesh& mesh, double stretch, double about_x, double about_z) {
  std::vector<double> displacements;
  for (const auto& point : mesh.points) {
    const Point stretched{point[0], point[1], stretch * point[2]};
    const Point tilted{stretched[0], std::cos(about_x) * stretched[1] - std::sin(about_x) * stretched[2],
                       std::sin(about_x) * stretched[1] + std::cos(about_x) * stretched[2]};
    const Point turned{std::cos(about_z) * tilted[0] - std::sin(about_z) * tilted[1],
                       std::sin(about_z) * tilted[0] + std::cos(about_z) * tilted[1], tilted[2]};
    for (std::size_t i = 0; i < 3; ++i) displacements.push_back(turned.at(i) + 0.1 - point.at(i));
  }
  return displacements;
}

TEST(BodyPosture, TheUprightAxisTurnsWithTheBody) {
  const PreparedWalk walk = prepared_hook();
  const BodyPosture posture(walk.mesh);
  const auto expect_axis = [&](const std::vector<double>& displacements, const Point& expected) {
    const Point axis = posture.upright_axis(displacements);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(axis.at(i), expected.at(i), 1e-6) << i;
  };
  expect_axis(displaced(walk.mesh, 1.0, 0.0, 0.0), {0.0, 0.0, 1.0});
  expect_axis(displaced(walk.mesh, 1.3, 0.0, 0.0), {0.0, 0.0, 1.0});
  expect_axis(displaced(walk.mesh, 1.0, 0.0, 70.0 * degree), {0.0, 0.0, 1.0});
  expect_axis(displaced(walk.mesh, 1.0, 60.0 * degree, 0.0), {0.0, -std::sin(60.0 * degree), 0.5});
  expect_axis(displaced(walk.mesh, 0.9, 90.0 * degree, 0.0), {0.0, -1.0, 0.0});
  expect_axis(displaced(walk.mesh, 1.1, 150.0 * degree, 90.0 * degree), {0.5, 0.0, -std::sin(60.0 * degree)});
}

/// A walk of four periods of 1 s with records every half a second, which leans at the end of each by these angles about y.
WalkResult leaning(const std::vector<double>& angles_deg) {
  WalkResult result;
  result.records.push_back({.time_s = 0.0});
  for (std::size_t n = 0; n < angles_deg.size(); ++n) {
    WalkRecord middle{.time_s = static_cast<double>(n) + 0.5};
    middle.upright = {1.0, 0.0, 0.0};  // deformed by the drive
    WalkRecord end{.time_s = static_cast<double>(n) + 1.0};
    end.upright = {std::sin(angles_deg[n] * degree), 0.0, std::cos(angles_deg[n] * degree)};
    result.records.push_back(middle);
    result.records.push_back(end);
  }
  return result;
}

TEST(LargestLean, IsThatFromTheEndOfTheFirstPeriod) {
  const meshes::Lean lean = largest_lean(leaning({20.0, 25.0, -40.0, 0.0}), 1.0);
  EXPECT_NEAR(lean.angle_deg, 60.0, 1e-9);
  EXPECT_EQ(lean.period, 3U);
  EXPECT_NEAR(largest_lean(leaning({80.0, 80.0, 80.0}), 1.0).angle_deg, 0.0, 1e-6) << "it fell before the first period ended";
  EXPECT_NEAR(largest_lean(leaning({0.0, 180.0}), 1.0).angle_deg, 180.0, 1e-6);
  EXPECT_EQ(largest_lean(leaning({70.0}), 1.0).angle_deg, 0.0) << "one period alone tells nothing";
  EXPECT_EQ(largest_lean(WalkResult{}, 1.0).angle_deg, 0.0);
}

TEST(LargestLean, IsInfiniteWhereAnAxisIsNotANumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const meshes::Lean lean = largest_lean(leaning({20.0, 25.0, none, 30.0}), 1.0);
  EXPECT_EQ(lean.angle_deg, std::numeric_limits<double>::infinity());
  EXPECT_EQ(lean.period, 3U);
  EXPECT_EQ(largest_lean(leaning({none, 25.0}), 1.0).angle_deg, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace menger::fem
