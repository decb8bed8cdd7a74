#include "voxel/engine/foot_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;
constexpr double gravity = 9.81;

/// Stiff cells that no pressure drives, on stiff ground, without damping against the world and without collisions.
Physics standing() {
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = tests::plain_surrogate_example()};
  physics.surrogate->parameters.ground_stiffness_N_per_m = 20e3;
  physics.actuation.mode = ActuationMode::none;
  physics.damping_ratios.global = 0.0;
  physics.collisions.exclusion_depth.reset();
  physics.gravity_m_s2 = gravity;
  return physics;
}

HollowVoxels voxels_of(const meshes::Polycube& body) { return hollow_voxels(body, {edge, 0.002, 1, 1}); }

/// Depth at which the middle of a wall and its four corners bear a voxel.
double depth_of(double mass_kg, const Physics& physics) {
  return mass_kg * gravity / physics.surrogate->parameters.ground_stiffness_N_per_m;
}

/// Loads under which every voxel begins as deep in the ground as its weight presses it.
VoxelLoads sunk(const meshes::Polycube& body, const Physics& physics) {
  VoxelLoads loads;
  for (const double mass : voxel_masses(voxels_of(body), physics.surrogate->parameters.density_kg_m3))
    loads.initial_displacement_m.push_back({0.0, 0.0, -depth_of(mass, physics)});
  return loads;
}

TEST(FootContact, BearsTheWeightOfEveryVoxel) {
  const meshes::Polycube body = meshes::bar(1);
  const Physics physics = standing();
  Simulation simulation(body, edge, physics);
  ASSERT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
  const double depth = depth_of(voxel_masses(voxels_of(body), physics.surrogate->parameters.density_kg_m3).front(), physics);
  EXPECT_NEAR(simulation.position_m(0)[2], -depth, 1e-6 * depth);
  EXPECT_EQ(simulation.frame().contact.front(), contact::floor_static);
}

TEST(FootContact, StandsOnTheRimOfAWallThatIsDrawnIn) {
  const meshes::Polycube body = meshes::bar(1);
  Physics physics = standing();
  constexpr double pressure_Pa = -4000.0;
  physics.surrogate->pressure_Pa = {pressure_Pa, pressure_Pa};
  physics.actuation.mode = ActuationMode::hold;
  Simulation simulation(body, edge, physics, sunk(body, physics));
  ASSERT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
  const SurrogateParameters& p = physics.surrogate->parameters;
  // Four corners of five feet bear it.
  const double depth = depth_of(voxel_masses(voxels_of(body), p.density_kg_m3).front(), physics) * 5.0 / 4.0;
  const double shorter = 0.5 * edge * p.extension[walls::closed].value(pressure_Pa);
  EXPECT_LT(shorter, 0.0);
  EXPECT_NEAR(simulation.position_m(0)[2], shorter - depth, 1e-6 * depth);
}

TEST(FootContact, StandsOnTheEdgesOfItsWalls) {
  const meshes::Polycube body = meshes::bar(1);
  const Physics physics = standing();
  VoxelLoads loads = sunk(body, physics);
  // Half of the speed at which it would tip over an edge, g (sqrt(2) - 1) L / 2 = turn^2 (2/3 or more) L^2 / 2.
  loads.initial_angular_velocity_rad_s = {{0.0, 12.0, 0.0}};
  Simulation simulation(body, edge, physics, loads);
  ASSERT_EQ(simulation.advance_to(1.0), io::RunStatus::completed);
  EXPECT_NEAR(simulation.orientation(0)[0], 1.0, 1e-8);
  EXPECT_LT(simulation.frame().speed_m_s[0], 1e-5);
}

TEST(FootContact, SlidesUntilKineticFrictionHasUsedUpItsEnergy) {
  const meshes::Polycube body = meshes::bar(3);
  Physics physics = standing();
  physics.materials.fill({.static_friction = 0.8, .kinetic_friction = 0.4});
  for (const std::array<double, 2> direction : {std::array{1.0, 0.0}, std::array{0.6, 0.8}}) {
    constexpr double speed = 0.3;
    VoxelLoads loads = sunk(body, physics);
    loads.initial_velocity_m_s.assign(3, {speed * direction[0], speed * direction[1], 0.0});
    Simulation simulation(body, edge, physics, loads);
    const std::array<double, 3> start = simulation.centre_of_mass_m();
    ASSERT_EQ(simulation.advance_to(0.2), io::RunStatus::completed);
    const std::array<double, 3> end = simulation.centre_of_mass_m();
    const double way = speed * speed / (2.0 * 0.4 * gravity);
    // Friction acts at the feet, below the centre, so that the body rocks while it slides: what it weighs swings by some percent.
    EXPECT_NEAR(end[0] - start[0], way * direction[0], 0.02 * way);
    EXPECT_NEAR(end[1] - start[1], way * direction[1], 0.02 * way);
    const Frame frame = simulation.frame();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(frame.speed_m_s[i], 1e-4 * speed);
      EXPECT_EQ(frame.contact[i], contact::floor_static);
    }
  }
}

