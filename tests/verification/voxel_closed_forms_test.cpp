// Simple scenes of the voxel engine against closed forms. Tolerances: rounding and the O(h) or O(h^2) error of the scheme, stated
// where they apply.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;                         // m
constexpr double modulus = 1e4;                       // Pa
constexpr double mass = 10.0 * edge * edge * edge;    // kg
constexpr double inertia = mass * edge * edge / 6.0;  // kg m^2
constexpr double gravity = 9.80665;                   // m/s^2

Physics still_physics() {
  Physics physics;
  physics.gravity_m_s2 = gravity;
  physics.actuation.mode = ActuationMode::none;
  physics.collisions.exclusion_depth.reset();
  return physics;
}

Physics floating_physics() {
  Physics physics = still_physics();
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  return physics;
}

/// A column of `height` voxels.
meshes::Polycube column(int height) {
  meshes::Polycube body(1, 1, height);
  for (int z = 0; z < height; ++z) body.set({0, 0, z}, 1);
  return body;
}

/// Upward crossings of zero, interpolated: the mean period between the first and the last one.
double mean_period(const std::vector<double>& signal, double step) {
  double first = -1.0;
  double last = -1.0;
  int count = 0;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    if (!(signal[i - 1] < 0.0 && signal[i] >= 0.0)) continue;
    last = (static_cast<double>(i) - signal[i] / (signal[i] - signal[i - 1])) * step;
    if (count == 0) first = last;
    ++count;
  }
  return (last - first) / (count - 1);
}

/// Angular momentum of a body about the origin, kg m^2/s. Velocities are those of half a step before the positions, which changes
/// nothing: positions differ by velocity times time.
/// @param densities of the voxels over that of `mass`
std::array<double, 3> angular_momentum(const Simulation& simulation, const std::vector<double>& densities) {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const std::array<double, 3> r = simulation.position_m(i);
    const std::array<double, 3> v = simulation.velocity_m_s(i);
    const std::array<double, 3> spin = simulation.angular_velocity_rad_s(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      sum[axis] += densities[i] * (mass * (r[next] * v[last] - r[last] * v[next]) + inertia * spin[axis]);
    }
  }
  return sum;
}

double length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

/// Two plates of two materials in antiphase, at rest in empty space: nothing can turn or move them.
struct Floating {
  meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 3, "001001001002002002002002002");
  std::vector<double> densities{1, 1, 1, 1, 1, 1, 1, 1, 1};
  Physics physics = floating_physics();

  Floating(BeamMoments moments, DampingMode damping) {
    physics.actuation = Actuation{};
    physics.beam_moments = moments;
    physics.integration.damping = damping;
  }
  /// Angular momentum after a time, over that of a turn of the body in a second; and how far it has moved, m.
  struct After {
    double turns;
    double moved_m;
  };
  [[nodiscard]] After after(double time_s) const {
    Simulation simulation(body, edge, physics);
    const std::array<double, 3> start = simulation.centre_of_mass_m();
    EXPECT_EQ(simulation.advance_to(time_s), io::RunStatus::completed);
    std::array<double, 3> moved = simulation.centre_of_mass_m();
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis] -= start[axis];
    const double turn_in_a_second = 2.0 * std::numbers::pi * 9.0 * mass * edge * edge;
    return {length(angular_momentum(simulation, densities)) / turn_in_a_second, length(moved)};
  }
};

TEST(DrivenInFlight, ABodyTurnsByItselfWithPublishedMoments) {
  for (const DampingMode damping : {DampingMode::increments, DampingMode::velocity})
    EXPECT_GT(Floating(BeamMoments::published, damping).after(0.3).turns, 1.0);
}

TEST(DrivenInFlight, ABodyKeepsItsMomentaWithBalancedMoments) {
  for (const DampingMode damping : {DampingMode::increments, DampingMode::velocity}) {
    for (const double density : {1.0, 4.0}) {
      Floating floating(BeamMoments::balanced, damping);
      floating.physics.materials[0].density_kg_m3 *= density;
      for (std::size_t i = 0; i < 3; ++i) floating.densities[i] = density;
      const Floating::After after = floating.after(1.0);
      EXPECT_LT(after.turns, 1e-9);
      EXPECT_LT(after.moved_m, 1e-12);
    }
  }
}

