// Timoshenko's beam: what shear changes, and what it leaves as it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tests/unit/voxel/statics/static_samples.h"
#include "voxel/lanes/simulation.h"
#include "voxel/model/surrogate_beams.h"
#include "voxel/statics/vibration.h"

namespace menger::voxel {
namespace {

using meshes::Side;

/// Shear compliances (1/Pa) from none to one that leaves next to no stiffness against it; with the moduli of the sample Phi of a
/// beam between voxels is modulus times compliance.
constexpr std::array<double, 4> compliances_per_Pa{0.0, 0.3 / sample_modulus, 10.0 / sample_modulus, 1e4 / sample_modulus};

SurrogateParameters shearing(double compliance_per_Pa) {
  SurrogateParameters parameters = sample_parameters();
  parameters.shear_compliance_per_Pa.fill(compliance_per_Pa);
  return parameters;
}

BeamCoefficients<double> shearing_beam(double phi) {
  return beam_coefficients(section_of(shearing(phi / sample_modulus), 0), sample_edge);
}

/// A cantilever of n voxels, held by a plate, its length up to the centre of the last.
struct Cantilever {
  explicit Cantilever(double compliance_per_Pa)
      : body(sample_body(meshes::bar(n), {Side::x_min}, shearing(compliance_per_Pa))), equilibrium(body) {}

  /// Displacement and rotation of the last voxel under loads on it.
  Pose response(const Vector3<double>& force, const Vector3<double>& moment) {
    StaticLoads loads = under_pressure(0.0);
    loads.points = {{static_cast<std::size_t>(n - 1), force, moment}};
    EXPECT_EQ(equilibrium.load(loads), io::RunStatus::completed);
    const Pose& last = equilibrium.pose(n - 1);
    return {last.position - body.rest[n - 1].position, last.orientation};
  }

