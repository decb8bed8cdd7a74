// Explicit dynamics against closed forms.

#include "fem/explicit/explicit_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "fem/explicit/explicit_contact.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

constexpr double density = 1070.0;
constexpr double pi = std::numbers::pi;

/// Positions and velocities of a body given by functions of the reference position.
template <class Displacement, class Velocity>
ExplicitState state_of(const meshes::HexahedralMesh& mesh, const ExplicitDynamics& dynamics, const Displacement& displacement,
                       const Velocity& velocity) {
  ExplicitState state = dynamics.state();
  state.at_start_J.reset();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point u = displacement(mesh.points[n]);
    const Point v = velocity(mesh.points[n]);
    for (std::size_t i = 0; i < 3; ++i) {
      state.displacements_m[3 * n + i] = u[i];
      state.velocities_m_per_s[3 * n + i] = v[i];
    }
  }
  return state;
}

Point nothing(const Point&) { return {}; }

/// All nodes of a mesh held across, so that a bar along x sees the modulus kappa + 4/3 mu.
ExplicitBodyOptions held_across(const meshes::HexahedralMesh& mesh) {
  ExplicitBodyOptions options = silicone_options(mesh);
  for (const char* label : {"y min", "y max"})
    options.supports.push_back({meshes::label_index(mesh, label), {false, true, false}});
  for (const char* label : {"z min", "z max"})
    options.supports.push_back({meshes::label_index(mesh, label), {false, false, true}});
  return options;
}

double wave_speed() { return std::sqrt((2.5e6 + 4.0 / 3.0 * 50e3) / density); }