TEST(DrivenInFlight, BalancedMomentsMakeNoEnergy) {
  // After ten strokes nothing but the stroke itself moves: the energy of motion is that of the second stroke.
  for (const double bond : {0.1, 1.0}) {
    Floating floating(BeamMoments::balanced, DampingMode::velocity);
    floating.physics.damping_ratios.bond = bond;
    const auto largest_kinetic_J = [&](double from_s, double to_s) {
      Simulation simulation(floating.body, edge, floating.physics, {}, {.energy_ledger = true});
      double largest = 0.0;
      for (double time = from_s; time < to_s; time += 0.005) {
        EXPECT_EQ(simulation.advance_to(time), io::RunStatus::completed);
        largest = std::max(largest, simulation.energy()->kinetic_J);
      }
      return largest;
    };
    EXPECT_NEAR(largest_kinetic_J(2.0, 2.2) / largest_kinetic_J(0.2, 0.4), 1.0, 0.01) << bond;
  }
}

TEST(FreeFall, MatchesTheSumOfTheScheme) {
  // Semi-implicit Euler from rest: z0 - g/2 (t^2 + t h), exactly.
  Physics physics = still_physics();
  physics.floor = false;
  physics.damping_ratios.global = 0.0;
  Simulation simulation(meshes::bar(1), edge, physics);
  ASSERT_EQ(simulation.advance_to(0.05), io::RunStatus::completed);
  const double t = simulation.time_s();
  EXPECT_NEAR(t, 0.0500071066, 5e-9);  // the public engine keeps its step in single precision
  EXPECT_NEAR(simulation.position_m(0)[2], -0.5 * gravity * (t * t + t * simulation.time_step_s()), 1e-12);
}

TEST(FreeFall, ApproachesTheExponentialUnderGlobalDamping) {
  // m z'' = -m g - c z' from rest: z = -v_inf (t - tau (1 - e^(-t/tau))); O(h) error of the scheme below 1e-5 m here.
  Physics physics = still_physics();
  physics.floor = false;
  Simulation simulation(meshes::bar(1), edge, physics);
  ASSERT_EQ(simulation.advance_to(0.05), io::RunStatus::completed);
  const double tau = mass / (2.0 * 0.01 * std::sqrt(mass * modulus * edge));
  const double t = simulation.time_s();
  const double exact = -gravity * tau * (t - tau * (1.0 - std::exp(-t / tau)));
  EXPECT_NEAR(exact, 0.0145939926895 - 0.02, 1e-7);
  EXPECT_NEAR(simulation.position_m(0)[2], exact, 1e-5);
  EXPECT_NEAR(simulation.position_m(0)[2], 0.0145877344086 - 0.02, 1e-7);  // the public engine
}

TEST(RestOnTheFloor, OneVoxelSinksByItsWeightOverTwiceTheStiffness) {
  Simulation simulation(meshes::bar(1), edge, still_physics());
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  EXPECT_NEAR(-simulation.position_m(0)[2] / (mass * gravity / (2.0 * modulus * edge)), 1.0, 1e-5);
}

TEST(RestOnTheFloor, AColumnIsShortenedByTheWeightAboveEachBeam) {
  Simulation simulation(column(10), edge, still_physics());
  ASSERT_EQ(simulation.advance_to(5.0), io::RunStatus::completed);
  const double unit = mass * gravity / (modulus * edge);
  EXPECT_NEAR(simulation.position_m(0)[2] / (-10.0 * unit / 2.0), 1.0, 1e-5);
  // Top against bottom: the beam above voxel k carries 9 - k voxels, 45 in all; the strain is small enough for E L^2 u / l0 to be
  // linear.
  EXPECT_NEAR((simulation.position_m(9)[2] - 0.09) / (-10.0 * unit / 2.0 - 45.0 * unit), 1.0, 1e-5);
}

