#include "fem/implicit_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../support/input_error_message.h"
#include "implicit_samples.h"

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
