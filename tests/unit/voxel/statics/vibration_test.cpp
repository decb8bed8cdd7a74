#include "voxel/statics/vibration.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "tests/unit/voxel/statics/static_samples.h"

namespace menger::voxel {
namespace {

using meshes::Side;

/// A body at rest whose voxels all have the mass and the moment of inertia that are given.
StaticBody body_of_equal_masses(const meshes::Polycube& cells, const std::vector<Side>& plates, double mass, double inertia,
                                const SurrogateParameters& parameters = sample_parameters()) {
  StaticBody body = sample_body(cells, plates, parameters);
  body.mass_kg.assign(body.voxel_count(), mass);
  body.inertia_kg_m2.assign(body.voxel_count(), inertia);
  return body;
}

// A chain of equal masses and springs, its first spring of half the length: u_j = sin((2 k - 1) pi (j - 1/2) / (2 n)).
TEST(NaturalVibrations, OfARodAreThoseOfAChainOfMasses) {
  const int n = 6;
  const double mass = 1e-3;
  SurrogateParameters parameters = sample_parameters();
  parameters.bending_Pa.fill(1e4 * sample_modulus);
  parameters.torsion_Pa.fill(1e4 * sample_modulus);
  const StaticBody body = body_of_equal_masses(meshes::bar(n), {Side::x_min}, mass, 1e-9, parameters);
  const Equilibrium equilibrium(body);
  const Vibrations vibrations = natural_vibrations(small_motion(equilibrium), 3);
  ASSERT_EQ(vibrations.frequencies_Hz.size(), 3U);
  const double base = std::sqrt(sample_axial() / (sample_edge * mass)) / std::numbers::pi;
  for (int k = 1; k <= 3; ++k) {
    const double expected = base * std::sin((2 * k - 1) * std::numbers::pi / (4 * n));
    EXPECT_NEAR(vibrations.frequencies_Hz[static_cast<std::size_t>(k - 1)], expected, 1e-7 * expected) << k;
  }
  EXPECT_EQ(vibrations.unstable_count, 0U);
  EXPECT_EQ(small_motion(equilibrium).rigid.cols(), 0);
}

// The lumped masses are a midpoint rule, exact up to 1 / n^2, and so small a moment of inertia is no rotary inertia.
TEST(NaturalVibrations, OfACantileverAreThoseOfEulerAndBernoulli) {
  const int n = 40;
  const double mass = 1e-3;
  const StaticBody body = body_of_equal_masses(meshes::bar(n), {Side::x_min}, mass, 1e-3 * mass * sample_edge * sample_edge);
  const Equilibrium equilibrium(body);
  const Vibrations vibrations = natural_vibrations(small_motion(equilibrium), 4, WithModes::yes);
  const double length = n * sample_edge;
  const double base = std::sqrt(sample_bending() / (mass / sample_edge * std::pow(length, 4))) / (2.0 * std::numbers::pi);
  ASSERT_EQ(vibrations.frequencies_Hz.size(), 4U);
  // Bending about y and about z: pairs.
  for (const std::size_t i : {0U, 1U})
    EXPECT_NEAR(vibrations.frequencies_Hz[i], 1.8751041 * 1.8751041 * base, 1e-3 * base * 3.516);
  for (const std::size_t i : {2U, 3U})
    EXPECT_NEAR(vibrations.frequencies_Hz[i], 4.6940911 * 4.6940911 * base, 1e-2 * base * 22.03);
  const SmallMotion motion = small_motion(equilibrium);
  const Eigen::MatrixXd gram = vibrations.modes.transpose() * motion.mass.asDiagonal() * vibrations.modes;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(4, 4)).norm(), 1e-9);
}