TEST(RestOnTheFloor, AFullCubeSinksLikeItsColumns) {
  Simulation simulation(meshes::full_cube(3), edge, still_physics());
  ASSERT_EQ(simulation.advance_to(5.0), io::RunStatus::completed);
  const double unit = mass * gravity / (modulus * edge);
  EXPECT_NEAR(simulation.position_m(0)[2] / (-1.5 * unit), 1.0, 1e-5);
  // Mean of the three layers: -1.5, -1.5 - 2, -1.5 - 2 - 1.
  EXPECT_NEAR((simulation.centre_of_mass_m()[2] - edge) / (-(1.5 + 3.5 + 4.5) / 3.0 * unit), 1.0, 1e-5);
}

struct Cantilever {
  Physics physics = floating_physics();
  VoxelLoads loads;
  Cantilever() {
    physics.damping_ratios.global = 0.05;
    loads.fixed.assign(10, false);
    loads.fixed[0] = true;
  }
  Simulation settled() {
    Simulation simulation(meshes::bar(10), edge, physics, loads);
    EXPECT_EQ(simulation.advance_to(10.0), io::RunStatus::completed);
    return simulation;
  }
};

TEST(Cantilever, SagsLikeEulerBernoulliBeamsWithLumpedWeights) {
  // Nodal loads m g at x_k = k L: tip deflection = sum m g x_k^2 (3 x_9 - x_k) / (6 E I), I = L^4/12.
  const double bending = modulus * std::pow(edge, 4) / 12.0;
  double exact = 0.0;
  for (int k = 1; k <= 9; ++k) {
    const double x = k * edge;
    exact -= 0.01 * mass * gravity * x * x * (3.0 * 9.0 * edge - x) / (6.0 * bending);
  }
  EXPECT_NEAR(exact, -0.000111207411, 1e-12);
  Cantilever cantilever;
  cantilever.physics.gravity_m_s2 = 0.01 * gravity;
  EXPECT_NEAR(cantilever.settled().position_m(9)[2] / exact, 1.0, 1e-4);
}

TEST(Cantilever, SagsLikeThePublicEngineBeyondLinearTheory) {
  Cantilever cantilever;
  cantilever.physics.gravity_m_s2 = 0.1 * gravity;
  {
    const Simulation simulation = cantilever.settled();
    EXPECT_NEAR(simulation.position_m(9)[2] / -0.00111194751887, 1.0, 2e-4);
    EXPECT_NEAR((simulation.position_m(9)[0] - 0.09) / -7.76398468971e-06, 1.0, 2e-4);
  }
  cantilever.physics.gravity_m_s2 = gravity;
  const Simulation simulation = cantilever.settled();
  EXPECT_NEAR(simulation.position_m(9)[2] / -0.010995792215, 1.0, 1e-3);
  EXPECT_NEAR((simulation.position_m(9)[0] - 0.09) / -0.000762655282139, 1.0, 1e-3);
  const std::array<double, 4> q = simulation.orientation(9);
  EXPECT_NEAR(2.0 * std::asin(std::abs(q[2])) / 0.166264549, 1.0, 1e-3);
}

TEST(Cantilever, BendsLikeThePublicEngineUnderALargeTipForce) {
  Cantilever cantilever;
  cantilever.loads.force_N.assign(10, {0.0, 0.0, 0.0});
  cantilever.loads.force_N[9] = {0.0, 0.0, 0.002};
  const Simulation simulation = cantilever.settled();
  EXPECT_NEAR((simulation.position_m(9)[0] - 0.09) / -0.014116421999, 1.0, 3e-3);
  EXPECT_NEAR(simulation.position_m(9)[2] / 0.0441906279392, 1.0, 3e-3);
  const std::array<double, 4> q = simulation.orientation(9);
  EXPECT_NEAR(2.0 * std::asin(std::abs(q[2])) / 0.775866985, 1.0, 3e-3);
  EXPECT_EQ(simulation.large_angle_beams(), 3U);
}

