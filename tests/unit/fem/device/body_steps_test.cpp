// Steps by blocks of threads: here a block of one, which is the code of graphics processors without one.

#include "fem/device/body_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "fem/device/cuda_step_taker.h"
#include "fem/device/lone_step_taker.h"
#include "fem/explicit/thin_wall_elements.h"
#include "io/device/graphics_processor.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

/// A body of two cells with two chambers and a wall between them, as `draft` cuts it.
meshes::HexahedralMesh two_chambers() {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = 2e-3;
  options.chambers = meshes::ChamberLayout::per_phase;
  set_elements({.fidelity = Fidelity::draft}, options);
  return meshes::hollow_polycube({"two", meshes::Polycube::from_digits(2, 1, 1, "12"), 10e-3}, options).mesh;
}

struct Sample {
  std::string name;
  materials::HyperelasticLaw law = materials::NeoHookean{50e3};
  Precision precision = Precision::double_precision;
  double viscosity_Pa_s = 0.0;
  std::size_t branches = 1;
  double mass_damping_per_s = 0.0;

  friend std::ostream& operator<<(std::ostream& out, const Sample& sample) { return out << sample.name; }
};

ExplicitBodyOptions body_options(const meshes::HexahedralMesh& mesh, const Sample& sample) {
  ExplicitBodyOptions options = silicone_options(mesh, sample.viscosity_Pa_s);
  options.regions[0].material.law = sample.law;
  if (sample.branches > 0) options.regions[0].material.branches = {{.shear_modulus_Pa = 10e3, .relaxation_time_s = 5e-3}};
  for (std::size_t n = 1; n < sample.branches; ++n)
    options.regions[0].material.branches.push_back(
        {.shear_modulus_Pa = 5e3, .relaxation_time_s = 20e-3 * static_cast<double>(n)});
  options.elements = ThinWallOptions{.precision = sample.precision, .constants = {}};
  return options;
}

/// Different pressures in both chambers, weight, and a ground on which the body slides.
ExplicitOptions dynamics_options(const Sample& sample) {
  ExplicitOptions options;
  options.schedules = {{SinePressure{.high_Pa = 4e3, .frequency_Hz = 50.0}, 0.01},
                       {SinePressure{.high_Pa = 6e3, .frequency_Hz = 40.0}, 0.0}};
  options.loads.gravity_m_per_s2 = {0.5, 0.0, -9.81};
  options.loads.mass_damping_per_s = sample.mass_damping_per_s;
  options.loads.ground = RigidGround{.height_m = 0.0,
                                     .stiffness_Pa_per_m = ground_stiffness_Pa_per_m(1e6, 2e-3),
                                     .friction = {.static_coefficient = 0.5, .kinetic_coefficient = 0.3}};
  return options;
}

/// Counts the steps that another one takes.
class Counted final : public StepTaker {
 public:
  Counted(std::unique_ptr<StepTaker> taker, std::size_t& count) : taker_(std::move(taker)), count_(count) {}
  [[nodiscard]] std::string text() const override { return taker_->text(); }
  [[nodiscard]] StepsOutcome take(const StepsOrder& order, const SteppedBody& body) override {
    const StepsOutcome outcome = taker_->take(order, body);
    count_ += outcome.steps;
    return outcome;
  }

 private:
  std::unique_ptr<StepTaker> taker_;
  std::size_t& count_;
};

class BodyStepsOf : public testing::TestWithParam<Sample> {};

/// The largest difference of two states, relative to the largest number.
double difference_of(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  double apart = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    largest = std::max(largest, std::abs(a[n]));
    apart = std::max(apart, std::abs(a[n] - b[n]));
  }
  return apart / largest;
}

