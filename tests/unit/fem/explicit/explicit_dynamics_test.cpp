#include "fem/explicit/explicit_dynamics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "fem/explicit/explicit_contact.h"
#include "tests/support/input_error_message.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

using tests::message_of;

/// Everything that there is: pressure, weight, ground, friction, both kinds of damping.
ExplicitOptions every_term() {
  ExplicitOptions options;
  options.schedules = {{SinePressure{.high_Pa = 4e3, .frequency_Hz = 50.0}, 0.0}};
  options.loads.gravity_m_per_s2 = {1.0, 0.0, -9.81};
  options.loads.mass_damping_per_s = 2.0;
  options.loads.ground = RigidGround{.height_m = 0.0,
                                     .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(2.5e6, 2e-3),
                                     .friction = {.static_coefficient = 0.5, .kinetic_coefficient = 0.3}};
  return options;
}

struct Outcome {
  ExplicitState state;
  MotionEnergies energies;
};

Outcome run(const ExplicitOptions& options, const std::vector<double>& times) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh, 2.0));
  ExplicitDynamics dynamics(mesh, body, options);
  for (const double time : times) EXPECT_EQ(dynamics.advance_to(time).status, io::RunStatus::completed);
  return {dynamics.state(), dynamics.energies()};
}

TEST(ExplicitDynamics, ResultsDoNotDependOnThreads) {
  ExplicitOptions options = every_term();
  const Outcome one = run(options, {0.004});
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const Outcome many = run(options, {0.004});
    EXPECT_EQ(one.state.displacements_m, many.state.displacements_m);
    EXPECT_EQ(one.state.velocities_m_per_s, many.state.velocities_m_per_s);
    EXPECT_EQ(one.energies.imbalance_J(), many.energies.imbalance_J());
    EXPECT_EQ(one.energies.work.viscous_J, many.energies.work.viscous_J);
  }
}

TEST(ExplicitDynamics, GoesOnFromAStateAsIfNothingHadHappened) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh, 2.0));
  ExplicitDynamics first(mesh, body, every_term());
  ASSERT_EQ(first.advance_to(0.002).status, io::RunStatus::completed);
  const ExplicitState middle = first.state();
  ASSERT_EQ(first.advance_to(0.004).status, io::RunStatus::completed);
  ExplicitDynamics second(mesh, body, every_term());
  second.set_state(middle);
  ASSERT_EQ(second.advance_to(0.004).status, io::RunStatus::completed);
  EXPECT_EQ(first.state().displacements_m, second.state().displacements_m);
  EXPECT_EQ(first.energies().imbalance_J(), second.energies().imbalance_J());
}

// Rest, thrown upwards: a balance that began with the state before is off by what was added, one that begins anew is not.
TEST(ExplicitDynamics, BooksOfAChangedStateBeginAnew) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  ExplicitState state = dynamics.state();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) state.velocities_m_per_s[3 * n + 2] = 2.0;
  dynamics.set_state(state);
  EXPECT_NEAR(dynamics.energies().imbalance_J(), 2.0 * body.mass_kg(), 1e-12);
  state.at_start_J.reset();
  dynamics.set_state(state);
  EXPECT_NEAR(dynamics.energies().imbalance_J(), 0.0, 1e-15);
  EXPECT_EQ(dynamics.advance_to(1e-3).status, io::RunStatus::completed);
}

TEST(ExplicitDynamics, RefusesAStateThatIsInsideOut) {
  const meshes::HexahedralMesh mesh = meshes::box({6e-3, 2e-3, 2e-3}, {3, 1, 1});
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  ExplicitState state = dynamics.state();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) state.displacements_m[3 * n] = -2.0 * mesh.points[n][0];
  EXPECT_NE(message_of([&] { dynamics.set_state(state); }).find("element 0 at (0, 0, 0) mm was crushed or turned inside out"),
            std::string::npos);
}

// Energies are asked for between steps and must leave no trace.
TEST(ExplicitDynamics, LookingChangesNothing) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitDynamics looked(mesh, body, every_term());
  ExplicitDynamics alone(mesh, body, every_term());
  const std::vector<double> times{0.001, 0.002};
  static_cast<void>(follow(looked, times, [](ExplicitDynamics& at) {
    static_cast<void>(at.energies());
    static_cast<void>(at.velocities_m_per_s());
  }));
  static_cast<void>(follow(alone, times, [](ExplicitDynamics&) {}));
  EXPECT_EQ(looked.state().displacements_m, alone.state().displacements_m);
  EXPECT_EQ(looked.state().work.pressure_J, alone.state().work.pressure_J);
}