TEST(Cantilever, StretchesAndTwistsByTheClosedForm) {
  // Tip force F: F l / (E L^2); tip moment M: M l / (E L^4 / 12), l = 9 L.
  Cantilever cantilever;
  cantilever.loads.force_N.assign(10, {0.0, 0.0, 0.0});
  cantilever.loads.moment_N_m.assign(10, {0.0, 0.0, 0.0});
  cantilever.loads.force_N[9] = {0.01, 0.0, 0.0};
  cantilever.loads.moment_N_m[9] = {1e-6, 0.0, 0.0};
  const Simulation simulation = cantilever.settled();
  EXPECT_NEAR((simulation.position_m(9)[0] - 0.09) / 0.0009, 1.0, 1e-5);
  EXPECT_NEAR(2.0 * std::asin(simulation.orientation(9)[1]) / 0.0108, 1.0, 1e-5);
}

TEST(RingDown, AxialFrequencyIsThatOfTheScheme) {
  Physics physics = floating_physics();
  physics.damping_ratios.bond = 0.0;
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{-1e-3, 0.0, 0.0}, {1e-3, 0.0, 0.0}};
  Simulation simulation(meshes::bar(2), edge, physics, loads);
  const double h = simulation.time_step_s();
  std::vector<double> stretch;
  for (int i = 0; i < 60000; ++i) {
    stretch.push_back(simulation.position_m(1)[0] - simulation.position_m(0)[0] - edge);
    ASSERT_EQ(simulation.advance(1), io::RunStatus::completed);
  }
  const double omega = std::sqrt(2.0 * modulus * edge / mass);
  const double discrete = std::asin(omega * h / 2.0) / (std::numbers::pi * h);
  EXPECT_NEAR(discrete, 712.985137, 1e-3);
  EXPECT_NEAR(mean_period(stretch, h) * discrete, 1.0, 1e-5);
}

TEST(RingDown, AxialDampingRatioIsZetaOverRootTwo) {
  // Each end is damped by zeta sqrt(m E L) times the rate of the extension: ratio zeta / sqrt(2) of the two-mass oscillator.
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = floating_physics();
    physics.damping_ratios.bond = 0.1;
    physics.integration.time_step_fraction = 0.09;
    physics.integration.damping = mode;
    VoxelLoads loads;
    loads.initial_velocity_m_s = {{-1e-3, 0.0, 0.0}, {1e-3, 0.0, 0.0}};
    Simulation simulation(meshes::bar(2), edge, physics, loads);
    std::vector<double> stretch;
    std::vector<double> peaks;
    for (int i = 0; i < 3000; ++i) {
      ASSERT_EQ(simulation.advance(1), io::RunStatus::completed);
      stretch.push_back(simulation.position_m(1)[0] - simulation.position_m(0)[0] - edge);
      const std::size_t n = stretch.size();
      if (n >= 3 && stretch[n - 2] > stretch[n - 3] && stretch[n - 2] >= stretch[n - 1]) peaks.push_back(stretch[n - 2]);
    }
    ASSERT_GE(peaks.size(), 5U);
    const double ratio = 0.1 / std::numbers::sqrt2;
    const double decrement = 2.0 * std::numbers::pi * ratio / std::sqrt(1.0 - ratio * ratio);
    EXPECT_NEAR(decrement, 0.445403, 1e-6);
    // The increments lag by half a step, h omega / 2 = 1e-3 of the damping; sampling of the peaks adds as much.
    EXPECT_NEAR(std::log(peaks[0] / peaks[4]) / 4.0 / decrement, 1.0, 2e-3);
    const double damped = std::sqrt(2.0 * modulus * edge / mass) * std::sqrt(1.0 - ratio * ratio) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(1.0 / mean_period(stretch, simulation.time_step_s()) / damped, 1.0, 2e-3);
  }
}

/// Ring-down of two voxels that turn against each other about `axis`, as a frequency in Hz.
double rotation_frequency(std::size_t axis) {
  Physics physics = floating_physics();
  physics.damping_ratios.bond = 0.0;
  physics.integration.time_step_fraction = 0.09;
  VoxelLoads loads;
  loads.initial_angular_velocity_rad_s.assign(2, {0.0, 0.0, 0.0});
  loads.initial_angular_velocity_rad_s[0][axis] = -1.0;
  loads.initial_angular_velocity_rad_s[1][axis] = 1.0;
  Simulation simulation(meshes::bar(2), edge, physics, loads);
  std::vector<double> angle;
  for (int i = 0; i < 60000; ++i) {
    angle.push_back(2.0 * simulation.orientation(1)[axis + 1]);
    EXPECT_EQ(simulation.advance(1), io::RunStatus::completed);
  }
  return 1.0 / mean_period(angle, simulation.time_step_s());
}

