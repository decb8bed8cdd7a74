// Implicit dynamics against closed forms, the modes of the linearised body and equilibria.

#include "fem/implicit/implicit_dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "fem/modes/vibration.h"
#include "tests/unit/fem/implicit/implicit_samples.h"

namespace menger::fem {
namespace {

constexpr double pi = std::numbers::pi;

/// A bar along x, held across, with the modulus kappa + 4/3 mu; the trace of its first free mode starts as a cosine.
ImplicitSample bar(int degree) {
  const std::size_t elements = degree == 1 ? 50 : 12;
  ImplicitSample sample(meshes::box({0.1, 2e-3, 2e-3}, {elements, 1, 1}), degree);
  for (const char* label : {"y min", "y max"})
    sample.body.supports.push_back({meshes::label_index(sample.mesh, label), {false, true, false}});
  for (const char* label : {"z min", "z max"})
    sample.body.supports.push_back({meshes::label_index(sample.mesh, label), {false, false, true}});
  return sample;
}

constexpr double bar_length = 0.1;
double wave_speed() { return std::sqrt((2.5e6 + 4.0 / 3.0 * 50e3) / 1070.0); }
Point bar_mode(const Point& X) { return {1e-6 * std::cos(pi * X[0] / bar_length), 0.0, 0.0}; }

/// Amplitude of a mode in a state: projection on it.
double amplitude(const ImplicitDynamics& dynamics, std::span<const double> mode) {
  double sum = 0.0;
  double square = 0.0;
  for (std::size_t n = 0; n < mode.size(); ++n) {
    sum += mode[n] * dynamics.state().displacements_m[n] * dynamics.masses_kg()[n / 3];
    square += mode[n] * mode[n] * dynamics.masses_kg()[n / 3];
  }
  return sum / square;
}

/// When the amplitude goes through zero for the k-th time, by straight lines between equal steps.
double crossing_s(ImplicitDynamics& dynamics, std::span<const double> mode, double step_s, int count) {
  double last = amplitude(dynamics, mode);
  for (int n = 1; n < 100'000; ++n) {
    if (dynamics.advance_to(step_s * n).status != io::RunStatus::completed) break;
    const double now = amplitude(dynamics, mode);
    if (last * now <= 0.0 && --count == 0) return step_s * (n - 1 + last / (last - now));
    last = now;
  }
  return 0.0;
}

// u = a cos(pi x / L) cos(2 pi f t), f = c / (2 L), to the 11th zero. Consistent masses raise f by (pi / 50)^2 / 24 = 1.6e-4 with
// 50 linear elements, by far less with 12 quadratic ones; 80 steps in a period of the trapezoidal rule lower it by (2 pi / 80)^2
// / 12 = 5.1e-4.
TEST(ImplicitDynamics, FreeBarVibratesAtItsFrequency) {
  for (const int degree : {1, 2}) {
    const ImplicitSample sample = bar(degree);
    const double period = 2.0 * bar_length / wave_speed();
    ImplicitDynamics dynamics(sample.space, sample.body, equal_steps(period / 80.0));
    dynamics.set_state(state_of(sample.space, bar_mode, nothing));
    const std::vector<double> mode = at_nodes(sample.space, bar_mode);
    const double crossing = crossing_s(dynamics, mode, period / 80.0, 11);
    const double expected = 1.0 + 5.1e-4 - (degree == 1 ? 1.6e-4 : 0.0);
    EXPECT_NEAR(crossing / (5.25 * period), expected, 5e-5) << degree;
  }
}

// The lowest elastic mode of the free hollow module, by SLEPc: within the error of the step, which the formula above gives, and
// in all 0.5 % of the frequency.
TEST(ImplicitDynamics, FreeModuleVibratesInItsMode) {
  const ImplicitSample sample(hollow_cube(1, 4e-3));
  Equilibrium equilibrium(sample.space, sample.body, {});
  const VibrationReport modes = vibrations(equilibrium, equilibrium.rest(), 1.0, {.mode_count = 1});
  ASSERT_EQ(modes.status, io::RunStatus::completed) << modes.reason;
  const double period = 1.0 / modes.frequencies_Hz[0];
  ImplicitDynamics dynamics(sample.space, sample.body, equal_steps(period / 80.0));
  ImplicitState state = dynamics.state();
  state.accelerations_m_per_s2.clear();
  state.at_start_J.reset();
  double largest = 0.0;
  for (const double u : modes.modes[0]) largest = std::max(largest, std::abs(u));
  for (std::size_t n = 0; n < state.displacements_m.size(); ++n) state.displacements_m[n] = 1e-7 * modes.modes[0][n] / largest;
  dynamics.set_state(state);
  const double crossing = crossing_s(dynamics, modes.modes[0], period / 80.0, 7);
  EXPECT_NEAR(crossing / (3.25 * period), 1.0 + 5.1e-4, 2e-4);
}

/// A block for that, compressible, so that a few steps resolve its waves of pressure, too.
ImplicitSample compressible_block(int degree) {
  ImplicitSample sample(meshes::box({8e-3, 4e-3, 4e-3}, {degree == 1 ? 4UL : 2UL, 1, 1}), degree);
  sample.body.regions[0].volume = materials::SimoTaylorVolume{250e3};
  return sample;
}

/// A viscous block in free vibration with strains of a fifth, after more than a period: its ends start without stress.
std::vector<double> swung(const ImplicitSample& sample, ImplicitOptions options) {
  constexpr double length = 8e-3;
  options.viscosities_Pa_s = {10.0};
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  const auto stretched = [](const Point& X) {
    const double strain = 0.2 * std::sin(pi * X[0] / length);
    return Point{-0.2 * length / pi * std::cos(pi * X[0] / length), -0.5 * strain * X[1], -0.5 * strain * X[2]};
  };
  dynamics.set_state(state_of(sample.space, stretched, nothing));
  EXPECT_EQ(dynamics.advance_to(2e-3).status, io::RunStatus::completed);
  return dynamics.state().displacements_m;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) square += (a[n] - b[n]) * (a[n] - b[n]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

// Once steps resolve its swings across, too, the error falls with the square of the step, for elements of both degrees and with
// the damping of the scheme.
TEST(ImplicitDynamics, ErrorFallsWithTheSquareOfTheStep) {
  for (const int degree : {1, 2}) {
    const ImplicitSample sample = compressible_block(degree);
    const std::vector<double> fine = swung(sample, equal_steps(1.25e-6, 0.5));
    const double coarse_error = distance(swung(sample, equal_steps(1e-5, 0.5)), fine);
    const double half_error = distance(swung(sample, equal_steps(5e-6, 0.5)), fine);
    EXPECT_GT(coarse_error, 1e-8);
    EXPECT_NEAR(std::log2(coarse_error / half_error), 2.0, 0.25) << degree;
  }
}

// A local error of third order under control: errors at the end go with the tolerance to the power 2/3. Steps change by factors,
// which makes that uneven.
TEST(ImplicitDynamics, ToleranceControlsTheError) {
  const ImplicitSample sample = compressible_block(1);
  const auto at_tolerance = [&](double tolerance) {
    ImplicitOptions options;
    options.tolerance = tolerance;
    return swung(sample, options);
  };
  const std::vector<double> fine = swung(sample, equal_steps(1.25e-6, 1.0));
  const double loose = distance(at_tolerance(1e-5), fine);
  const double middle = distance(at_tolerance(1e-6), fine);
  const double tight = distance(at_tolerance(1e-7), fine);
  EXPECT_LT(middle, 0.5 * loose);
  EXPECT_LT(tight, 0.5 * middle);
  EXPECT_NEAR(std::log10(loose / tight) / 2.0, 2.0 / 3.0, 0.25);
}

// The trapezoidal rule keeps the energy of an elastic body to the square of the step; the scheme's damping takes energy out, and
// never adds any in the sum.
TEST(ImplicitDynamics, BooksCloseWithTheSquareOfTheStep) {
  const ImplicitSample sample(meshes::box({8e-3, 4e-3, 4e-3}, {4, 1, 1}));
  const auto worst_imbalance = [&](double step, double spectral_radius) {
    ImplicitDynamics dynamics(sample.space, sample.body, equal_steps(step, spectral_radius));
    const auto spinning = [](const Point& X) { return Point{20.0 * (X[0] - 4e-3), -10.0 * (X[1] - 2e-3), 40.0 * X[0]}; };
    dynamics.set_state(state_of(sample.space, nothing, spinning));
    const double before = dynamics.energies().kinetic_J;
    double worst = 0.0;
    for (int n = 1; n <= 40; ++n) {
      EXPECT_EQ(dynamics.advance_to(1e-4 * n).status, io::RunStatus::completed);
      const double imbalance = dynamics.energies().imbalance_J() / before;
      if (std::abs(imbalance) > std::abs(worst)) worst = imbalance;
    }
    return worst;
  };
  const double coarse = std::abs(worst_imbalance(1e-4, 1.0));
  const double fine = std::abs(worst_imbalance(5e-5, 1.0));
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(coarse / fine, 3.0);
  EXPECT_LT(worst_imbalance(5e-5, 0.5), 0.0);
}

// Free flight keeps momentum, whatever the body does with itself.
TEST(ImplicitDynamics, FreeFlightKeepsMomentum) {
  const ImplicitSample sample(hollow_cube(1, 4e-3));
  ImplicitOptions options;
  options.newton_tolerance = 1e-4;
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  const auto spinning = [](const Point& X) {
    const Point arm = difference(X, {0.01, 0.01, 0.01});
    return sum(Point{0.5, -0.2, 0.1}, sum(cross({20.0, -10.0, 30.0}, arm), Point{15.0 * arm[0], -20.0 * arm[1], 0.0}));
  };
  dynamics.set_state(state_of(sample.space, nothing, spinning));
  const Point start = dynamics.centre_of_mass_m();
  ASSERT_EQ(dynamics.advance_to(0.05).status, io::RunStatus::completed);
  const Point way = difference(dynamics.centre_of_mass_m(), start);
  EXPECT_LT(norm(difference(way, {0.025, -0.01, 0.005})), 1e-5 * norm(way));
}

// A pressure that rises within 5 ms and stays: the viscous module, held at its ground, swings and settles in the equilibrium of
// the quasi-static solver, for elements of both degrees. 0.4 s are many times the decay of its lowest mode.
TEST(ImplicitDynamics, PressureStepSettlesInTheEquilibrium) {
  for (const int degree : {1, 2}) {
    ImplicitSample sample(hollow_cube(1, 4e-3), degree);
    sample.body.supports.push_back({meshes::label_index(sample.mesh, "ground"), {true, true, true}});
    Equilibrium equilibrium(sample.space, sample.body, {});
    BodyState still = equilibrium.rest();
    const PlenumControl control = PressureControl{4e3};
    ASSERT_EQ(equilibrium.solve(still, std::span(&control, 1), 1.0).status, io::RunStatus::completed);
    double largest = 0.0;
    for (const double u : still.displacements_m) largest = std::max(largest, std::abs(u));
    EXPECT_GT(largest, 1e-4);

    ImplicitOptions options;
    options.schedules = {{ConstantPressure{4e3}, 5e-3}};
    options.viscosities_Pa_s = {50.0};
    ImplicitDynamics dynamics(sample.space, sample.body, options);
    ASSERT_EQ(dynamics.advance_to(0.4).status, io::RunStatus::completed);
    for (std::size_t n = 0; n < still.displacements_m.size(); ++n)
      EXPECT_NEAR(dynamics.state().displacements_m[n], still.displacements_m[n], 1e-4 * largest) << degree;
    EXPECT_LT(dynamics.energies().kinetic_J, 1e-6 * dynamics.energies().strain_J);
    EXPECT_NEAR(dynamics.energies().work.pressure_J, dynamics.energies().strain_J + dynamics.energies().work.viscous_J,
                0.01 * dynamics.energies().work.pressure_J);
  }
}

/// A block of 8 x 8 x 4 mm on the ground, in 2 mm elements, as in the tests of explicit dynamics.
ImplicitSample block(Point gravity = {0.0, 0.0, -9.81}) {
  ImplicitSample sample(meshes::box({8e-3, 8e-3, 4e-3}, {4, 4, 2}));
  sample.body.gravity_m_per_s2 = gravity;
  return sample;
}

ImplicitOptions on_ground(const Friction& friction) {
  ImplicitOptions options;
  options.viscosities_Pa_s = {2.0};
  options.ground =
      RigidGround{.height_m = 0.0, .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 2e-3), .friction = friction};
  return options;
}

// A block that slides stops after v^2 / (2 mu g), by stick springs and by regularised friction alike. It shears and rocks a
// little while it does, so that its centre of mass follows within a per cent; regularised friction lets it creep to its rest, 1 %
// of the speed being the regularisation's.
TEST(ImplicitDynamics, SlidingBlockStopsWhereItShould) {
  constexpr double mu = 0.4;
  constexpr double speed = 0.3;
  for (const double regularisation : {0.0, 3e-3}) {
    const ImplicitSample sample = block();
    const double static_coefficient = regularisation > 0.0 ? mu : 0.5;
    ImplicitDynamics dynamics(sample.space, sample.body,
                              on_ground({.static_coefficient = static_coefficient,
                                         .kinetic_coefficient = mu,
                                         .regularisation_speed_m_per_s = regularisation}));
    ASSERT_EQ(dynamics.advance_to(0.05).status, io::RunStatus::completed);  // settles
    dynamics.set_state(pushed(dynamics, {speed, 0.0, 0.0}));
    const double start = dynamics.centre_of_mass_m()[0];
    ASSERT_EQ(dynamics.advance_to(0.05 + 1.5 * speed / (mu * 9.81)).status, io::RunStatus::completed);
    const double distance = speed * speed / (2.0 * mu * 9.81);
    EXPECT_NEAR(dynamics.centre_of_mass_m()[0] - start, distance, (regularisation > 0.0 ? 0.02 : 0.01) * distance);
    const MotionEnergies energies = dynamics.energies();
    EXPECT_NEAR(energies.work.friction_J, 0.5 * dynamics.mass_kg() * speed * speed, 0.02 * energies.work.friction_J);
    EXPECT_LT(std::abs(energies.imbalance_J()), 0.01 * energies.work.friction_J);
    const double end = dynamics.centre_of_mass_m()[0];
    ASSERT_EQ(dynamics.advance_to(0.3).status, io::RunStatus::completed);
    EXPECT_NEAR(dynamics.centre_of_mass_m()[0], end, regularisation > 0.0 ? 1e-5 : 1e-6);  // and stays
  }
}

// On a slope (gravity turned) a block slips while it settles, comes to rest where both coefficients are larger than the slope,
// and runs off with g (sin a - mu cos a) where they are not: by the second difference of its places.
TEST(ImplicitDynamics, BlockOnASlopeRestsOrSlides) {
  constexpr double interval = 0.1;
  const auto places = [&](double slope) {
    const ImplicitSample sample = block({9.81 * std::sin(slope), 0.0, -9.81 * std::cos(slope)});
    ImplicitDynamics dynamics(sample.space, sample.body, on_ground({.static_coefficient = 0.5, .kinetic_coefficient = 0.45}));
    std::array<double, 3> x{};
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_EQ(dynamics.advance_to(interval * static_cast<double>(n + 1)).status, io::RunStatus::completed);
      x[n] = dynamics.centre_of_mass_m()[0];
    }
    return x;
  };
  const auto rest = places(std::atan(0.2));
  EXPECT_NEAR(rest[2], rest[0], 1e-6);
  const double steep = std::atan(0.7);
  const auto sliding = places(steep);
  const double acceleration = 9.81 * (std::sin(steep) - 0.45 * std::cos(steep));
  EXPECT_NEAR((sliding[2] - 2.0 * sliding[1] + sliding[0]) / (interval * interval), acceleration, 0.01 * acceleration);
}

/// Where a module is and what has happened to it: highest place of the centre of mass, way along x, chamber volume at the peak of
/// the pressure.
struct Walk {
  double peak_m = 0.0;
  double path_m = 0.0;
  double mean_path_m = 0.0;  ///< over the second half
  double largest_volume_m3 = 0.0;
  double friction_J = 0.0;
};

template <class Dynamics>
Walk walk(Dynamics& dynamics) {
  Walk result;
  const double start = dynamics.centre_of_mass_m()[0];
  for (int n = 1; n <= 200; ++n) {
    EXPECT_EQ(dynamics.advance_to(n / 300.0).status, io::RunStatus::completed);
    result.peak_m = std::max(result.peak_m, dynamics.centre_of_mass_m()[2]);
    if (n > 100) result.mean_path_m += 0.01 * (dynamics.centre_of_mass_m()[0] - start);
    result.largest_volume_m3 = std::max(result.largest_volume_m3, dynamics.chamber_volumes_m3()[0]);
  }
  result.path_m = dynamics.centre_of_mass_m()[0] - start;
  result.friction_J = dynamics.energies().work.friction_J;
  return result;
}

// The module of 20 mm under 6 kPa at 3 Hz, on a ground that is less rough for sliding backwards, through two periods: 111 um by
// explicit dynamics, whatever its step. With the same lumped masses the implicit one goes 118 um: its nodes stick elastically,
// and its steps are long (113 um with stick springs of 10 and steps of 0.1 ms). The mean place, which leaves out how the module
// sways when it comes to rest on its base, differs by 6 um of 53; less than what twice the ground's stiffness does to explicit
// dynamics.
TEST(ImplicitDynamics, ModuleWalksAsByExplicitDynamics) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const Point gravity{0.0, 0.0, -9.81};
  const std::vector<PlenumSchedule> schedules{{SinePressure{.low_Pa = 0.0, .high_Pa = 6e3, .frequency_Hz = 3.0}, 0.0}};
  const RigidGround ground{
      .height_m = 0.0,
      .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 2e-3),
      .friction = {
          .static_coefficient = 0.6, .kinetic_coefficient = 0.5, .directional = DirectionalFriction{.backward_factor = 0.3}}};
  const ExplicitBody lumped(mesh, silicone_options(mesh, 10.0));
  ExplicitOptions explicit_options;
  explicit_options.schedules = schedules;
  explicit_options.loads.gravity_m_per_s2 = gravity;
  explicit_options.loads.ground = ground;
  ExplicitDynamics by_explicit(mesh, lumped, explicit_options);
  const Walk expected = walk(by_explicit);
  EXPECT_LT(expected.path_m, -100e-6);

  ImplicitSample sample(mesh);
  sample.body.gravity_m_per_s2 = gravity;
  ImplicitOptions options;
  options.schedules = schedules;
  options.viscosities_Pa_s = {10.0};
  options.ground = ground;
  options.lumped_mass = true;
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  const Walk found = walk(dynamics);
  EXPECT_NEAR(found.peak_m, expected.peak_m, 0.002 * expected.peak_m);
  EXPECT_NEAR(found.largest_volume_m3, expected.largest_volume_m3, 0.002 * expected.largest_volume_m3);
  EXPECT_NEAR(found.path_m, expected.path_m, 0.1 * std::abs(expected.path_m));
  EXPECT_NEAR(found.mean_path_m, expected.mean_path_m, 0.15 * std::abs(expected.mean_path_m));
  EXPECT_NEAR(found.friction_J, expected.friction_J, 0.05 * expected.friction_J);
}

// Vacuum pulls the walls of the module together: the run ends where they touch, with the last state before.
TEST(ImplicitDynamics, WallsThatTouchEndARun) {
  const ImplicitSample sample(hollow_cube());
  ImplicitOptions options;
  options.schedules = {{ConstantPressure{-20e3}, 0.05}};
  options.viscosities_Pa_s = {50.0};
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  const ImplicitReport report = dynamics.advance_to(0.1);
  EXPECT_EQ(report.status, io::RunStatus::wall_contact) << report.reason;
  EXPECT_GT(dynamics.chamber_volumes_m3()[0], 0.0);
  EXPECT_LT(dynamics.chamber_volumes_m3()[0], 0.5 * 4.096e-6);
}

}  // namespace
}  // namespace menger::fem
