// The engine at rest against equilibria found by Newton's method: two ways to the same state.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/surrogate_example.h"
#include "voxel/lanes/simulation.h"
#include "voxel/statics/equilibrium.h"

namespace menger::voxel {
namespace {

struct Case {
  double pressure_Pa = 0.0;
  double gravity_m_s2 = 0.0;
  bool ground = false;
  Vector3<double> tip_force_N{0.0, 0.0, 0.0};
};

constexpr double settling_s = 4.0;

/// Largest distance of a voxel in the engine, settled, from its place in equilibrium, by the voxel edge.
double largest_distance(const SurrogateParameters& parameters, const meshes::Polycube& cells, const Case& c) {
  CalibratedBody calibrated{.parameters = parameters, .pressure_Pa = {c.pressure_Pa, c.pressure_Pa}};
  const HollowVoxels voxels = calibrated_voxels(cells, calibrated);
  const std::size_t last = voxels.body.count() - 1;

  Physics physics;
  physics.surrogate = calibrated;
  physics.actuation.mode = ActuationMode::hold;
  physics.actuation.ramp_s = 0.5;
  physics.gravity_m_s2 = c.gravity_m_s2;
  physics.floor = c.ground;
  for (VoxelMaterial& material : physics.materials) material.static_friction = material.kinetic_friction = 0.0;
  physics.collisions.exclusion_depth.reset();
  physics.damping_ratios.global = 0.02;
  VoxelLoads loads;
  loads.fixed.assign(last + 1, false);
  loads.fixed[0] = true;
  loads.force_N.assign(last + 1, {0.0, 0.0, 0.0});
  loads.force_N[last] = {c.tip_force_N.x, c.tip_force_N.y, c.tip_force_N.z};
  Simulation simulation(cells, parameters.cell_edge_m, physics, loads);
  EXPECT_EQ(simulation.advance_to(settling_s), io::RunStatus::completed);

  const StaticBody body(parameters, voxels, {});
  Equilibrium equilibrium(body, {.fixed_voxels = {0}, .ground = c.ground});
  StaticLoads static_loads;
  static_loads.pressures_Pa.assign(voxels.chamber_count, c.pressure_Pa);
  static_loads.gravity_m_s2 = c.gravity_m_s2;
  static_loads.points.push_back({.voxel = last, .force = c.tip_force_N});
  EXPECT_EQ(equilibrium.load(static_loads), io::RunStatus::completed);
  double on_free_voxels_N = 0.0;
  for (std::size_t i = 1; i <= last; ++i) on_free_voxels_N += equilibrium.balance().ground_force(equilibrium.state(), i);
  EXPECT_EQ(on_free_voxels_N > 0.0, c.ground);

  // Both keep the first voxel where it is; their origins differ.
  const Vector3<double> at = body.rest[0].position;
  const std::array<double, 3> from = simulation.position_m(0);
  double largest = 0.0;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector3<double> p = equilibrium.pose(i).position;
    const std::array<double, 3> q = simulation.position_m(i);
    const double distance =
        std::hypot(p.x - at.x - (q[0] - from[0]), p.y - at.y - (q[1] - from[1]), p.z - at.z - (q[2] - from[2]));
    largest = std::max(largest, distance / parameters.voxel_edge_m());
  }
  return largest;
}

const meshes::Polycube corner = meshes::Polycube::from_digits(3, 2, 2, "111100100000");

TEST(Settling, EndsInTheEquilibriumUnderPressure) {
  const SurrogateParameters parameters = tests::surrogate_example();
  // What is left of the motion after the ramp; the tolerance of the equilibrium is far below.
  for (const double pressure : {-1500.0, 500.0, 1500.0})
    EXPECT_LT(largest_distance(parameters, corner, {.pressure_Pa = pressure}), 1e-7) << pressure;
}

TEST(Settling, EndsInTheEquilibriumOfVoxelsFinerThanCells) {
  SurrogateParameters parameters = tests::surrogate_example();
  parameters.voxels_per_cell = 2;
  EXPECT_LT(largest_distance(parameters, corner, {.pressure_Pa = 1000.0}), 1e-7);
}

TEST(Settling, EndsInTheEquilibriumOfBeamsThatShear) {
  SurrogateParameters parameters = tests::surrogate_example();
  for (std::size_t c = 0; c < wall_class_count; ++c)
    parameters.shear_compliance_per_Pa[c] = (5.0 - 0.7 * static_cast<double>(c)) * 1e-5;
  EXPECT_LT(
      largest_distance(parameters, corner, {.pressure_Pa = 800.0, .gravity_m_s2 = 9.81, .tip_force_N = {0.002, 0.003, 0.001}}),
      1e-7);
}

TEST(Settling, EndsInTheEquilibriumUnderWeightAndForce) {
  const SurrogateParameters parameters = tests::surrogate_example();
  EXPECT_LT(
      largest_distance(parameters, corner, {.pressure_Pa = 800.0, .gravity_m_s2 = 9.81, .tip_force_N = {0.002, 0.003, 0.001}}),
      1e-7);
}

TEST(Settling, EndsInTheEquilibriumOfANeckOnAPlate) {
  const meshes::Polycube post = meshes::Polycube::from_digits(3, 3, 2, "111111111000100000");
  const SurrogateParameters parameters = tests::surrogate_example();
  for (const double pressure : {-800.0, 1200.0}) EXPECT_LT(largest_distance(parameters, post, {.pressure_Pa = pressure}), 1e-7);
}

TEST(Settling, EndsInTheEquilibriumOfElbowsThatOpen) {
  SurrogateParameters parameters = tests::surrogate_example();
  parameters.elbow_ratio = 3.0;
  for (const double pressure : {-1500.0, 1500.0})
    EXPECT_LT(largest_distance(parameters, corner, {.pressure_Pa = pressure}), 1e-7) << pressure;
}

TEST(Settling, EndsInTheEquilibriumOnTheGround) {
  // On what bulges, on all feet of walls that are flat, on the rim of those drawn in.
  const SurrogateParameters parameters = tests::surrogate_example();
  for (const double pressure : {800.0, 0.0, -800.0}) {
    // Weight enough to reach it, as the first voxel is held and walls drawn in are short.
    const Case pushed{.pressure_Pa = pressure, .gravity_m_s2 = 200.0, .ground = true, .tip_force_N = {0.0, 0.0, -0.02}};
    EXPECT_LT(largest_distance(parameters, corner, pushed), 1e-7) << pressure;
  }
}

TEST(Settling, EndsInTheEquilibriumOnTheCrownOfAPlate) {
  const meshes::Polycube plate = meshes::Polycube::from_digits(3, 2, 2, "111110100000");
  const SurrogateParameters parameters = tests::surrogate_example();
  EXPECT_LT(largest_distance(parameters, plate, {.pressure_Pa = 800.0, .ground = true, .tip_force_N = {0.0, 0.0, -0.02}}), 1e-7);
}

}  // namespace
}  // namespace menger::voxel