TEST(FootContact, SlidesAsFarInSinglePrecision) {
  // Past many edges, so that positions are counted from another origin at its end than at its start.
  const meshes::Polycube body = meshes::bar(3);
  Physics physics = standing();
  physics.materials.fill({.static_friction = 0.8, .kinetic_friction = 0.4});
  physics.integration.damping = DampingMode::velocity;
  const auto way = [&](NumberType number) {
    physics.integration.number = number;
    VoxelLoads loads = sunk(body, physics);
    loads.initial_velocity_m_s.assign(3, {1.0, 0.0, 0.0});
    Simulation simulation(body, edge, physics, loads);
    const double start = simulation.centre_of_mass_m()[0];
    EXPECT_EQ(simulation.advance_to(0.5), io::RunStatus::completed);
    return simulation.centre_of_mass_m()[0] - start;
  };
  const double exact = way(NumberType::float64);
  EXPECT_GT(exact, 10.0 * edge);
  // Rounding of 24 bits in some ten thousand steps, of which contacts amplify the last that decide when a foot lets go.
  EXPECT_NEAR(way(NumberType::float32), exact, 1e-3 * exact);
}

TEST(FootContact, HoldsBelowKineticFrictionAndSlidesBeyondStatic) {
  const meshes::Polycube body = meshes::bar(3);
  Physics physics = standing();
  physics.materials.fill({.static_friction = 0.5, .kinetic_friction = 0.4});
  const std::vector<double> masses = voxel_masses(voxels_of(body), physics.surrogate->parameters.density_kg_m3);
  const auto travel = [&](double share_of_weight) {
    VoxelLoads loads = sunk(body, physics);
    for (const double mass : masses) loads.force_N.push_back({share_of_weight * mass * gravity, 0.0, 0.0});
    Simulation simulation(body, edge, physics, loads);
    const double start = simulation.centre_of_mass_m()[0];
    EXPECT_EQ(simulation.advance_to(0.3), io::RunStatus::completed);
    return simulation.centre_of_mass_m()[0] - start;
  };
  // Feet behind bear less and let go first; as long as all together need less than kinetic friction, the others hold.
  // What they stick by gives way by mu_s m g / (5 k), less than 1e-3 mm.
  EXPECT_LT(travel(0.35), 1e-3 * edge);
  EXPECT_GT(travel(0.6), edge);
}

// A rod of length h on a fixed point falls as theta'' = m g h / (I + m h^2) theta: friction holds the foot and not the centre.
TEST(FootContact, TipsOverABulgingWallLikeAPendulum) {
  const meshes::Polycube body = meshes::bar(1);
  Physics physics = standing();
  constexpr double pressure_Pa = 5000.0;
  physics.surrogate->pressure_Pa = {pressure_Pa, pressure_Pa};
  physics.actuation.mode = ActuationMode::hold;
  const SurrogateParameters& p = physics.surrogate->parameters;
  const HollowVoxels voxels = voxels_of(body);
  const double arm =
      0.5 * edge * (1.0 + p.extension[walls::closed].value(pressure_Pa)) + edge * p.bulge[walls::closed].value(pressure_Pa);
  const double rate = std::sqrt(gravity * arm / (voxels.inertia_factor[0] * edge * edge / 6.0 + arm * arm));
  const double depth = voxel_masses(voxels, p.density_kg_m3)[0] * gravity / (p.ground_stiffness_N_per_m / feet_of_a_wall);
  constexpr double turn = 0.05;  // rad/s
  VoxelLoads loads;
  loads.initial_displacement_m = {{0.0, 0.0, arm - 0.5 * edge - depth}};
  loads.initial_angular_velocity_rad_s = {{0.0, turn, 0.0}};
  loads.initial_velocity_m_s = {{turn * arm, 0.0, 0.0}};
  Simulation simulation(body, edge, physics, loads);
  ASSERT_EQ(simulation.advance_to(0.06), io::RunStatus::completed);
  const double angle = turn / rate * std::sinh(rate * simulation.time_s());
  // The foot gives way by m g / k, 1e-3 of the arm, and the sine of the angle is 1e-5 off.
  EXPECT_NEAR(2.0 * simulation.orientation(0)[2], angle, 5e-3 * angle);
  EXPECT_NEAR(simulation.position_m(0)[0], arm * angle, 5e-3 * arm * angle);
}