TEST(ExplicitDynamics, PressureBeyondTheLimitIsAStatus) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitOptions options;
  options.schedules = {{ConstantPressure{60e3}, 0.0}};
  ExplicitDynamics dynamics(mesh, body, options);
  const ExplicitReport report = dynamics.advance_to(0.2);
  EXPECT_EQ(report.status, io::RunStatus::diverged);
  EXPECT_NE(report.reason.find("chamber 0 grew to "), std::string::npos) << report.reason;
  // People read it: no more than four digits of a number.
  EXPECT_LT(report.reason.size(), std::string("chamber 0 grew to 1.234e+10 times its volume at 1.234e-10 s").size())
      << report.reason;
  EXPECT_LT(dynamics.state().time_s, 0.2);
  for (const double u : dynamics.state().displacements_m) ASSERT_TRUE(std::isfinite(u));
  const MotionEnergies energies = dynamics.energies();
  EXPECT_LT(std::abs(energies.imbalance_J()), 0.2 * energies.work.pressure_J);
  const double time = dynamics.state().time_s;
  EXPECT_EQ(dynamics.advance_to(0.3).reason, report.reason);
  EXPECT_EQ(dynamics.state().time_s, time);
}

TEST(ExplicitDynamics, InvertedElementIsNamed) {
  const meshes::HexahedralMesh mesh = meshes::box({6e-3, 2e-3, 2e-3}, {3, 1, 1});
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitDynamics dynamics(mesh, body, {});
  ExplicitState state = dynamics.state();
  state.at_start_J.reset();
  // The nodes at x = 4 mm fly through those at 6 mm.
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (std::abs(mesh.points[n][0] - 4e-3) < 1e-9) state.velocities_m_per_s[3 * n] = 1e3;
  dynamics.set_state(state);
  const ExplicitReport report = dynamics.advance_to(0.01);
  EXPECT_EQ(report.status, io::RunStatus::inverted_element) << report.reason;
  EXPECT_EQ(report.failed_element, 2U);
  EXPECT_NE(report.reason.find("element 2 at (4, 0, 0) mm"), std::string::npos) << report.reason;
}

TEST(ExplicitDynamics, StopsWhenAsked) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  const std::atomic<bool> stop = true;
  ExplicitOptions options;
  options.stop = &stop;
  ExplicitDynamics dynamics(mesh, body, options);
  EXPECT_EQ(dynamics.advance_to(1.0).status, io::RunStatus::stopped);
  EXPECT_EQ(dynamics.state().steps, 0U);
}

TEST(ExplicitDynamics, StepsEndAtTheTimesAskedFor) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  ExplicitOptions options;
  options.largest_step_s = 7e-6;
  ExplicitDynamics dynamics(mesh, body, options);
  ASSERT_EQ(dynamics.advance_to(1e-4).status, io::RunStatus::completed);
  EXPECT_EQ(dynamics.state().time_s, 1e-4);
  EXPECT_EQ(dynamics.state().steps, 15U);
}

TEST(ExplicitDynamics, RefusesBadOptions) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ExplicitBody body(mesh, silicone_options(mesh));
  const auto message = [&](const auto& change) {
    ExplicitOptions options = every_term();
    change(options);
    return message_of([&] { ExplicitDynamics(mesh, body, options); });
  };
  EXPECT_EQ(message([](ExplicitOptions&) {}), "no error");
  EXPECT_NE(message([](ExplicitOptions& o) { o.step_safety = 1.5; }).find("step_safety = 1.5"), std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) { o.threads = 0; }).find("threads = 0"), std::string::npos);
  EXPECT_NE(
      message([](ExplicitOptions& o) { o.self_contact->stiffness_Pa_per_m = -1.0; }).find("self-contact stiffness_Pa_per_m = -1"),
      std::string::npos);
  const auto rub = [&](double static_coefficient, double kinetic_coefficient) {
    return message([&](ExplicitOptions& o) {
      o.self_contact->friction = SurfaceFriction{static_coefficient, kinetic_coefficient};
    });
  };
  EXPECT_EQ(rub(0.5, 0.5), "no error");
  EXPECT_NE(rub(0.5, -0.5).find("self_contact_kinetic_friction = -0.5"), std::string::npos);
  EXPECT_NE(rub(0.1, 0.5).find("self_contact_static_friction = 0.1"), std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) { o.schedules.resize(2); }).find("2 schedules for 1 plena"), std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) { o.loads.ground->friction.static_coefficient = 0.1; }).find("static_friction"),
            std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) {
              o.loads.ground->friction.directional = DirectionalFriction{.forward = {1.0, 1.0}};
            }).find("length of forward"),
            std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) {
              o.loads.ground->friction.directional = DirectionalFriction{.backward_factor = -1.0};
            }).find("backward_factor = -1"),
            std::string::npos);
  EXPECT_NE(message([](ExplicitOptions& o) {
              o.schedules[0].schedule = SinePressure{0.0, 1.0, 1e4, 0.0};
            }).find("period"),
            std::string::npos);
  EXPECT_EQ(message([](ExplicitOptions& o) {
              o.schedules[0].schedule = SinePressure{0.0, 1.0, 1e4, 0.0};
              o.largest_step_s = 1e-6;
            }),
            "no error");
}

TEST(ExplicitContact, OuterAreaIsThatOfTheOutside) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const std::vector<double> areas = outer_node_areas_m2(mesh);
  double total = 0.0;
  for (const double area : areas) total += area;
  EXPECT_NEAR(total, 6.0 * 4e-4, 1e-15);
}

}  // namespace
}  // namespace menger::fem
