#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fem/modes/vibration.h"
#include "materials/laws/homogeneous_deformations.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

constexpr double mu_Pa = 100e3;
constexpr double kappa_Pa = 1e9;
constexpr double density = 1070.0;
constexpr double young_Pa = 9.0 * kappa_Pa * mu_Pa / (3.0 * kappa_Pa + mu_Pa);
constexpr double pi = std::numbers::pi;

Body silicone() {
  Body body;
  body.regions = {{materials::NeoHookean{mu_Pa}, materials::SimoTaylorVolume{kappa_Pa}, density}};
  return body;
}

/// Timoshenko's beam of square section, vibrating at an angular frequency: what the state (w, psi, M, Q) at one end becomes at
/// the other. w' = psi + Q/(k G A), psi' = M/(E I), M' = -Q - rho I omega^2 psi, Q' = -rho A omega^2 w.
class Timoshenko {
 public:
  Timoshenko(double length_m, double side_m) : length_m_(length_m), side_m_(side_m) {}

  /// Lowest frequency in an interval at which the motion fits the ends, by bisection.
  [[nodiscard]] double free_free_Hz(double low_Hz, double high_Hz) const {
    return root(low_Hz, high_Hz, [](const Eigen::Matrix4d& T) { return T.block<2, 2>(2, 0).determinant(); });
  }
  [[nodiscard]] double cantilever_Hz(double low_Hz, double high_Hz) const {
    return root(low_Hz, high_Hz, [](const Eigen::Matrix4d& T) { return T.block<2, 2>(2, 2).determinant(); });
  }

 private:
  [[nodiscard]] Eigen::Matrix4d transfer(double frequency_Hz) const {
    const double area = side_m_ * side_m_;
    const double inertia = area * area / 12.0;
    const double poisson = 0.5 - young_Pa / (6.0 * kappa_Pa);
    const double shear_factor = 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
    const double omega2 = std::pow(2.0 * pi * frequency_Hz, 2);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 1) = 1.0;
    A(0, 3) = 1.0 / (shear_factor * mu_Pa * area);
    A(1, 2) = 1.0 / (young_Pa * inertia);
    A(2, 1) = -density * inertia * omega2;
    A(2, 3) = -1.0;
    A(3, 0) = -density * area * omega2;
    // exp(A l) by many steps of its series to fourth order, whose error is far below the tolerances
    constexpr int steps = 1024;
    const Eigen::Matrix4d B = A * (length_m_ / steps);
    const Eigen::Matrix4d one = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d T = one + B * (one + B / 2.0 * (one + B / 3.0 * (one + B / 4.0)));
    for (int n = 1; n < steps; n *= 2) T = T * T;
    return T;
  }

  template <class Mismatch>
  [[nodiscard]] double root(double low, double high, const Mismatch& mismatch) const {
    const bool is_positive = mismatch(transfer(low)) > 0.0;
    EXPECT_NE(is_positive, mismatch(transfer(high)) > 0.0);
    while (high - low > 1e-9 * high) {
      const double middle = 0.5 * (low + high);
      (mismatch(transfer(middle)) > 0.0) == is_positive ? low = middle : high = middle;
    }
    return 0.5 * (low + high);
  }

  double length_m_;
  double side_m_;
};

/// beta^2 / (2 pi) sqrt(E I / rho A) of Euler and Bernoulli for a square section, beta l given.
double euler_bernoulli_Hz(double beta_l, double length_m, double side_m) {
  return beta_l * beta_l / (2.0 * pi * length_m * length_m) * side_m * std::sqrt(young_Pa / (12.0 * density));
}

VibrationReport beam_vibrations(double length_m, double side_m, bool is_clamped) {
  const Space space = make_space(meshes::box({length_m, side_m, side_m}, {40, 2, 2}), 2, 0, MPI_COMM_SELF);
  Body body = silicone();
  if (is_clamped) body.supports = {{x_min, {true, true, true}}};
  Equilibrium equilibrium(space, body, {});
  return vibrations(equilibrium, equilibrium.rest(), 1.0, {.mode_count = 4});
}