TEST(RingDown, AntisymmetricBendingAndTorsionHaveTheirFrequency) {
  // Turning against each other: sqrt(b3 / I) in bending, sqrt(2 a2 / I) in torsion, the same number; O(h^2): 1e-5 at this step.
  const double bending = std::sqrt(modulus * std::pow(edge, 3) / 6.0 / inertia) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(bending, 503.292121, 1e-5);
  EXPECT_NEAR(rotation_frequency(2) / bending, 1.0, 1.1e-5);
  EXPECT_NEAR(rotation_frequency(2) / 503.297164, 1.0, 1e-5);  // the public engine
  EXPECT_NEAR(rotation_frequency(0) / bending, 1.0, 1.1e-5);
  EXPECT_NEAR(rotation_frequency(0) / 503.296384, 1.0, 1e-5);
}

/// A voxel at rest on the floor (sunk in by its weight after 1 s would take long: it starts at z = 0 like the reference) that
/// slides.
struct Slide {
  double stop_time_s = 0.0;
  std::array<double, 3> stop_m{};
};

Slide slide(const std::array<double, 3>& velocity, double fraction, double global_damping) {
  Physics physics = still_physics();
  physics.damping_ratios.global = global_damping;
  physics.integration.time_step_fraction = fraction;
  // Settle first: the floor must carry the weight when the voxel starts.
  Simulation rest(meshes::bar(1), edge, physics);
  EXPECT_EQ(rest.advance_to(1.0), io::RunStatus::completed);
  const double sunk = rest.position_m(0)[2];
  VoxelLoads loads;
  loads.initial_velocity_m_s = {velocity};
  loads.initial_displacement_m = {{0.0, 0.0, sunk}};
  Simulation simulation(meshes::bar(1), edge, physics, loads);
  while (!simulation.is_in_static_friction(0) && simulation.time_s() < 0.1) {
    EXPECT_EQ(simulation.advance(1), io::RunStatus::completed);
  }
  return {simulation.time_s(), simulation.position_m(0)};
}

TEST(SlidingBlock, StopsWhereKineticFrictionHasUsedUpItsEnergy) {
  // v0^2 / (2 mu g); the scheme stops O(h) early.
  const double exact = 0.01 / (2.0 * 0.5 * gravity);
  const Slide fine = slide({0.1, 0.0, 0.0}, 0.09, 0.0);
  EXPECT_NEAR(fine.stop_m[0] / exact, 1.0, 5e-4);
  EXPECT_NEAR(fine.stop_m[0] / 0.00101948959558, 1.0, 5e-4);
  EXPECT_NEAR(fine.stop_time_s / 0.0203878611, 1.0, 5e-4);
  const Slide coarse = slide({0.1, 0.0, 0.0}, 0.9, 0.0);
  EXPECT_NEAR(coarse.stop_m[0] / 0.00101743739078, 1.0, 1e-4);
}

TEST(SlidingBlock, StopsEarlierUnderGlobalDamping) {
  const double c = 2.0 * 0.01 * std::sqrt(mass * modulus * edge) / mass;  // 1/s
  const double friction = 0.5 * gravity;
  const double exact = 0.1 / c - friction / (c * c) * std::log(1.0 + c * 0.1 / friction);
  EXPECT_NEAR(exact, 0.000565554245812, 1e-10);
  EXPECT_NEAR(slide({0.1, 0.0, 0.0}, 0.09, 0.01).stop_m[0] / exact, 1.0, 1e-3);
}

TEST(SlidingBlock, SlidesStraightInAnyDirection) {
  const Slide diagonal = slide({0.06, 0.08, 0.0}, 0.09, 0.0);
  EXPECT_NEAR(diagonal.stop_m[0] / 0.000611693757, 1.0, 5e-4);
  EXPECT_NEAR(diagonal.stop_m[1] / 0.000815591676, 1.0, 5e-4);
}