TEST(FootContact, LetsATowerFallOnItsSide) {
  const meshes::Polycube tower = meshes::Polycube::from_digits(1, 1, 3, "111");
  Physics physics = standing();
  physics.damping_ratios.global = 0.01;
  constexpr double turn = 20.0;  // rad/s, of which 7 bear a rigid one over the edge of its foot; bending beams take the most
  VoxelLoads loads = sunk(tower, physics);
  for (const double height : {0.5, 1.5, 2.5}) loads.initial_velocity_m_s.push_back({turn * height * edge, 0.0, 0.0});
  loads.initial_angular_velocity_rad_s.assign(3, {0.0, turn, 0.0});
  Simulation simulation(tower, edge, physics, loads);
  EXPECT_NEAR(simulation.centre_of_mass_m()[2], edge, 1e-3 * edge);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  EXPECT_NEAR(simulation.centre_of_mass_m()[2], 0.0, 0.01 * edge) << "all walls are as far from their centres";
  EXPECT_NEAR(simulation.position_m(2)[0] - simulation.position_m(0)[0], 2.0 * edge, 0.01 * edge);
}

TEST(FootContact, KeepsTheEnergyBooks) {
  Physics physics = standing();
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{0.2, 0.1, -0.1}};
  loads.initial_angular_velocity_rad_s = {{5.0, 20.0, 3.0}};
  Simulation simulation(meshes::bar(1), edge, physics, loads, {.energy_ledger = true});
  ASSERT_EQ(simulation.advance_to(0.1), io::RunStatus::completed);
  // It has come to rest, on its feet, by hitting the ground and sliding.
  const EnergyLedger& energy = *simulation.energy();
  EXPECT_LT(energy.kinetic_J, 1e-9 * energy.kinetic_start_J);
  EXPECT_LT(energy.friction_work_J, -0.1 * energy.kinetic_start_J);
  EXPECT_LT(energy.floor_normal_work_J, -0.1 * energy.kinetic_start_J);
  EXPECT_NEAR(energy.collision_work_J, 0.0, 1e-12 * energy.kinetic_start_J);
  EXPECT_LE(std::abs(energy.residual_J()), 1e-9 * energy.largest_energy_J);
}

TEST(FootContact, RocksStablyUpToTwiceTheRecommendedStep) {
  // Ground so stiff that it, not the beams, decides the step.
  Physics physics = standing();
  physics.surrogate->parameters.ground_stiffness_N_per_m = 5e6;
  const auto speed_after = [&](const std::string& digits, double fraction) {
    const meshes::Polycube plate = meshes::Polycube::from_digits(3, 3, 1, digits);
    Physics stepped = physics;
    stepped.integration.time_step_fraction = fraction;
    VoxelLoads loads = sunk(plate, stepped);
    loads.initial_angular_velocity_rad_s.assign(plate.count(), {0.01, 0.0, 0.0});
    Simulation simulation(plate, edge, stepped, loads);
    const io::RunStatus status = simulation.advance(2000);
    double fastest = status == io::RunStatus::completed ? 0.0 : 1.0;
    for (const double speed : simulation.frame().speed_m_s) fastest = std::max(fastest, speed);
    return fastest;
  };
  for (const char* digits : {"100000000", "111111111"}) {
    EXPECT_LT(speed_after(digits, 0.9), 1e-9) << digits;
    EXPECT_LT(speed_after(digits, 1.9), 1e-9) << digits;
    // Of a cell without crowns and of a softer body the limit lies somewhat higher; beyond it feet hop without end.
    EXPECT_GT(speed_after(digits, 3.0), 1e-6) << digits;
  }
}

}  // namespace
}  // namespace menger::voxel
