#include "voxel/lanes/body_posture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/design/reference_shapes.h"
#include "meshes/load_cases/lean.h"

namespace menger::voxel {
namespace {

constexpr double cell_edge_m = 0.01;

/// A column of five cells with an arm at its top, whose weight lies beyond its foot.
meshes::Polycube gallows() {
  return meshes::Polycube::from_digits(4, 1, 5,
                                       "1000"
                                       "1000"
                                       "1000"
                                       "1000"
                                       "1111");
}

Physics undriven() {
  Physics physics;
  physics.actuation.mode = ActuationMode::none;
  return physics;
}

TEST(BodyPosture, ABodyThatStandsIsUpright) {
  for (const meshes::Polycube& body :
       {meshes::bar(1), meshes::bar(5), gallows(), meshes::Polycube::from_digits(1, 1, 3, "111")}) {
    Simulation simulation(body, cell_edge_m, undriven());
    const BodyPosture posture(simulation, cell_edge_m);
    EXPECT_NEAR(meshes::angle_between_deg(posture.upright_axis(simulation), {0.0, 0.0, 1.0}), 0.0, 1e-6);
  }
}

TEST(BodyPosture, ABodyThatFallsOnItsArmLeansAsTheLineThroughItsLowestCornersDoes) {
  // It comes to rest on the foot of the column and on the end of the arm: three cells apart, one of them four cells up.
  Simulation simulation(gallows(), cell_edge_m, undriven());
  const BodyPosture posture(simulation, cell_edge_m);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  const std::array<double, 3> axis = posture.upright_axis(simulation);
  const double lean_deg = meshes::angle_between_deg(axis, {0.0, 0.0, 1.0});
  // Soft voxels sink into the ground and bend by some degrees.
  EXPECT_NEAR(lean_deg, 180.0 / std::numbers::pi * std::atan2(4.0, 3.0), 8.0);
  EXPECT_GT(axis[0], 0.5) << "towards its arm";
  EXPECT_NEAR(std::hypot(axis[0], axis[1], axis[2]), 1.0, 1e-12);
}

TEST(BodyPosture, AFlatBodyIsToldByTheTurnOfItsVoxels) {
  // A bar across an edge has no height but that of its voxels: it tips about its column as the gallows do.
  Simulation simulation(meshes::Polycube::from_digits(4, 1, 2,
                                                      "1000"
                                                      "1111"),
                        cell_edge_m, undriven());
  const BodyPosture posture(simulation, cell_edge_m);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  const double lean_deg = meshes::angle_between_deg(posture.upright_axis(simulation), {0.0, 0.0, 1.0});
  EXPECT_NEAR(lean_deg, 180.0 / std::numbers::pi * std::atan2(1.0, 3.0), 8.0);
}

}  // namespace
}  // namespace menger::voxel