// A free beam has no supports to spoil the comparison. Timoshenko's theory errs by the square of (side / wave length), here of
// about 1/30 and 1/15 in the two lowest pairs of modes, with a small factor: 2e-3 holds both.
TEST(BeamVibration, OfAFreeBeamIsTimoshenkos) {
  constexpr double length_m = 0.2;
  constexpr double side_m = 0.01;
  const VibrationReport report = beam_vibrations(length_m, side_m, false);
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 6);
  const Timoshenko theory(length_m, side_m);
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const double simple_Hz = euler_bernoulli_Hz(mode == 0 ? 4.730041 : 7.853205, length_m, side_m);
    const double expected_Hz = theory.free_free_Hz(0.8 * simple_Hz, 1.05 * simple_Hz);
    for (const std::size_t direction : {0UL, 1UL})  // the two planes of bending
      EXPECT_NEAR(report.frequencies_Hz[2 * mode + direction], expected_Hz, 2e-3 * expected_Hz);
  }
}

// A clamp that also hinders the contraction of its section makes the beam shorter by a part of its side, some 0.1; frequencies go
// with 1/length^2: 2 x 0.1 / 20 = 1 %, upwards.
TEST(BeamVibration, OfACantileverIsTimoshenkosButForItsClamp) {
  constexpr double length_m = 0.2;
  constexpr double side_m = 0.01;
  const VibrationReport report = beam_vibrations(length_m, side_m, true);
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 0);
  const Timoshenko theory(length_m, side_m);
  for (std::size_t mode = 0; mode < 2; ++mode) {
    const double simple_Hz = euler_bernoulli_Hz(mode == 0 ? 1.875104 : 4.694091, length_m, side_m);
    const double expected_Hz = theory.cantilever_Hz(0.8 * simple_Hz, 1.05 * simple_Hz);
    for (const std::size_t direction : {0UL, 1UL}) {
      EXPECT_GT(report.frequencies_Hz[2 * mode + direction], expected_Hz);
      EXPECT_LT(report.frequencies_Hz[2 * mode + direction], 1.015 * expected_Hz);
    }
  }
}

// A bar pulled to twice its length, its ends free to slide and to turn but not to move aside, vibrates across as a string of
// tension N = A P and mass rho A per reference length, mode n with n/(2 l) sqrt(N l/m). Its stiffness against bending and the
// inertia of turning sections change the square of that by about (n pi)^2 E I/(N l^2) = 1e-4 n^2, the tangent modulus of the
// pulled bar being E = 5 mu. Along, it is a bar with free ends and the tangent dP/dlambda: sqrt(P'/rho)/(2 l0), less 1/2 (nu pi
// k/l)^2 = 1e-4 for the inertia of its contraction; compression of the volume, left out of P, adds mu/kappa = 1e-4. In the list
// of modes torsion stands between the two.
TEST(BeamVibration, OfAStretchedBarIsThatOfAString) {
  constexpr double length_m = 0.2;
  constexpr double side_m = 0.005;
  constexpr double stretch = 2.0;
  const double nominal_Pa = mu_Pa * (stretch - std::pow(stretch, -2));
  const Space space = make_space(meshes::box({length_m, side_m, side_m}, {40, 1, 1}), 2, 0, MPI_COMM_SELF);
  Body pulled = silicone();
  pulled.supports = {{x_min, {true, false, false}}, {y_min, {false, true, false}}, {z_min, {false, false, true}}};
  pulled.tractions = {{x_max, {nominal_Pa, 0.0, 0.0}}};
  Equilibrium pulling(space, pulled, {});
  BodyState state = pulling.rest();
  for (const double factor : {0.3, 0.6, 1.0}) {
    const EquilibriumReport report = pulling.solve(state, {}, factor);
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  }

  Body hinged = silicone();
  hinged.supports = {{x_min, {false, true, true}}, {x_max, {false, true, true}}};
  Equilibrium vibrating(space, hinged, {});
  const VibrationReport report = vibrations(vibrating, state, 1.0, {.mode_count = 6});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 1);  // along the string

  const double string_Hz = std::sqrt(nominal_Pa / (density * stretch)) / (2.0 * length_m);
  ASSERT_EQ(report.frequencies_Hz.size(), 6U);
  for (const std::size_t direction : {0UL, 1UL}) {
    EXPECT_NEAR(report.frequencies_Hz[direction], string_Hz, 2e-4 * string_Hz);
    EXPECT_NEAR(report.frequencies_Hz[4 + direction], 2.0 * string_Hz, 8e-4 * string_Hz);
  }
  const double tangent_Pa = mu_Pa * (1.0 + 2.0 * std::pow(stretch, -3));
  const double along_Hz = std::sqrt(tangent_Pa / density) / (2.0 * length_m);
  EXPECT_NEAR(report.frequencies_Hz[3], along_Hz, 5e-4 * along_Hz);
}

}  // namespace
}  // namespace menger::fem