// A free bar in its first mode along the axis, held across: u = a cos(pi x / L) cos(2 pi f t), f = c / (2 L). Its 50 elements
// change f by (pi / 50)^2 / 24 = 1.6e-4, steps of 0.9 of the bound by about as much the other way.
TEST(ExplicitDynamics, FreeBarVibratesAtItsFrequency) {
  constexpr double length = 0.1;
  const meshes::HexahedralMesh mesh = meshes::box({length, 2e-3, 2e-3}, {50, 1, 1});
  const ExplicitBody body(mesh, held_across(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  const auto mode = [&](const Point& X) { return Point{1e-6 * std::cos(pi * X[0] / length), 0.0, 0.0}; };
  dynamics.set_state(state_of(mesh, dynamics, mode, nothing));
  const double period = 2.0 * length / wave_speed();
  const std::size_t end = node_at(mesh, {0.0, 0.0, 0.0});
  double last = 1e-6;
  double last_time = 0.0;
  double crossing = 0.0;
  for (int n = 1; n <= 1000 && crossing == 0.0; ++n) {  // the zero after 5 1/4 periods
    const double time = period * (5.0 + 0.001 * n);
    ASSERT_EQ(dynamics.advance_to(time).status, io::RunStatus::completed);
    const double u = dynamics.state().displacements_m[3 * end];
    if (last > 0.0 && u <= 0.0) crossing = last_time + (time - last_time) * last / (last - u);
    last = u;
    last_time = time;
  }
  EXPECT_NEAR(crossing / (5.25 * period), 1.0, 5e-4);
}

// A smooth pulse that runs along a bar without changing its shape, by the place of its peak (the parabola through the highest
// node and its neighbours). Elements of 1 mm slow down a wave number k by (k h)^2 / 24, which is 1e-4 at k = 1 / width: 2e-5 of
// the 0.2 m; steps near the bound take back some of it.
TEST(ExplicitDynamics, WaveTravelsAtTheSpeedOfSound) {
  constexpr double length = 0.4;
  constexpr double width = 0.02;  // of the smooth pulse
  const meshes::HexahedralMesh mesh = meshes::box({length, 2e-3, 2e-3}, {400, 1, 1});
  const ExplicitBody body(mesh, held_across(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  const double c = wave_speed();
  // u = g(x - c t) travels to the right: v = -c g'.
  const auto pulse = [&](const Point& X) {
    const double s = (X[0] - 0.08) / width;
    return Point{1e-7 * std::exp(-s * s), 0.0, 0.0};
  };
  const auto speed = [&](const Point& X) {
    const double s = (X[0] - 0.08) / width;
    return Point{c * 1e-7 * 2.0 * s / width * std::exp(-s * s), 0.0, 0.0};
  };
  dynamics.set_state(state_of(mesh, dynamics, pulse, speed));
  ASSERT_EQ(dynamics.advance_to(0.2 / c).status, io::RunStatus::completed);
  const auto along = [&](std::size_t step) {
    return dynamics.state().displacements_m[3 * node_at(mesh, {1e-3 * static_cast<double>(step), 0.0, 0.0})];
  };
  std::size_t highest = 1;
  for (std::size_t n = 1; n < 400; ++n)
    if (along(n) > along(highest)) highest = n;
  const double left = along(highest - 1);
  const double right = along(highest + 1);
  const double peak = static_cast<double>(highest) + 0.5 * (left - right) / (left - 2.0 * along(highest) + right);
  EXPECT_NEAR(1e-3 * peak, 0.28, 1e-4);
  EXPECT_NEAR(along(highest), 1e-7, 2e-9);
}

// Momentum, angular momentum and energy of a tumbling, wobbling body without any load.
TEST(ExplicitDynamics, FreeFlightKeepsMomentumAndEnergy) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  const auto spinning = [](const Point& X) {
    const Point arm = difference(X, {0.01, 0.01, 0.01});
    return sum(Point{0.5, -0.2, 0.1}, sum(cross({20.0, -10.0, 30.0}, arm), Point{15.0 * arm[0], -20.0 * arm[1], 0.0}));
  };
  dynamics.set_state(state_of(mesh, dynamics, nothing, spinning));
  const Motion before = motion_of(dynamics);
  const double energy = dynamics.energies().kinetic_J;
  ASSERT_EQ(dynamics.advance_to(0.05).status, io::RunStatus::completed);
  const Motion after = motion_of(dynamics);
  EXPECT_LT(norm(difference(after.momentum, before.momentum)), 1e-11 * before.size);  // rounding over some 2,000 steps
  // The velocity at the time of the state is that of the half step plus half a kick: angular momentum has the error of one step.
  EXPECT_LT(norm(difference(after.angular, before.angular)), 1e-5 * norm(before.angular));
  EXPECT_LT(std::abs(dynamics.energies().imbalance_J()), 1e-4 * energy);
}

/// A block of 8 x 8 x 4 mm on the ground, in 2 mm elements.
struct Block {
  meshes::HexahedralMesh mesh = meshes::box({8e-3, 8e-3, 4e-3}, {4, 4, 2});
  ExplicitBody body;
  explicit Block(double viscosity_Pa_s) : body(mesh, silicone_options(mesh, viscosity_Pa_s)) {}
};

ExplicitOptions on_ground(const Friction& friction) {
  ExplicitOptions options;
  options.loads.gravity_m_per_s2 = {0.0, 0.0, -9.81};
  options.loads.ground =
      RigidGround{.height_m = 0.0, .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 2e-3), .friction = friction};
  return options;
}

// A block that slides stops after v^2 / (2 mu g). It shears and rocks a little while it does, so that its centre of mass follows
// within a per cent.
TEST(ExplicitDynamics, SlidingBlockStopsWhereItShould) {
  const Block block(2.0);
  constexpr double mu = 0.4;
  constexpr double speed = 0.3;
  ExplicitOptions options = on_ground({.static_coefficient = 0.5, .kinetic_coefficient = mu});
  ExplicitDynamics dynamics(block.mesh, block.body, options);
  ASSERT_EQ(dynamics.advance_to(0.05).status, io::RunStatus::completed);  // settles
  ExplicitState state = dynamics.state();
  state.at_start_J.reset();
  for (std::size_t n = 0; n < block.mesh.points.size(); ++n) state.velocities_m_per_s[3 * n] += speed;
  dynamics.set_state(state);
  const double start = dynamics.centre_of_mass_m()[0];
  ASSERT_EQ(dynamics.advance_to(0.05 + 1.5 * speed / (mu * 9.81)).status, io::RunStatus::completed);
  const double distance = speed * speed / (2.0 * mu * 9.81);
  EXPECT_NEAR(dynamics.centre_of_mass_m()[0] - start, distance, 0.01 * distance);
  const MotionEnergies energies = dynamics.energies();
  EXPECT_NEAR(energies.work.friction_J, 0.5 * block.body.mass_kg() * speed * speed, 0.02 * energies.work.friction_J);
  EXPECT_LT(std::abs(energies.imbalance_J()), 1e-3 * energies.work.friction_J);
  const double end = dynamics.centre_of_mass_m()[0];
  ASSERT_EQ(dynamics.advance_to(0.3).status, io::RunStatus::completed);
  EXPECT_NEAR(dynamics.centre_of_mass_m()[0], end, 1e-6);  // and stays
}

// On a slope (gravity turned) a block slips while it settles, comes to rest where both coefficients are larger than the slope,
// and runs off with g (sin a - mu cos a) where they are not.
TEST(ExplicitDynamics, BlockOnASlopeRestsOrSlides) {
  const Block block(2.0);
  const auto way = [&](double slope) {
    ExplicitOptions options = on_ground({.static_coefficient = 0.5, .kinetic_coefficient = 0.45});
    options.loads.gravity_m_per_s2 = {9.81 * std::sin(slope), 0.0, -9.81 * std::cos(slope)};
    ExplicitDynamics dynamics(block.mesh, block.body, options);
    EXPECT_EQ(dynamics.advance_to(0.1).status, io::RunStatus::completed);
    const double start = dynamics.centre_of_mass_m()[0];
    const std::vector<double> v = dynamics.velocities_m_per_s();
    double speed = 0.0;
    for (std::size_t n = 0; n < block.mesh.points.size(); ++n)
      speed += block.body.masses_kg()[n] * v[3 * n] / block.body.mass_kg();
    EXPECT_EQ(dynamics.advance_to(0.3).status, io::RunStatus::completed);
    return std::pair{dynamics.centre_of_mass_m()[0] - start, speed};
  };
  EXPECT_NEAR(way(std::atan(0.2)).first, 0.0, 1e-6);
  const double steep = std::atan(0.7);
  const auto [distance, speed] = way(steep);
  const double acceleration = 9.81 * (std::sin(steep) - 0.45 * std::cos(steep));
  EXPECT_NEAR(distance, speed * 0.2 + 0.5 * acceleration * 0.04, 0.01 * distance);
}

// Between both coefficients a block that lies keeps lying, and one that was pushed runs on. It settles on level ground before
// gravity turns in small steps: a sudden turn would swing it beyond the static coefficient.
TEST(ExplicitDynamics, BlockBetweenBothCoefficientsRestsUntilItIsPushed) {
  const Block block(2.0);
  ExplicitOptions options = on_ground({.static_coefficient = 0.8, .kinetic_coefficient = 0.2});
  options.loads.mass_damping_per_s = 100.0;
  const auto turn = [&](double slope) {
    options.loads.gravity_m_per_s2 = {9.81 * std::sin(slope), 0.0, -9.81 * std::cos(slope)};
  };
  const double slope = std::atan(0.4);
  ExplicitState lying = ExplicitDynamics(block.mesh, block.body, options).state();
  for (int n = 0; n <= 10; ++n) {
    turn(0.1 * n * slope);
    ExplicitDynamics turned(block.mesh, block.body, options);
    turned.set_state(lying);
    ASSERT_EQ(turned.advance_to(lying.time_s + (n == 0 ? 0.2 : 0.02)).status, io::RunStatus::completed);
    lying = turned.state();
    lying.at_start_J.reset();
  }
  options.loads.mass_damping_per_s = 0.0;
  const auto way = [&](double push) {
    ExplicitDynamics tilted(block.mesh, block.body, options);
    ExplicitState state = lying;
    for (std::size_t n = 0; n < block.mesh.points.size(); ++n) state.velocities_m_per_s[3 * n] += push;
    tilted.set_state(state);
    const double start = tilted.centre_of_mass_m()[0];
    EXPECT_EQ(tilted.advance_to(lying.time_s + 0.1).status, io::RunStatus::completed);
    return tilted.centre_of_mass_m()[0] - start;
  };
  EXPECT_LT(std::abs(way(0.0)), 1e-6);
  const double acceleration = 9.81 * (std::sin(slope) - 0.2 * std::cos(slope));
  const double distance = 0.1 * 0.1 + 0.5 * acceleration * 0.01;
  EXPECT_NEAR(way(0.1), distance, 0.02 * distance);
}

// A ground a hundred times as stiff as the default needs a shorter step than the body: the bound must know, so that no interval
// has to be taken again.
TEST(ExplicitDynamics, HardGroundShortensTheStep) {
  const Block block(0.0);
  ExplicitOptions options = on_ground({});
  ExplicitDynamics soft(block.mesh, block.body, options);
  options.loads.ground->stiffness_Pa_per_m *= 100.0;
  ExplicitDynamics hard(block.mesh, block.body, options);
  ASSERT_EQ(soft.advance_to(0.02).status, io::RunStatus::completed);
  ASSERT_EQ(hard.advance_to(0.02).status, io::RunStatus::completed);
  EXPECT_LT(hard.state().last_step_s, 0.7 * soft.state().last_step_s);
  EXPECT_EQ(hard.state().step_share, 1.0);
  EXPECT_LT(std::abs(hard.energies().imbalance_J()), 0.05 * hard.state().turnover_J);
}

// Dropped from 5 mm: free fall by the parabola, and after the bounce no more energy than before. The impact excites modes that
// the longest stable step barely resolves, and whose energy at one time is only known to the square of step times frequency: a
// quarter of that step brings the imbalance to a thousandth.
TEST(ExplicitDynamics, BouncingBlockKeepsItsEnergy) {
  const Block block(0.0);
  ExplicitOptions options = on_ground({});
  options.step_safety = 0.25;
  ExplicitDynamics dynamics(block.mesh, block.body, options);
  constexpr double height = 5e-3;
  dynamics.set_state(state_of(
      block.mesh, dynamics,
      [](const Point&) {
        return Point{0.0, 0.0, height};
      },
      nothing));
  const double weight = block.body.mass_kg() * 9.81;
  ASSERT_EQ(dynamics.advance_to(0.03).status, io::RunStatus::completed);
  EXPECT_NEAR(dynamics.centre_of_mass_m()[2], 2e-3 + height - 0.5 * 9.81 * 0.03 * 0.03, 1e-9);
  double contact = 0.0;
  double worst = 0.0;
  double open_springs = 0.0;
  const std::vector<double> areas = outer_node_areas_m2(block.mesh);
  struct InTheAir {
    std::vector<double> velocities;
    double force_N;
  };
  std::optional<InTheAir> up;
  for (int n = 0; n < 1000; ++n) {
    if (!up && dynamics.state().time_s > 0.047) up = InTheAir{dynamics.velocities_m_per_s(), dynamics.ground_force_N()};
    ASSERT_EQ(dynamics.advance_to(0.03 + 0.05e-3 * (n + 1)).status, io::RunStatus::completed);
    contact = std::max(contact, dynamics.ground_force_N());
    const MotionEnergies energies = dynamics.energies();
    worst = std::max(worst, std::abs(energies.imbalance_J()) / (weight * height));
    const double stored = ground_energy_J(*options.loads.ground, dynamics.positions_m(), areas);
    open_springs = std::max(open_springs, std::abs(energies.work.contact_J + stored) / (weight * height));
  }
  EXPECT_GT(contact, 5.0 * weight);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(open_springs, 1e-3);
  // 15 ms after it touched it is in the air again, and on its way up: what it swings with it does not rise with.
  const std::vector<double> v = up->velocities;
  EXPECT_EQ(up->force_N, 0.0);
  double speed = 0.0;
  for (std::size_t n = 0; n < block.mesh.points.size(); ++n)
    speed += block.body.masses_kg()[n] * v[3 * n + 2] / block.body.mass_kg();
  const double arrival = std::sqrt(2.0 * 9.81 * height);
  EXPECT_GT(speed + 9.81 * 0.015, 0.5 * arrival);
  EXPECT_LT(speed + 9.81 * 0.015, 1.1 * arrival);
}

// At rest the ground carries the weight, and nodes are as deep as weight over stiffness.
TEST(ExplicitDynamics, BlockAtRestIsCarried) {
  const Block block(2.0);
  ExplicitOptions options = on_ground({.static_coefficient = 0.5, .kinetic_coefficient = 0.5});
  options.loads.mass_damping_per_s = 100.0;
  ExplicitDynamics dynamics(block.mesh, block.body, options);
  ASSERT_EQ(dynamics.advance_to(0.3).status, io::RunStatus::completed);
  EXPECT_NEAR(dynamics.ground_force_N(), block.body.mass_kg() * 9.81, 1e-4 * block.body.mass_kg() * 9.81);
  EXPECT_LT(dynamics.energies().kinetic_J, 1e-12);
  // Springs count the sides of edge nodes, too. The block is as soft as its ground, and nodes differ by half of the mean depth.
  const std::vector<double> areas = outer_node_areas_m2(block.mesh);
  double area = 0.0;
  for (std::size_t n = 0; n < areas.size(); ++n)
    if (block.mesh.points[n][2] == 0.0) area += areas[n];
  EXPECT_NEAR(area, 64e-6 + 32e-3 * 1e-3, 1e-12);
  const double weight = block.body.mass_kg() * 9.81;
  const double depth = weight / (options.loads.ground->stiffness_Pa_per_m * area);
  for (std::size_t n = 0; n < areas.size(); ++n) {
    if (block.mesh.points[n][2] > 0.0) continue;
    EXPECT_NEAR(-dynamics.state().displacements_m[3 * n + 2], depth, 0.5 * depth);
  }
  // equal depths store the least
  const double stored = ground_energy_J(*options.loads.ground, dynamics.positions_m(), areas);
  EXPECT_GT(stored, 0.5 * weight * depth);
  EXPECT_LT(stored, 0.6 * weight * depth);
}

}  // namespace
}  // namespace menger::fem
