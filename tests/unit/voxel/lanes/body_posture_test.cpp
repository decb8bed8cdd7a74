#include "voxel/lanes/body_posture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "meshes/design/reference_shapes.h"
#include "meshes/load_cases/lean.h"

namespace menger::voxel {
namespace {

constexpr double cell_edge_m = 0.01;

/// A column of five cells with an arm at its top, whose weight lies beyond its foot.
meshes::Polycube gallows() { return meshes::Polycube::from_digits(4, 1, 5, "10001000100010001111"); }

Physics undriven() {
  Physics physics;
  physics.actuation.mode = ActuationMode::none;
  return physics;
}

std::vector<VoxelPose> poses_at_rest(const meshes::Polycube& body) { return poses_of(Simulation(body, cell_edge_m, undriven())); }

/// Turns a vector by a unit quaternion (w, x, y, z): q v q^-1, multiplied out with the vector part.
std::array<double, 3> turned(const std::array<double, 4>& q, const std::array<double, 3>& v) {
  const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const std::array<double, 3> u{q[1], q[2], q[3]};
  const std::array<double, 3> once = cross(u, v);
  const std::array<double, 3> twice = cross(u, once);
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result.at(i) = v.at(i) + 2.0 * (q[0] * once.at(i) + twice.at(i));
  return result;
}

TEST(BodyPosture, ABodyAtRestIsUpright) {
  for (const meshes::Polycube& body :
       {meshes::bar(1), meshes::bar(5), gallows(), meshes::Polycube::from_digits(1, 1, 3, "111")}) {
    const std::vector<VoxelPose> rest = poses_at_rest(body);
    EXPECT_NEAR(meshes::angle_between_deg(BodyPosture(rest, cell_edge_m).upright_axis(rest), {0.0, 0.0, 1.0}), 0.0, 1e-6);
  }
}

// Of the flat bodies, and of the single voxel, both ends along an axis are the same voxels: their turn alone tells.
TEST(BodyPosture, ARigidBodyTurnsItsAxisWithIt) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const meshes::Polycube& body :
       {meshes::bar(1), meshes::bar(5), meshes::Polycube::from_digits(3, 3, 1, "111110100"), gallows()}) {
    const std::vector<VoxelPose> rest = poses_at_rest(body);
    const BodyPosture posture(rest, cell_edge_m);
    for (int n = 0; n < 5; ++n) {
      std::array<double, 4> q{normal(random), normal(random), normal(random), normal(random)};
      const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
      for (double& part : q) part /= length;
      std::vector<VoxelPose> now;
      for (const VoxelPose& pose : rest) {
        std::array<double, 3> place_m = turned(q, pose.position_m);
        place_m[0] += 0.3;
        now.push_back({place_m, q});
      }
      EXPECT_NEAR(meshes::angle_between_deg(posture.upright_axis(now), turned(q, {0.0, 0.0, 1.0})), 0.0, 1e-6);
    }
  }
}

TEST(BodyPosture, ABodyThatFallsOnItsArmLeansAsTheLineThroughItsLowestCornersDoes) {
  // It comes to rest on the foot of the column and on the end of the arm: three cells apart, one of them four cells up.
  Simulation simulation(gallows(), cell_edge_m, undriven());
  const BodyPosture posture(poses_of(simulation), cell_edge_m);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  const std::array<double, 3> axis = posture.upright_axis(poses_of(simulation));
  const double lean_deg = meshes::angle_between_deg(axis, {0.0, 0.0, 1.0});
  // Soft voxels sink into the ground and bend by some degrees.
  EXPECT_NEAR(lean_deg, 180.0 / std::numbers::pi * std::atan2(4.0, 3.0), 8.0);
  EXPECT_GT(axis[0], 0.5) << "towards its arm";
  EXPECT_NEAR(std::hypot(axis[0], axis[1], axis[2]), 1.0, 1e-12);
}

}  // namespace
}  // namespace menger::voxel