// In double precision rounding is all that tells both apart: 1e-9 after some 700 steps with contact and friction. In single
// precision velocities come out 2e-4 apart, as they do with two instruction sets of the processor.
TEST_P(BodyStepsOf, AreThoseOfTheProcessor) {
  const Sample& sample = GetParam();
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBodyOptions options = body_options(mesh, sample);
  ASSERT_EQ(obstacle_to_blocks(mesh, options), "");
  const ExplicitBody body(mesh, options);
  ExplicitOptions settings = dynamics_options(sample);
  ExplicitDynamics expected(mesh, body, settings);
  std::size_t left = 0;
  settings.step_taker = std::make_shared<Counted>(lone_step_taker(mesh, body, options, settings.loads), left);
  ExplicitDynamics dynamics(mesh, body, settings);
  for (const double time_s : {0.02, 0.05}) {
    ASSERT_EQ(expected.advance_to(time_s).status, io::RunStatus::completed);
    ASSERT_EQ(dynamics.advance_to(time_s).status, io::RunStatus::completed) << dynamics.advance_to(time_s).reason;
    EXPECT_EQ(dynamics.state().steps, expected.state().steps);
    const double tolerance = sample.precision == Precision::double_precision ? 1e-9 : 1e-3;
    EXPECT_LT(difference_of(expected.state().displacements_m, dynamics.state().displacements_m), tolerance);
    EXPECT_LT(difference_of(expected.state().velocities_m_per_s, dynamics.state().velocities_m_per_s), tolerance);
    const MotionEnergies a = expected.energies();
    const MotionEnergies b = dynamics.energies();
    const double of_turnover = tolerance * a.turnover_J();
    EXPECT_NEAR(a.work.pressure_J, b.work.pressure_J, of_turnover);
    EXPECT_NEAR(a.work.wall_pressure_J, b.work.wall_pressure_J, of_turnover);
    EXPECT_NEAR(a.work.contact_J, b.work.contact_J, of_turnover);
    EXPECT_NEAR(a.work.friction_J, b.work.friction_J, of_turnover);
    EXPECT_NEAR(a.work.viscous_J, b.work.viscous_J, of_turnover);
    EXPECT_NEAR(a.work.mass_damping_J, b.work.mass_damping_J, of_turnover);
    EXPECT_NEAR(a.strain_J, b.strain_J, of_turnover);
    EXPECT_GT(a.turnover_J(), 0.0);
  }
  EXPECT_NE(expected.energies().work.friction_J, 0.0);
  EXPECT_GT(left, dynamics.state().steps * 8 / 10) << "nothing touches here";
}

// A graphics processor gives what a block of one thread gives, up to rounding, and the same bytes again.
TEST_P(BodyStepsOf, AreAlikeOnAGraphicsProcessor) {
  if (const std::string obstacle = io::obstacle_to_device(); !obstacle.empty()) GTEST_SKIP() << obstacle;
  const Sample& sample = GetParam();
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBodyOptions options = body_options(mesh, sample);
  const ExplicitBody body(mesh, options);
  ExplicitOptions settings = dynamics_options(sample);
  settings.step_taker = lone_step_taker(mesh, body, options, settings.loads);
  ExplicitDynamics expected(mesh, body, settings);
  settings.step_taker = cuda_step_taker(mesh, body, options, settings.loads);
  ExplicitDynamics dynamics(mesh, body, settings);
  ExplicitDynamics again(mesh, body, settings);
  for (const double time_s : {0.02, 0.05}) {
    ASSERT_EQ(expected.advance_to(time_s).status, io::RunStatus::completed);
    ASSERT_EQ(dynamics.advance_to(time_s).status, io::RunStatus::completed) << dynamics.advance_to(time_s).reason;
    ASSERT_EQ(again.advance_to(time_s).status, io::RunStatus::completed);
    EXPECT_EQ(dynamics.state().displacements_m, again.state().displacements_m);
    EXPECT_EQ(dynamics.state().velocities_m_per_s, again.state().velocities_m_per_s);
    const double tolerance = sample.precision == Precision::double_precision ? 1e-9 : 1e-3;
    EXPECT_LT(difference_of(expected.state().displacements_m, dynamics.state().displacements_m), tolerance);
    EXPECT_LT(difference_of(expected.state().velocities_m_per_s, dynamics.state().velocities_m_per_s), tolerance);
    const MotionEnergies a = expected.energies();
    const MotionEnergies b = dynamics.energies();
    EXPECT_NEAR(a.work.pressure_J, b.work.pressure_J, tolerance * a.turnover_J());
    EXPECT_NEAR(a.work.friction_J, b.work.friction_J, tolerance * a.turnover_J());
    EXPECT_NEAR(a.work.viscous_J, b.work.viscous_J, tolerance * a.turnover_J());
    EXPECT_NEAR(a.imbalance_J(), b.imbalance_J(), tolerance * a.turnover_J());
  }
}

/// A body with two legs that are thrown at each other, moved by this processor and with the help of a block.
struct ThrownLegs {
  meshes::HexahedralMesh mesh;
  ExplicitBodyOptions options;
  ExplicitBody body;
  std::size_t left = 0;
  std::unique_ptr<ExplicitDynamics> expected;
  std::unique_ptr<ExplicitDynamics> dynamics;

  static meshes::HexahedralMesh legs() {
    meshes::HollowBodyOptions hollow;
    hollow.wall_thickness_m = 2e-3;
    set_elements({.fidelity = Fidelity::draft}, hollow);
    return meshes::hollow_polycube({"legs", meshes::Polycube::from_digits(3, 1, 2, "101111"), 10e-3}, hollow).mesh;
  }