TEST(NaturalVibrations, OfAFreeBodyHaveSixRigidMotions) {
  SurrogateParameters parameters = sample_parameters();
  parameters.extension.fill({2e-5, 0.0, 0.0});
  parameters.lateral_coupling = 0.5;
  const StaticBody body = sample_body(meshes::Polycube::from_digits(2, 2, 2, "11110011"), {}, parameters);
  Equilibrium equilibrium(body, {.fixed_voxels = {0}, .ground = false});
  ASSERT_EQ(equilibrium.load(under_pressure(5000.0)), io::RunStatus::completed);
  const SmallMotion motion = small_motion(equilibrium);
  ASSERT_EQ(motion.rigid.cols(), 6);
  const Eigen::MatrixXd gram = motion.rigid.transpose() * motion.mass.asDiagonal() * motion.rigid;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-12);
  const Vibrations vibrations = natural_vibrations(motion, 1000, WithModes::yes);
  EXPECT_EQ(vibrations.unstable_count, 0U);
  EXPECT_EQ(vibrations.frequencies_Hz.size(), 6 * body.voxel_count() - 6);
  EXPECT_LT((vibrations.modes.transpose() * motion.mass.asDiagonal() * motion.rigid).norm(), 1e-9);
  EXPECT_EQ(small_motion(equilibrium, {.fixed_voxels = {0}, .ground = false}).rigid.cols(), 0);
}

TEST(NaturalVibrations, FindABarBeyondEulersLoadUnstable) {
  const int n = 10;
  const StaticBody body = sample_body(meshes::bar(n), {Side::x_min, Side::x_max});
  const double critical = 4.0 * std::numbers::pi * std::numbers::pi / (12.0 * n * n);  // strain of a bar clamped at both ends
  const auto unstable = [&body](double strain) {
    Equilibrium equilibrium(body);
    EXPECT_EQ(equilibrium.load(tip_moved({-n * sample_edge * strain, 0.0, 0.0}, {})), io::RunStatus::completed);
    return natural_vibrations(small_motion(equilibrium), 1).unstable_count;
  };
  // The polygon of the voxels buckles within 1 / n of the smooth bar.
  EXPECT_EQ(unstable(0.8 * critical), 0U);
  EXPECT_EQ(unstable(1.3 * critical), 2U);  // to both sides
}

TEST(SmallMotion, AnswersToPressureAsEquilibriaDo) {
  SurrogateParameters parameters = sample_parameters();
  parameters.extension.fill({2e-5, 1e-5, -1e-5});
  const StaticBody body = sample_body(meshes::Polycube::from_digits(3, 1, 2, "111101"), {Side::x_min}, parameters);
  Equilibrium equilibrium(body);
  ASSERT_EQ(equilibrium.load(under_pressure(1000.0)), io::RunStatus::completed);
  const SmallMotion motion = small_motion(equilibrium);
  const Eigen::VectorXd response = motion.stiffness.ldlt().solve(motion.pressure_load);
  const std::size_t tip = body.voxel_count() - 1;
  const auto at = equilibrium.balance().first_unknown(tip);
  ASSERT_TRUE(at.has_value());
  const auto place = [&](double pressure) {
    EXPECT_EQ(equilibrium.load(under_pressure(pressure)), io::RunStatus::completed);
    return equilibrium.pose(tip).position;
  };
  const double step = 1.0;
  const Vector3<double> slope = (1.0 / (2.0 * step)) * (place(1000.0 + step) - place(1000.0 - step));
  // 1e-3: the antisymmetric part of the stiffness is left out of the response.
  EXPECT_NEAR(response(*at), slope.x, 1e-3 * slope.x);
  EXPECT_NEAR(response(*at + 2), slope.z, 1e-3 * slope.x);
}

TEST(SmallMotion, IsSymmetricAtRestAndNearlySoUnderLoad) {
  const StaticBody body = sample_body(meshes::full_cube(3), {Side::x_min, Side::x_max});
  Equilibrium equilibrium(body);
  EXPECT_LT(small_motion(equilibrium).asymmetry, 1e-8);
  const double strain = 0.1;
  ASSERT_EQ(equilibrium.load(tip_moved({0.03 * strain, 0.0, 0.0}, {})), io::RunStatus::completed);
  EXPECT_LT(small_motion(equilibrium).asymmetry, strain);
}

}  // namespace
}  // namespace menger::voxel
