#include "fem/implicit/implicit_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/input_error_message.h"
#include "tests/unit/fem/implicit/implicit_samples.h"

namespace menger::fem {
namespace {

ImplicitSample block() { return ImplicitSample(meshes::box({8e-3, 8e-3, 4e-3}, {2, 2, 1})); }

TEST(ImplicitDynamics, RefusesWhatItCannotMove) {
  const ImplicitSample sample = block();
  const auto message = [&](const auto& change) {
    ImplicitOptions options;
    Body body = sample.body;
    change(options, body);
    return tests::message_of([&] { ImplicitDynamics(sample.space, body, options); });
  };
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) { o.spectral_radius = 1.5; }),
            "implicit dynamics: spectral_radius = 1.5: must be in [0, 1]");
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) { o.tolerance = 0.0; }), "implicit dynamics: tolerance = 0: must be > 0");
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) { o.ground = RigidGround{}; }),
            "implicit dynamics: ground stiffness_Pa_per_m = 0: must be > 0");
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) { o.viscosities_Pa_s = {-1.0}; }),
            "implicit dynamics: viscosity_Pa_s = -1: must be >= 0");
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) {
              o.viscosities_Pa_s = {1.0, 1.0};
            }),
            "implicit dynamics: 2 viscosities for 1 regions");
  EXPECT_EQ(message([](ImplicitOptions& o, Body&) { o.schedules.resize(3); }), "implicit dynamics: 3 schedules for 0 plena");
  EXPECT_EQ(message([](ImplicitOptions&, Body& b) { b.regions[0].density_kg_per_m3 = 0.0; }),
            "implicit dynamics: density_kg_per_m3 = 0: must be > 0");
  EXPECT_EQ(message([](ImplicitOptions&, Body& b) { b.ground = GroundPlane{}; }),
            "implicit dynamics: the ground belongs to the options, not to the body");
  EXPECT_EQ(message([](ImplicitOptions&, Body& b) { b.plates.resize(1); }), "implicit dynamics: plates are not moved in time");
}

TEST(ImplicitDynamics, StopsWhenItIsTold) {
  const ImplicitSample sample = block();
  const std::atomic<bool> stop = true;
  ImplicitOptions options;
  options.stop = &stop;
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  EXPECT_EQ(dynamics.advance_to(1.0).status, io::RunStatus::stopped);
  EXPECT_EQ(dynamics.state().time_s, 0.0);
}

// Layers that fly against each other at 1 km/s pass through an element of 4 mm in any step that is not refused.
TEST(ImplicitDynamics, EndsWhereAnElementTurnsInsideOut) {
  const ImplicitSample sample = block();
  ImplicitOptions options;
  options.smallest_step_s = 5e-6;
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  dynamics.set_state(state_of(sample.space, nothing, [](const Point& X) {
    return Point{0.0, 0.0, X[2] > 2e-3 ? -500.0 : 500.0};
  }));
  const ImplicitReport report = dynamics.advance_to(1.0);
  EXPECT_EQ(report.status, io::RunStatus::inverted_element) << report.reason;
  for (const double u : dynamics.state().displacements_m) EXPECT_TRUE(std::isfinite(u));
}

// A run in two parts, with the state handed to another object in between, is the run in one part: the same steps, to rounding and
// what Newton's method leaves.
TEST(ImplicitDynamics, GoesOnFromAState) {
  const ImplicitSample sample = block();
  const ImplicitOptions options = equal_steps(1e-5);
  const auto stretched = [](const Point& X) { return Point{0.02 * X[0], 0.0, 0.0}; };
  ImplicitDynamics whole(sample.space, sample.body, options);
  whole.set_state(state_of(sample.space, stretched, nothing));
  ASSERT_EQ(whole.advance_to(4e-4).status, io::RunStatus::completed);
  ImplicitDynamics first(sample.space, sample.body, options);
  first.set_state(state_of(sample.space, stretched, nothing));
  ASSERT_EQ(first.advance_to(2e-4).status, io::RunStatus::completed);
  ImplicitDynamics second(sample.space, sample.body, options);
  second.set_state(first.state());
  ASSERT_EQ(second.advance_to(4e-4).status, io::RunStatus::completed);
  EXPECT_EQ(second.state().steps, whole.state().steps);
  for (std::size_t n = 0; n < whole.state().displacements_m.size(); ++n)
    EXPECT_NEAR(second.state().displacements_m[n], whole.state().displacements_m[n], 1e-10);
  EXPECT_NEAR(second.energies().imbalance_J(), whole.energies().imbalance_J(), 1e-6 * whole.energies().strain_J);
}

/// A block that slides on the ground, and what it needs.
struct SlidingBlock {
  ImplicitSample sample{meshes::box({8e-3, 8e-3, 4e-3}, {2, 2, 1})};
  ImplicitOptions options;
  SlidingBlock() {
    sample.body.gravity_m_per_s2 = {0.0, 0.0, -9.81};
    options.viscosities_Pa_s = {2.0};
    options.ground = RigidGround{.height_m = 0.0,
                                 .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 4e-3),
                                 .friction = {.static_coefficient = 0.8, .kinetic_coefficient = 0.4}};
  }
};