  ThrownLegs(double speed_m_per_s, double pressure_Pa)
      : mesh(legs()), options(body_options(mesh, {.name = "soft", .law = materials::NeoHookean{20e3}})), body(mesh, options) {
    ExplicitOptions settings;
    settings.schedules = {{ConstantPressure{pressure_Pa}, 0.02}};
    settings.loads.mass_damping_per_s = 60.0;
    expected = std::make_unique<ExplicitDynamics>(mesh, body, settings);
    settings.step_taker = std::make_shared<Counted>(lone_step_taker(mesh, body, options, settings.loads), left);
    dynamics = std::make_unique<ExplicitDynamics>(mesh, body, settings);
    ExplicitState thrown = expected->state();
    for (std::size_t node = 0; node < mesh.points.size(); ++node)
      if (mesh.points[node][2] < 5e-3)
        thrown.velocities_m_per_s[3 * node] = mesh.points[node][0] < 15e-3 ? speed_m_per_s : -speed_m_per_s;
    thrown.at_start_J.reset();
    thrown.stable_step_s = 0.0;
    expected->set_state(thrown);
    dynamics->set_state(thrown);
  }
};

// Where legs come near each other without touching, the processor takes steps in between.
TEST(BodySteps, AreSharedWithTheProcessorNearContact) {
  ThrownLegs legs(1.1, 7e3);
  for (int n = 1; n <= 20; ++n) {
    ASSERT_EQ(legs.expected->advance_to(8e-3 * n).status, io::RunStatus::completed);
    ASSERT_EQ(legs.dynamics->advance_to(8e-3 * n).status, io::RunStatus::completed);
    ASSERT_EQ(legs.dynamics->state().steps, legs.expected->state().steps);
    EXPECT_LT(difference_of(legs.expected->state().displacements_m, legs.dynamics->state().displacements_m), 1e-8);
  }
  EXPECT_GT(legs.left, 0U);
  EXPECT_LT(legs.left, legs.dynamics->state().steps);
}

// Legs that touch do so in both, and come to rest in the same place: 1e-3 of the largest displacement apart, as they still swing.
// Steps near contact are not the same ones: this processor halves those in which near parts move far.
TEST(BodySteps, LeaveContactToTheProcessor) {
  ThrownLegs legs(1.5, 5e3);
  std::size_t expected_touches = 0;
  std::size_t touches = 0;
  for (int n = 1; n <= 100; ++n) {
    ASSERT_EQ(legs.expected->advance_to(2e-3 * n).status, io::RunStatus::completed);
    ASSERT_EQ(legs.dynamics->advance_to(2e-3 * n).status, io::RunStatus::completed);
    expected_touches += legs.expected->self_touches().size();
    touches += legs.dynamics->self_touches().size();
  }
  EXPECT_GT(expected_touches, 0U);
  EXPECT_GT(touches, 0U);
  EXPECT_GT(legs.left, 0U);
  EXPECT_LT(difference_of(legs.expected->state().displacements_m, legs.dynamics->state().displacements_m), 1e-3);
}

// An element that is turned inside out ends a run as it does on the processor.
TEST(BodySteps, TellOfAnElementThatFails) {
  const meshes::HexahedralMesh mesh = two_chambers();
  const ExplicitBodyOptions options = body_options(mesh, {});
  const ExplicitBody body(mesh, options);
  ExplicitOptions settings;
  settings.step_taker = lone_step_taker(mesh, body, options, settings.loads);
  ExplicitDynamics dynamics(mesh, body, settings);
  ExplicitState state = dynamics.state();
  state.velocities_m_per_s[2] = 100.0;  // a corner shot into the body
  state.at_start_J.reset();
  state.stable_step_s = 0.0;
  dynamics.set_state(state);
  const ExplicitReport& report = dynamics.advance_to(1e-3);
  EXPECT_NE(report.status, io::RunStatus::completed);
  EXPECT_FALSE(report.reason.empty());
}

TEST(BodySteps, AreRefusedForBodiesThatBlocksDoNotTake) {
  const meshes::HexahedralMesh mesh = two_chambers();
  ExplicitBodyOptions options = body_options(mesh, {});
  options.elements = ThreeFieldOptions{};
  EXPECT_EQ(obstacle_to_blocks(mesh, options), "its elements are not thin walls");
}

INSTANTIATE_TEST_SUITE_P(Samples, BodyStepsOf,
                         testing::Values(Sample{.name = "elastic", .branches = 0}, Sample{.name = "branch"},
                                         Sample{.name = "branches", .branches = 3},
                                         Sample{.name = "viscous", .viscosity_Pa_s = 5.0},
                                         Sample{.name = "damped", .mass_damping_per_s = 20.0},
                                         Sample{.name = "single", .precision = Precision::single_precision},
                                         Sample{.name = "yeoh", .law = materials::Yeoh{20e3, 200.0, 50.0}},
                                         Sample{.name = "mooney_rivlin", .law = materials::MooneyRivlin{15e3, 5e3}},
                                         Sample{.name = "gent", .law = materials::Gent{50e3, 30.0}},
                                         Sample{.name = "arruda_boyce", .law = materials::ArrudaBoyce{45e3, 3.0}},
                                         Sample{.name = "ogden2", .law = materials::Ogden<2>{{{{30e3, 2.0}, {2e3, 4.0}}}}}),
                         [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace menger::fem