  static constexpr int n = 5;
  static constexpr double length = (n - 0.5) * sample_edge;
  StaticBody body;
  Equilibrium equilibrium;
};

// Loads that bend it by 1e-6 of its length: what is not linear is of the square of that. Newton's steps are exact up to the
// differences of the tangent, 1e-9.
TEST(Shear, OfACantileverIsTimoshenkosUnderATipForce) {
  for (const double compliance : compliances_per_Pa) {
    Cantilever cantilever(compliance);
    const double bending = std::pow(Cantilever::length, 3) / (3.0 * sample_bending());
    const double shear = Cantilever::length * compliance / (sample_edge * sample_edge);
    const double force = 1e-6 * Cantilever::length / (bending + shear);
    const Pose tip = cantilever.response({0.0, 0.0, force}, {});
    EXPECT_NEAR(tip.position.z, force * (bending + shear), 1e-9 * force * (bending + shear)) << compliance;
    const double slope = force * Cantilever::length * Cantilever::length / (2.0 * sample_bending());
    EXPECT_NEAR(rotation_vector(tip.orientation).y, -slope, 1e-9 * 1e-6) << compliance;
  }
}

TEST(Shear, LeavesACantileverUnderAnEndMomentAsItIs) {
  const double angle = 1e-6;
  const double moment = sample_bending() * angle / Cantilever::length;
  for (const double compliance : compliances_per_Pa) {
    const Pose tip = Cantilever(compliance).response({}, {0.0, moment, 0.0});
    EXPECT_NEAR(rotation_vector(tip.orientation).y, angle, 1e-9 * angle) << compliance;
    // Where next to nothing resists shear, rounding of the moments shears it by more.
    EXPECT_NEAR(tip.position.z, -0.5 * angle * Cantilever::length, 1e-8 * angle * Cantilever::length) << compliance;
  }
}

TEST(Shear, OfHalvesAddsUpUnderAForce) {
  SurrogateParameters parameters = shearing(2e-5);
  parameters.shear_compliance_per_Pa[3] = 7e-5;
  const double area = sample_edge * sample_edge;
  // Under a force F halves of length l / 2 shear by F l / (2 G A_s) each.
  const double per_force = 0.5 * (2e-5 + 7e-5) / area;
  EXPECT_DOUBLE_EQ(beam_section(parameters, 0, 3, false).shear_compliance_per_N, per_force);
  parameters.joint = {.axial = 2.0, .bending = 3.0, .torsion = 5.0};
  EXPECT_DOUBLE_EQ(beam_section(parameters, 0, 3, true).shear_compliance_per_N, per_force);
}

TEST(Shear, OfNoComplianceLeavesEveryBitOfEulerAndBernoulli) {
  const SectionStiffness section = section_of(shearing(0.0), 2);
  const double l = 0.7 * sample_edge;
  const BeamCoefficients<double> c = beam_coefficients(section, l);
  EXPECT_EQ(c.shear, 12.0 * section.bending_N_m2 / (l * l * l));
  EXPECT_EQ(c.bend, 6.0 * section.bending_N_m2 / (l * l));
  EXPECT_EQ(c.turn, 2.0 * section.bending_N_m2 / l);
  EXPECT_EQ(c.turn_difference, 0.0);
  EXPECT_EQ(c.turn_difference_root, 0.0);
  const BeamDeformation<double> e{{3e-4, -2e-4, 1e-4}, 0.02, -0.03, {0.05, 0.01, -0.04}};
  for (const auto& [with, without] : {std::pair{beam_elastic_loads<true>(c, e, l), beam_elastic_loads<false>(c, e, l)},
                                      std::pair{beam_damping<true>(c, e), beam_damping<false>(c, e)}}) {
    EXPECT_EQ(with.lower_moment.y, without.lower_moment.y);
    EXPECT_EQ(with.lower_moment.z, without.lower_moment.z);
    EXPECT_EQ(with.upper_moment.y, without.upper_moment.y);
    EXPECT_EQ(with.upper_moment.z, without.upper_moment.z);
  }
}

TEST(Shear, GivesLoadsThatAreTheGradientOfTheEnergy) {
  const BeamCoefficients<double> c = shearing_beam(3.0);
  const BeamDeformation<double> at{{3e-4, -2e-4, 1e-4}, 0.02, -0.03, {0.05, 0.01, -0.04}};
  const BeamLoads<double> loads = beam_elastic_loads(c, at, sample_edge);
  const auto slope = [&at, &c](auto&& component) {
    const double step = 1e-4;
    BeamDeformation<double> above = at;
    BeamDeformation<double> below = at;
    component(above) += step;
    component(below) -= step;
    return (beam_energy(c, above, sample_edge) - beam_energy(c, below, sample_edge)) / (2.0 * step);
  };
  // The energy is quadratic: rounding of 1e-16 of it by the step.
  const double tolerance = 1e-9 * c.turn;
  EXPECT_NEAR(slope([](BeamDeformation<double>& e) -> double& { return e.lower_angle_y; }), -loads.lower_moment.y, tolerance);
  EXPECT_NEAR(slope([](BeamDeformation<double>& e) -> double& { return e.lower_angle_z; }), -loads.lower_moment.z, tolerance);
  EXPECT_NEAR(slope([](BeamDeformation<double>& e) -> double& { return e.upper_angle.y; }), -loads.upper_moment.y, tolerance);
  EXPECT_NEAR(slope([](BeamDeformation<double>& e) -> double& { return e.upper_angle.z; }), -loads.upper_moment.z, tolerance);
}

// In the small-angle law a rigid rotation w of the beam moves the upper end by w l and turns both ends by w; a rotation of
// everything, however large, is none to the beam.
TEST(Shear, AnswersARigidRotationWithNoLoad) {
  const BeamCoefficients<double> c = shearing_beam(3.0);
  const double w = 0.01;
  const BeamDeformation<double> turned{{0.0, w * sample_edge, -w * sample_edge}, w, w, {0.0, w, w}};
  for (const BeamLoads<double>& loads : {beam_elastic_loads(c, turned, sample_edge), beam_damping(c, turned)}) {
    EXPECT_NEAR(loads.lower_force.y, 0.0, 1e-14 * c.bend * w);
    EXPECT_NEAR(loads.lower_force.z, 0.0, 1e-14 * c.bend * w);
    for (const double moment : {loads.lower_moment.y, loads.lower_moment.z, loads.upper_moment.y, loads.upper_moment.z})
      EXPECT_NEAR(moment, 0.0, 1e-14 * c.bend * w);
  }
  const Quaternion<double> turn = quaternion_of(Vector3<double>{0.8, -1.1, 0.4});
  const Pose upper{rotate(matrix(turn), Vector3<double>{0.0, 0.0, sample_edge}), turn};
  for (const bool small : {false, true}) {
    const EndLoads loads = beam_end_loads(beam_ends({{0.0, 0.0, 0.0}, turn}, upper, 2, sample_edge), small, c, 2);
    EXPECT_LT(loads.cwiseAbs().maxCoeff(), 1e-14 * c.axial);
  }
}

// Pure curvature, equal and opposite rotations, shears nothing: neither its stiffness 2 EI / l nor its damping may change.
TEST(Shear, LeavesTheDampingOfPureBendingAsItIs) {
  BeamDeformation<double> rate{};
  rate.lower_angle_y = -1.0;
  rate.upper_angle.y = 1.0;
  const auto moment = [&rate](double phi) {
    BeamCoefficients<double> c = shearing_beam(phi);
    set_damping(c, 0.3, 1e-3, 1e-3, true);
    const BeamLoads<double> loads = beam_damping(c, rate);
    EXPECT_DOUBLE_EQ(loads.lower_moment.y, -loads.upper_moment.y);
    return loads.upper_moment.y;
  };
  EXPECT_LT(moment(0.0), 0.0);
  for (const double phi : {0.3, 10.0, 1e4}) EXPECT_NEAR(moment(phi) / moment(0.0), 1.0, 1e-12) << phi;
}

/// A calibrated body of the sample's parameters that floats, without damping.
Physics floating(const SurrogateParameters& parameters) {
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = parameters, .pressure_Pa = {0.0, 0.0}};
  physics.surrogate->parameters.bond_damping_ratio = 0.0;
  physics.surrogate->parameters.validity = {.smallest_strain = -1.0, .largest_strain = 1.0, .longest_body_cells = 9};
  physics.surrogate->parameters.validity.set_pressures(0.0, 0.0);
  physics.actuation.mode = ActuationMode::hold;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  physics.collisions.exclusion_depth.reset();
  return physics;
}

TEST(Shear, IsInTheEnergyLedger) {
  for (const double compliance : compliances_per_Pa) {
    VoxelLoads loads;
    loads.initial_angular_velocity_rad_s = {{0.0, 0.0, -1e-3}, {0.0, 0.0, 1e-3}};
    Simulation simulation(meshes::bar(2), sample_edge, floating(shearing(compliance)), loads, {.energy_ledger = true});
    ASSERT_EQ(simulation.advance(20000), io::RunStatus::completed);
    EXPECT_GT(simulation.energy()->largest_energy_J, 0.0);
    EXPECT_LE(std::abs(simulation.energy()->residual_J()), 1e-9 * simulation.energy()->largest_energy_J) << compliance;
  }
}

// Two voxels of a moment of inertia I that turn by theta and -theta curve their beam by 2 theta / l, whatever its shear: I
// theta'' = -2 EI theta / l.
TEST(Shear, LeavesTheVibrationOfPureBendingAsItIs) {
  for (const double compliance : compliances_per_Pa) {
    const StaticBody body = sample_body(meshes::bar(2), {}, shearing(compliance));
    const double expected = std::sqrt(2.0 * sample_bending() / (sample_edge * body.inertia_kg_m2[0])) / (2.0 * std::numbers::pi);
    const Vibrations vibrations = natural_vibrations(small_motion(Equilibrium(body, {.fixed_voxels = {0}, .ground = false})), 12);
    double nearest = std::numeric_limits<double>::infinity();
    for (const double frequency : vibrations.frequencies_Hz) nearest = std::min(nearest, std::abs(frequency - expected));
    EXPECT_LT(nearest, 1e-7 * expected) << compliance;
  }
}

// The central difference scheme is stable for steps below 2 / omega of the stiffest vibration; the rule keeps a third of that
// for solid voxels, and shear must not use it up.
TEST(Shear, LeavesTheRecommendedStepSafe) {
  const meshes::Polycube cells = meshes::full_cube(3);
  for (const double softness : {1e-4, 1.0}) {  // of stretching and twisting against bending
    for (const double compliance : compliances_per_Pa) {
      SurrogateParameters parameters = shearing(compliance);
      parameters.axial_Pa.fill(softness * sample_modulus);
      parameters.torsion_Pa.fill(softness * sample_modulus);
      parameters.ground_stiffness_N_per_m = 1e-3;
      const StaticBody body = sample_body(cells, {}, parameters);
      const SmallMotion motion = small_motion(Equilibrium(body, {.fixed_voxels = {0}, .ground = false}));
      const Vibrations vibrations = natural_vibrations(motion, 1000);
      ASSERT_FALSE(vibrations.frequencies_Hz.empty());
      const double step =
          Simulation(cells, sample_edge, floating(parameters)).time_step_s() / Physics{}.integration.time_step_fraction;
      const double stiffest = 2.0 * std::numbers::pi * vibrations.frequencies_Hz.back();
      EXPECT_LT(stiffest * step, 0.7) << softness << " " << compliance;
    }
  }
}

// Every beam damped critically, which asks more of the step than the elastic loads.
TEST(Shear, StaysStableUnderCriticalDamping) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    for (const double compliance : compliances_per_Pa) {
      Physics physics = floating(shearing(compliance));
      physics.surrogate->parameters.bond_damping_ratio = 1.0;
      physics.integration.damping = mode;
      const meshes::Polycube cells = meshes::full_cube(3);
      VoxelLoads loads;
      for (int i = 0; i < 27; ++i) {
        loads.initial_velocity_m_s.push_back({0.01 * std::sin(i), 0.01 * std::sin(2 * i), 0.01 * std::sin(3 * i)});
        loads.initial_angular_velocity_rad_s.push_back({std::sin(4 * i), std::sin(5 * i), std::sin(6 * i)});
      }
      Simulation simulation(cells, sample_edge, physics, loads, {.energy_ledger = true});
      ASSERT_EQ(simulation.advance(5000), io::RunStatus::completed);
      EXPECT_LE(simulation.energy()->largest_energy_J, 1.01 * simulation.energy()->kinetic_start_J) << compliance;
      EXPECT_LT(simulation.energy()->elastic_J, 1e-2 * simulation.energy()->kinetic_start_J) << compliance;
    }
  }
}

// A loss tangent of 0.1 at 1 Hz asks for a ratio of about 25.
TEST(Shear, StaysStableFarBeyondCriticalDamping) {
  for (const DampingMode mode : {DampingMode::increments, DampingMode::velocity}) {
    Physics physics = floating(shearing(compliances_per_Pa[1]));
    physics.surrogate->parameters.bond_damping_ratio = 25.0;
    physics.integration.damping = mode;
    VoxelLoads loads;
    for (int i = 0; i < 27; ++i) loads.initial_velocity_m_s.push_back({0.01 * std::sin(i), 0.01 * std::sin(2 * i), 0.0});
    Simulation simulation(meshes::full_cube(3), sample_edge, physics, loads, {.energy_ledger = true});
    ASSERT_EQ(simulation.advance(5000), io::RunStatus::completed);
    EXPECT_LE(simulation.energy()->largest_energy_J, 1.01 * simulation.energy()->kinetic_start_J);
  }
}

}  // namespace
}  // namespace menger::voxel
