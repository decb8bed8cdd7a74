#include "voxel/statics/equilibrium.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "tests/unit/voxel/statics/static_samples.h"

namespace menger::voxel {
namespace {

using meshes::Side;

const std::vector<Side> both_ends{Side::x_min, Side::x_max};

/// Load of the tip plate on a bar of n voxels held at both ends.
PlateLoad tip_load(int n, const Vector3<double>& displacement, const Vector3<double>& rotation) {
  const StaticBody body = sample_body(meshes::bar(n), both_ends);
  Equilibrium equilibrium(body);
  EXPECT_EQ(equilibrium.load(tip_moved(displacement, rotation)), io::RunStatus::completed);
  return equilibrium.plate_load(1);
}

TEST(Equilibrium, StretchesABarByHookesLaw) {
  const double u = 0.2 * sample_edge;
  const PlateLoad load = tip_load(5, {u, 0.0, 0.0}, {});
  EXPECT_NEAR(load.force.x, sample_axial() * u / (5.0 * sample_edge), 1e-9 * sample_axial());
  EXPECT_NEAR(load.force.z, 0.0, 1e-9 * sample_axial());
}

// The chain of beams has the exact nodal stiffness of Euler-Bernoulli's bar; what is left is the tension of a bar whose ends do
// not come nearer, (u / l)^2 n^2 = 3e-7 of the force.
TEST(Equilibrium, ShearsABarBetweenPlatesThatDoNotTurn) {
  const double length = 5.0 * sample_edge;
  const double u = 1e-4 * length;
  const PlateLoad load = tip_load(5, {0.0, 0.0, u}, {});
  const double expected = 12.0 * sample_bending() * u / (length * length * length);
  EXPECT_NEAR(load.force.z, expected, 1e-5 * expected);
  EXPECT_NEAR(load.moment.y, 0.5 * expected * length, 1e-5 * expected * length);
}

TEST(Equilibrium, BendsABarAlongAnArc) {
  const double length = 6.0 * sample_edge;
  const double angle = 1e-3;
  const PlateLoad load = tip_load(6, {-length * angle * angle / 6.0, 0.0, -0.5 * length * angle}, {0.0, angle, 0.0});
  const double expected = sample_bending() * angle / length;
  // Voxels sit on the corners of a polygon, of which the arc is longer by angle^2 / 24.
  EXPECT_NEAR(load.moment.y, expected, 1e-5 * expected);
  EXPECT_NEAR(load.force.z, 0.0, 1e-4 * expected / length);
}

TEST(Equilibrium, TwistsABar) {
  const double angle = 0.3;
  const PlateLoad load = tip_load(4, {}, {angle, 0.0, 0.0});
  const double expected = sample_bending() * angle / (4.0 * sample_edge);
  EXPECT_NEAR(load.moment.x, expected, 1e-9 * expected);
}

TEST(Equilibrium, RollsACantileverUpUnderAnEndMoment) {
  const int n = 12;
  const StaticBody body = sample_body(meshes::bar(n), {Side::x_min});
  Equilibrium equilibrium(body);
  StaticLoads loads = under_pressure(0.0);
  const double angle = 0.2;  // of every beam: large angles, 2.3 rad in all
  const double moment = sample_bending() * angle / sample_edge;
  loads.points = {{static_cast<std::size_t>(n - 1), {0.0, 0.0, 0.0}, {0.0, moment, 0.0}}};
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  const Vector3<double> turn = rotation_vector(equilibrium.pose(n - 1).orientation);
  EXPECT_NEAR(turn.y, angle * (n - 0.5), 1e-8);
  // In the large-angle state a beam that is only bent keeps the length L of its chord; the half beam at the plate, bent by half
  // the angle, is in the small-angle state.
  for (std::size_t beam = 0; beam + 1 < body.beams.size(); ++beam) EXPECT_NEAR(equilibrium.axial_strain(beam), 0.0, 1e-8);
}

TEST(Equilibrium, SagsAsPointMassesOnACantilever) {
  const int n = 8;
  SurrogateParameters parameters = sample_parameters();
  parameters.density_kg_m3 = 1e-2;  // so light that it sags by 1e-5 of its length
  const StaticBody body = sample_body(meshes::bar(n), {Side::x_min}, parameters);
  Equilibrium equilibrium(body);
  StaticLoads loads = under_pressure(0.0);
  loads.gravity_m_s2 = 9.80665;
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  const double end = (n - 0.5) * sample_edge;
  double expected = 0.0;
  for (std::size_t i = 0; i < body.voxel_count(); ++i) {
    const double x = body.rest[i].position.x;
    expected -= body.mass_kg[i] * loads.gravity_m_s2 * x * x * (3.0 * end - x) / (6.0 * sample_bending());
  }
  EXPECT_NEAR(equilibrium.pose(n - 1).position.z - body.rest[n - 1].position.z, expected, 1e-6 * std::abs(expected));
}

// Point masses are the midpoint rule of a uniform load: the error is of the order of 1 / n^2 = 1e-3.
TEST(Equilibrium, SagsAsAUniformCantileverOfManyVoxels) {
  const int n = 30;
  const double length = n * sample_edge;
  const double mass = 1e-7;
  StaticBody body = sample_body(meshes::bar(n), {Side::x_min});
  body.mass_kg.assign(body.voxel_count(), mass);
  Equilibrium equilibrium(body);
  StaticLoads loads = under_pressure(0.0);
  loads.gravity_m_s2 = 9.80665;
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  const double load_per_length = mass / sample_edge * loads.gravity_m_s2;
  const double expected = -load_per_length * std::pow(length, 4) / (8.0 * sample_bending());
  const Pose& last = equilibrium.pose(n - 1);
  const double slope = -rotation_vector(last.orientation).y;
  const double tip = last.position.z - body.rest[n - 1].position.z + 0.5 * sample_edge * slope;
  EXPECT_NEAR(tip, expected, 2e-3 * std::abs(expected));
}

SurrogateParameters equilibrium_parameters() {
  SurrogateParameters parameters = sample_parameters();
  parameters.extension.fill({2e-5, 1e-5, -3e-5});
  return parameters;
}

TEST(Equilibrium, InflatesAFreeBodyByTheLawWithoutForces) {
  const meshes::Polycube cells = meshes::Polycube::from_digits(3, 2, 2, "111101100001");
  const StaticBody body = sample_body(cells, {}, equilibrium_parameters());
  Equilibrium equilibrium(body, {.fixed_voxels = {0}, .ground = false});
  for (const double pressure : {3000.0, -4000.0}) {
    ASSERT_EQ(equilibrium.load(under_pressure(pressure)), io::RunStatus::completed);
    const double extension = equilibrium_parameters().extension[0].value(pressure);
    for (std::size_t i = 0; i < body.voxel_count(); ++i) {
      const Vector3<double> at_rest = body.rest[i].position - body.rest[0].position;
      const Vector3<double> now = equilibrium.pose(i).position - equilibrium.pose(0).position;
      EXPECT_NEAR(now.x, (1.0 + extension) * at_rest.x, 1e-12);
      EXPECT_NEAR(now.y, (1.0 + extension) * at_rest.y, 1e-12);
      EXPECT_NEAR(now.z, (1.0 + extension) * at_rest.z, 1e-12);
    }
    // The voxel that is held bears nothing: holding it only fixes the rigid motion.
    EXPECT_LT(equilibrium.balance().node_loads(equilibrium.state())[0].norm(), 1e-9 * sample_axial());
  }
}

TEST(Equilibrium, PushesOnPlatesWithTheBlockedForce) {
  const StaticBody body = sample_body(meshes::bar(3), both_ends, equilibrium_parameters());
  Equilibrium equilibrium(body);
  ASSERT_EQ(equilibrium.load(under_pressure(5000.0)), io::RunStatus::completed);
  const double x = equilibrium_parameters().extension[4].value(5000.0);
  EXPECT_NEAR(equilibrium.plate_load(1).force.x, -sample_axial() * x / (1.0 + x), 1e-9 * sample_axial());
  EXPECT_NEAR(equilibrium.plate_load(0).force.x, sample_axial() * x / (1.0 + x), 1e-9 * sample_axial());
}

TEST(Equilibrium, HasAJointInSeriesBetweenChambers) {
  SurrogateParameters parameters = sample_parameters();
  parameters.joint.axial = 0.5;
  const StaticBody body(parameters, sample_voxels(meshes::Polycube::from_digits(2, 1, 1, "12"), meshes::ChamberLayout::per_phase),
                        both_ends);
  Equilibrium equilibrium(body);
  StaticLoads loads = tip_moved({0.003, 0.0, 0.0}, {});
  loads.pressures_Pa = {0.0, 0.0};
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  // Two half beams and a joint of half the stiffness: L / 2 + L / 2 + 2 L.
  EXPECT_NEAR(equilibrium.plate_load(1).force.x, sample_axial() * 0.003 / (3.0 * sample_edge), 1e-9 * sample_axial());
}

/// Coupled parameters with next to no bending, so that plates do not hinder voxels from moving along them.
SurrogateParameters coupled_parameters(double coupling) {
  SurrogateParameters parameters = sample_parameters();
  parameters.bending_Pa.fill(1e-5 * sample_modulus);
  parameters.torsion_Pa.fill(1e-5 * sample_modulus);
  parameters.lateral_coupling = coupling;
  return parameters;
}

TEST(Equilibrium, OfACoupledBodyContractsByCouplingByOnePlusCoupling) {
  const double c = 0.8;
  const double strain = 1e-4;
  const StaticBody body =
      sample_body(meshes::full_cube(3), {Side::x_min, Side::x_max, Side::y_min, Side::y_max, Side::z_min, Side::z_max},
                  coupled_parameters(c));
  const double half = 1.5 * sample_edge * strain;
  const double across = -c / (1.0 + c) * half;
  StaticLoads loads = under_pressure(0.0);
  loads.plates = {{{-half, 0.0, 0.0}, {}},  {{half, 0.0, 0.0}, {}},    {{0.0, -across, 0.0}, {}},
                  {{0.0, across, 0.0}, {}}, {{0.0, 0.0, -across}, {}}, {{0.0, 0.0, across}, {}}};
  Equilibrium equilibrium(body);
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  // What is left of the force on a side that is free to move is the bending of the half beams, 1e-5 of the stiffness, and of
  // second order in the strain.
  const double pull = 9.0 * sample_axial() * strain;
  EXPECT_NEAR(equilibrium.plate_load(1).force.x, pull * (1.0 - 2.0 * c * c / (1.0 + c)), 1e-3 * pull);
  EXPECT_NEAR(equilibrium.plate_load(3).force.y, 0.0, 1e-3 * pull);
  EXPECT_NEAR(equilibrium.plate_load(5).force.z, 0.0, 1e-3 * pull);
}

// In a bar of 2 x 2 voxels every voxel has one beam across, and half the strain there: the minimum of its energy
// e_x^2 / 2 + e^2 / 2 + c (e_x e + e^2 / 4) is at e = -c e_x / (1 + c / 2).
TEST(Equilibrium, OfACoupledBarHasTheStrainOfLeastEnergyUpToThePlates) {
  const double c = 0.6;
  const double strain = 1e-4;
  const StaticBody body = sample_body(meshes::Polycube::from_digits(3, 2, 2, "111111111111"), both_ends, coupled_parameters(c));
  Equilibrium equilibrium(body);
  ASSERT_EQ(equilibrium.load(tip_moved({3.0 * sample_edge * strain, 0.0, 0.0}, {})), io::RunStatus::completed);
  const double across = -c * strain / (1.0 + 0.5 * c);
  for (std::size_t beam = 0; beam < body.beams.size(); ++beam)
    EXPECT_NEAR(equilibrium.axial_strain(beam), body.beams[beam].axis == 0 ? strain : across, 1e-3 * strain) << beam;
  const double pull = 4.0 * sample_axial() * (strain + c * across);
  EXPECT_NEAR(equilibrium.plate_load(1).force.x, pull, 1e-3 * pull);
}

TEST(Equilibrium, BalancesPlatesWeightAndGround) {
  SurrogateParameters parameters = equilibrium_parameters();
  parameters.lateral_coupling = 0.4;
  const StaticBody body = sample_body(meshes::menger_sponge(), both_ends, parameters);
  Equilibrium equilibrium(body, {.fixed_voxels = {}, .ground = true});
  StaticLoads loads = tip_moved({0.002, 0.001, -0.002}, {0.1, -0.1, 0.05});
  loads.pressures_Pa = {2000.0};
  loads.gravity_m_s2 = 9.80665;
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  double weight = 0.0;
  for (const double mass : body.mass_kg) weight += mass * loads.gravity_m_s2;
  const Vector3<double> sum = equilibrium.plate_load(0).force + equilibrium.plate_load(1).force;
  EXPECT_GT(equilibrium.ground_force_N(), 0.0);
  EXPECT_NEAR(sum.x, 0.0, 1e-9 * sample_axial());
  EXPECT_NEAR(sum.y, 0.0, 1e-9 * sample_axial());
  EXPECT_NEAR(sum.z + equilibrium.ground_force_N(), weight, 1e-9 * sample_axial());
}

TEST(ForceBalance, OfABodyThatLeansOnTheGroundHasTheDerivativeOfItsForces) {
  const StaticBody body = sample_body(meshes::Polycube::from_digits(2, 2, 2, "11111000"), {}, equilibrium_parameters());
  ForceBalance balance(body, {.fixed_voxels = {}, .ground = true});
  ASSERT_TRUE(balance.set_loads(under_pressure(2000.0)));
  StaticState state = balance.state_at_rest();
  // Feet as deep as a tenth of an edge, turned by 0.3 about axes of their own.
  Eigen::VectorXd lean(balance.unknown_count());
  for (Eigen::Index i = 0; i < lean.size(); ++i) lean[i] = i % 6 == 2 ? -0.2 : 0.3 * std::sin(static_cast<double>(3 * i + 1));
  balance.move(state, lean);
  static_cast<void>(balance.linearise(state));
  const Eigen::MatrixXd stiffness(balance.stiffness());
  double pushed = 0.0;
  for (std::size_t voxel = 0; voxel < body.voxel_count(); ++voxel) pushed += balance.ground_force(state, voxel);
  ASSERT_GT(pushed, 0.1);
  constexpr double step = 1e-6;
  for (Eigen::Index column = 0; column < lean.size(); ++column) {
    const auto moved = [&](double by) {
      StaticState other = state;
      balance.move(other, by * Eigen::VectorXd::Unit(lean.size(), column));
      return balance.residual(other);
    };
    const Eigen::VectorXd slope = (moved(-step) - moved(step)) / (2.0 * step);
    EXPECT_LT((slope - stiffness.col(column)).norm(), 1e-7 * stiffness.norm()) << column;
  }
}

TEST(Equilibrium, StandsOnAGroundThatOnlyPushes) {
  const StaticBody body = sample_body(meshes::bar(1), {Side::z_max});
  Equilibrium equilibrium(body, {.fixed_voxels = {}, .ground = true});
  StaticLoads loads = under_pressure(0.0);
  loads.plates = {{{0.0, 0.0, -0.001}, {}}};
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  const double compliance = 1.0 / 500.0 + 0.5 * sample_edge / sample_axial();
  EXPECT_NEAR(equilibrium.ground_force_N(), 0.001 / compliance, 1e-8 * sample_axial());
  EXPECT_NEAR(equilibrium.plate_load(0).force.z, -0.001 / compliance, 1e-8 * sample_axial());
  loads.plates = {{{0.0, 0.0, 0.001}, {}}};
  ASSERT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  EXPECT_EQ(equilibrium.ground_force_N(), 0.0);
}

TEST(Equilibrium, StopsWhereALawReachesItsPole) {
  const StaticBody body = sample_body(meshes::bar(2), both_ends, equilibrium_parameters());
  Equilibrium equilibrium(body);
  EXPECT_EQ(equilibrium.load(under_pressure(1.1e5)), io::RunStatus::limit_point);  // the pole is at 1 / q = 1e5 Pa
  EXPECT_LT(equilibrium.loads().pressures_Pa[0], 1e5);
  EXPECT_TRUE(std::isfinite(equilibrium.plate_load(1).force.x));
  EXPECT_EQ(equilibrium.load(under_pressure(1000.0)), io::RunStatus::completed);
}

TEST(Equilibrium, GivesUpWithAStatusWhereABodyIsNotHeld) {
  const StaticBody body = sample_body(meshes::bar(2), {});
  Equilibrium equilibrium(body);
  StaticLoads loads = under_pressure(0.0);
  loads.gravity_m_s2 = 9.80665;
  EXPECT_EQ(equilibrium.load(loads), io::RunStatus::not_converged);
  EXPECT_TRUE(std::isfinite(equilibrium.pose(0).position.z));
}

TEST(Equilibrium, TakesALargeStepInParts) {
  const StaticBody body = sample_body(meshes::bar(3), both_ends);
  const StaticLoads far = tip_moved({-0.015, 0.0, -0.02}, {0.5, 1.2, 0.0});
  Equilibrium at_once(body);
  ASSERT_EQ(at_once.load(far), io::RunStatus::completed);
  Equilibrium in_parts(body);
  for (int i = 1; i <= 20; ++i) {
    const double share = i / 20.0;
    ASSERT_EQ(in_parts.load(tip_moved({-0.015 * share, 0.0, -0.02 * share}, {0.5 * share, 1.2 * share, 0.0})),
              io::RunStatus::completed);
  }
  // Every beam is in the large-angle state, so that the path does not matter.
  const double scale = sample_bending() / sample_edge;
  EXPECT_NEAR(at_once.plate_load(1).moment.y, in_parts.plate_load(1).moment.y, 1e-6 * scale);
  EXPECT_NEAR(at_once.plate_load(1).moment.x, in_parts.plate_load(1).moment.x, 1e-6 * scale);
}

/// Whether an equilibrium lies where it did, with its loads.
void expect_same(const Equilibrium& now, const StaticState& then, double pressure_Pa) {
  EXPECT_EQ(now.loads().pressures_Pa, std::vector<double>{pressure_Pa});
  for (std::size_t node = 0; node < then.poses.size(); ++node) {
    EXPECT_EQ(now.pose(node).position.x, then.poses[node].position.x) << node;
    EXPECT_EQ(now.pose(node).orientation.w, then.poses[node].orientation.w) << node;
  }
}

TEST(Equilibrium, StaysTheLastOneWhereATangentIsSingular) {
  const StaticBody body = sample_body(meshes::bar(3), {}, equilibrium_parameters());
  Equilibrium equilibrium(body);  // held by nothing
  const StaticState before = equilibrium.state();
  StaticLoads loads = under_pressure(100.0);
  loads.points = {{0, {1e-3, 0.0, 0.0}, {}}};
  EXPECT_EQ(equilibrium.load(loads), io::RunStatus::not_converged);
  expect_same(equilibrium, before, 0.0);
}

TEST(Equilibrium, StaysTheLastOneWhereForcesAreNotFinite) {
  const StaticBody body = sample_body(meshes::bar(3), both_ends, equilibrium_parameters());
  Equilibrium equilibrium(body);
  ASSERT_EQ(equilibrium.load(under_pressure(500.0)), io::RunStatus::completed);
  const StaticState before = equilibrium.state();
  StaticLoads loads = under_pressure(1000.0);
  loads.points = {{1, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, {}}};
  EXPECT_EQ(equilibrium.load(loads), io::RunStatus::not_converged);
  expect_same(equilibrium, before, 500.0);
  EXPECT_EQ(equilibrium.load(under_pressure(1000.0)), io::RunStatus::completed);
}

// Factors are dear: along a path of pressures a tangent serves for several steps.
TEST(Equilibrium, FactorisesFewTangents) {
  SurrogateParameters parameters = equilibrium_parameters();
  parameters.lateral_coupling = 0.4;
  const StaticBody body = sample_body(meshes::full_cube(3), {Side::z_min}, parameters);
  Equilibrium equilibrium(body);
  for (const double pressure : {500.0, 1000.0, 1500.0, 2000.0})
    ASSERT_EQ(equilibrium.load(under_pressure(pressure)), io::RunStatus::completed);
  EXPECT_GE(equilibrium.iteration_count(), 8U);
  EXPECT_LE(2 * equilibrium.factorisation_count(), equilibrium.iteration_count());
}

TEST(Equilibrium, IsTheSameBesideOthersOnThreads) {
  const auto moment_of = [](std::size_t i) {
    const double turn = 0.2 + 0.05 * static_cast<double>(i);
    return tip_load(4, {-0.01, 0.0, -0.01}, {0.1, turn, 0.0}).moment.y;
  };
  constexpr std::size_t count = 8;
  std::array<double, count> side_by_side{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back([&, i] { side_by_side[i] = moment_of(i); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(side_by_side[i], moment_of(i)) << i;
}

}  // namespace
}  // namespace menger::voxel