// A state holds all that friction remembers: a run that is taken up while the block slides, and while it comes to rest, ends as
// the one that set the same state and went on.
TEST(ImplicitDynamics, GoesOnFromAStateWithFriction) {
  SlidingBlock block;
  ImplicitDynamics whole(block.sample.space, block.sample.body, block.options);
  ASSERT_EQ(whole.advance_to(0.02).status, io::RunStatus::completed);
  whole.set_state(pushed(whole, {0.05, 0.0, 0.0}));
  bool has_slid = false;
  for (const double time : {0.025, 0.03, 0.05}) {  // it comes to rest after 0.05 / (0.4 g) = 13 ms
    ASSERT_EQ(whole.advance_to(time).status, io::RunStatus::completed);
    whole.set_state(whole.state());
    ImplicitDynamics part(block.sample.space, block.sample.body, block.options);
    part.set_state(whole.state());
    for (const GroundNode& node : whole.state().ground_nodes) has_slid = has_slid || node.slides;
    ASSERT_EQ(whole.advance_to(time + 1e-3).status, io::RunStatus::completed);
    ASSERT_EQ(part.advance_to(time + 1e-3).status, io::RunStatus::completed);
    EXPECT_EQ(part.state().displacements_m, whole.state().displacements_m) << time;
    EXPECT_EQ(part.state().steps, whole.state().steps);
    EXPECT_EQ(part.energies().work.friction_J, whole.energies().work.friction_J);
  }
  EXPECT_TRUE(has_slid);
}

// Times that differ by rounding are one time; a step between them would divide rounding by its square.
TEST(ImplicitDynamics, TakesNoStepsOfTheSizeOfRounding) {
  SlidingBlock block;
  ImplicitDynamics dynamics(block.sample.space, block.sample.body, block.options);
  ASSERT_EQ(dynamics.advance_to(0.3 * 0.1).status, io::RunStatus::completed);
  const ImplicitState before = dynamics.state();
  const double later = std::nextafter(std::nextafter(before.time_s, 1.0), 1.0);
  ASSERT_EQ(dynamics.advance_to(later).status, io::RunStatus::completed);
  EXPECT_EQ(dynamics.state().time_s, later);
  EXPECT_EQ(dynamics.state().steps, before.steps);
  EXPECT_EQ(dynamics.state().accelerations_m_per_s2, before.accelerations_m_per_s2);
}

// Steps grow to the whole way to the next time where their error allows it.
TEST(ImplicitDynamics, TakesOneStepBetweenTimesWhereNothingHappens) {
  const ImplicitSample sample = block();
  ImplicitDynamics dynamics(sample.space, sample.body, {});
  for (int n = 1; n <= 12; ++n) ASSERT_EQ(dynamics.advance_to(1e-3 * n).status, io::RunStatus::completed);
  const std::size_t steps = dynamics.state().steps;
  for (int n = 13; n <= 22; ++n) ASSERT_EQ(dynamics.advance_to(1e-3 * n).status, io::RunStatus::completed);
  EXPECT_EQ(dynamics.state().steps, steps + 10);
}

// Chamber walls are looked at only while the chamber is smaller than at rest. A module that flies far between two such times has
// not closed its walls.
TEST(ImplicitDynamics, FlyingFarDoesNotCloseWalls) {
  const ImplicitSample sample(hollow_cube(1, 4e-3));
  ImplicitOptions options;
  options.schedules = {{SinePressure{.low_Pa = -2e3, .high_Pa = 2e3, .frequency_Hz = 100.0, .phase = 0.25}, 0.0}};
  options.viscosities_Pa_s = {50.0};
  ImplicitDynamics dynamics(sample.space, sample.body, options);
  dynamics.set_state(state_of(sample.space, nothing, [](const Point&) { return Point{20.0, 0.0, 0.0}; }));
  double smallest = dynamics.chamber_volumes_m3()[0];
  const double first = smallest;
  for (int n = 1; n <= 25; ++n) {
    const ImplicitReport report = dynamics.advance_to(1e-3 * n);
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    smallest = std::min(smallest, dynamics.chamber_volumes_m3()[0]);
  }
  EXPECT_LT(smallest, 0.998 * first);
}

// Mass damping: a body that falls follows v = (g / a) (1 - exp(-a t)), with closed energies, for both kinds of mass. 100 steps of
// the trapezoidal rule are right to (a h)^2 / 12 = 3e-5.
TEST(ImplicitDynamics, MassDampingSlowsAFallingBody) {
  for (const bool lumped : {false, true}) {
    ImplicitSample sample = block();
    sample.body.gravity_m_per_s2 = {0.0, 0.0, -9.81};
    ImplicitOptions options = equal_steps(1e-3);
    options.lumped_mass = lumped;
    options.mass_damping_per_s = 20.0;
    ImplicitDynamics dynamics(sample.space, sample.body, options);
    ASSERT_EQ(dynamics.advance_to(0.1).status, io::RunStatus::completed);
    const double expected = -9.81 / 20.0 * (1.0 - std::exp(-2.0));
    for (std::size_t n = 2; n < dynamics.state().velocities_m_per_s.size(); n += 3)
      EXPECT_NEAR(dynamics.state().velocities_m_per_s[n], expected, 1e-4 * std::abs(expected));
    const MotionEnergies energies = dynamics.energies();
    EXPECT_NEAR(energies.imbalance_J(), 0.0, 1e-4 * energies.work.gravity_J);
    EXPECT_GT(energies.work.mass_damping_J, 0.1 * energies.work.gravity_J);
  }
}

// The same bytes from every run.
TEST(ImplicitDynamics, RepeatsItself) {
  const ImplicitSample sample(hollow_cube(1, 4e-3));
  const auto run = [&] {
    ImplicitOptions options;
    options.schedules = {{SinePressure{.high_Pa = 6e3, .frequency_Hz = 10.0}, 0.0}};
    options.viscosities_Pa_s = {10.0};
    ImplicitDynamics dynamics(sample.space, sample.body, options);
    EXPECT_EQ(dynamics.advance_to(0.02).status, io::RunStatus::completed);
    return dynamics.state().displacements_m;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace menger::fem