double pushed_distance(double force_over_weight) {
  Physics physics = still_physics();
  physics.damping_ratios.global = 0.0;
  Simulation rest(meshes::bar(1), edge, physics);
  EXPECT_EQ(rest.advance_to(1.0), io::RunStatus::completed);
  VoxelLoads loads;
  loads.force_N = {{force_over_weight * mass * gravity, 0.0, 0.0}};
  loads.initial_displacement_m = {{0.0, 0.0, rest.position_m(0)[2]}};
  Simulation simulation(meshes::bar(1), edge, physics, loads);
  EXPECT_EQ(simulation.advance_to(0.05), io::RunStatus::completed);
  return simulation.position_m(0)[0];
}

TEST(StaticFriction, HoldsBelowItsThresholdAndBreaksAboveIt) {
  EXPECT_EQ(pushed_distance(0.99), 0.0);
  // Breaks at once and slides with (1.01 - mu_k) g.
  EXPECT_NEAR(pushed_distance(1.01) / 0.00627028811, 1.0, 1e-4);
}

TEST(Drive, APairAtTwoTemperaturesRestsAtTheMeanOfItsSizes) {
  Physics physics = floating_physics();
  physics.damping_ratios.global = 0.01;
  VoxelLoads loads;
  loads.size_factor = {1.0 + 0.01 * 14.4714, 1.0 - 0.01 * 7.0};
  Simulation simulation(meshes::bar(2), edge, physics, loads);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  EXPECT_NEAR((simulation.position_m(1)[0] - simulation.position_m(0)[0]) / 0.010373570025, 1.0, 1e-6);
}

TEST(Collision, HeadOnPairReboundsLikeThePublicEngine) {
  Physics physics = floating_physics();
  physics.collisions.exclusion_depth = 5;
  meshes::Polycube body(4, 1, 1);
  body.set({0, 0, 0}, 1);
  body.set({3, 0, 0}, 1);
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0}};
  Simulation simulation(body, edge, physics, loads);
  double nearest = 1.0;
  while (simulation.time_s() < 0.905925845 - 1e-9) {
    ASSERT_EQ(simulation.advance(1), io::RunStatus::completed);
    nearest = std::min(nearest, simulation.position_m(1)[0] - simulation.position_m(0)[0]);
  }
  EXPECT_NEAR(nearest / 0.0124905437, 1.0, 1e-4);
  EXPECT_NEAR(simulation.position_m(0)[0] / 0.00869451735, 1.0, 1e-4);
  EXPECT_NEAR(simulation.position_m(1)[0] / 0.0213054826, 1.0, 1e-4);
  // What is left of 0.1 m/s after a nearly critical rebound; the public engine's overlaps carry single-precision rounding of
  // 5e-10 m, times the stiffness and the time in contact 1e-6 m/s.
  EXPECT_NEAR(simulation.velocity_m_s(1)[0], 6.78826636e-05, 5e-7);
  EXPECT_NEAR(simulation.velocity_m_s(0)[0] + simulation.velocity_m_s(1)[0], 0.0, 1e-15);
}

TEST(Momentum, DampingFromVelocitiesConservesItBetweenUnequalMasses) {
  Physics physics = floating_physics();
  physics.materials[1].density_kg_m3 = 40.0;
  physics.integration.damping = DampingMode::velocity;
  meshes::Polycube body(2, 1, 1);
  body.set({0, 0, 0}, 1);
  body.set({1, 0, 0}, 2);
  VoxelLoads loads;
  loads.initial_velocity_m_s = {{0.02, 0.01, 0.0}, {0.0, 0.0, 0.005}};
  Simulation simulation(body, edge, physics, loads);
  const auto momentum = [&] {
    const auto a = simulation.velocity_m_s(0);
    const auto b = simulation.velocity_m_s(1);
    return std::array<double, 3>{mass * a[0] + 4.0 * mass * b[0], mass * a[1] + 4.0 * mass * b[1],
                                 mass * a[2] + 4.0 * mass * b[2]};
  };
  const auto before = momentum();
  ASSERT_EQ(simulation.advance(5000), io::RunStatus::completed);
  const auto after = momentum();
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(after[axis], before[axis], 1e-12 * mass);
}

}  // namespace
}  // namespace menger::voxel
