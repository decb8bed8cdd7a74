// Vibrations of bodies with a Maxwell branch, against the standard linear solid.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "fem/explicit/material_damping.h"
#include "tests/unit/fem/explicit/explicit_samples.h"

namespace menger::fem {
namespace {

using Complex = std::complex<double>;
constexpr double half_turn = std::numbers::pi;
constexpr double column_density = 1070.0;
constexpr double modulus = 50e3;

/// A column that shears: all nodes move along x alone, by the same amount at the same height. Its lowest mode is u = cos(pi y /
/// L); of `count` elements it has the wave number K, K^2 = 4 / h^2 sin^2(pi h / (2 L)), for lumped masses.
struct Column {
  static constexpr double length = 20e-3;
  static constexpr std::size_t count = 20;
  meshes::HexahedralMesh mesh = meshes::box({1e-3, length, 1e-3}, {1, count, 1});
  ExplicitBody body;

  explicit Column(const std::vector<MaxwellBranch>& branches) : body(mesh, options_of(mesh, branches)) {}

  static ExplicitBodyOptions options_of(const meshes::HexahedralMesh& mesh, const std::vector<MaxwellBranch>& branches) {
    ExplicitBodyOptions options = silicone_options(mesh);
    options.regions[0].material.branches = branches;
    for (const char* label : {"x min", "x max"})
      options.supports.push_back({meshes::label_index(mesh, label), {false, true, true}});
    return options;
  }

  static double wave_number_square() {
    const double h = length / count;
    const double half = std::sin(0.5 * half_turn * h / length) / h;
    return 4.0 * half * half;
  }
};

/// The amplitude u of a mode that is let go with its branches at rest: u' = v, density v' = -K^2 (mu u + sum m (u - q)), q' = (u
/// - q) / tau, from u = q = 1 and v = 0. It is a sum of exponentials, of the eigenvalues of this system.
class FreeDecay {
 public:
  explicit FreeDecay(const std::vector<MaxwellBranch>& branches) {
    const double square = Column::wave_number_square() / column_density;
    const auto size = static_cast<Eigen::Index>(2 + branches.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(size, size);
    system(0, 1) = 1.0;
    system(1, 0) = -square * modulus;
    Eigen::Index q = 2;
    for (const MaxwellBranch& branch : branches) {
      system(1, 0) -= square * branch.shear_modulus_Pa;
      system(1, q) = square * branch.shear_modulus_Pa;
      system(q, 0) = 1.0 / branch.relaxation_time_s;
      system(q, q) = -1.0 / branch.relaxation_time_s;
      ++q;
    }
    Eigen::VectorXcd start = Eigen::VectorXcd::Ones(size);
    start(1) = 0.0;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(system);
    roots_ = solver.eigenvalues();
    shares_ = solver.eigenvectors().row(0).transpose().cwiseProduct(solver.eigenvectors().fullPivLu().solve(start));
  }

  [[nodiscard]] double at(double time_s) const { return (shares_.array() * (roots_ * time_s).array().exp()).sum().real(); }
  [[nodiscard]] double period_s() const { return 2.0 * half_turn / roots_.imag().maxCoeff(); }

 private:
  Eigen::VectorXcd roots_;
  Eigen::VectorXcd shares_;
};

// Simple shear is linear in both laws, so that the motion is that of three exponentials at any amplitude. Branches that response
// faster than, as fast as, and slower than the mode, over five of its periods at 171 Hz. Tensors that relax every 0.08 of
// their time, for the middle of it, are wrong by the square of that, as far as the branch has a say: below 1e-3 of the amplitude.
// Three branches of these, which the slowest must follow, too.
TEST(MaxwellBranch, ShearModeDecaysAsTheStandardLinearSolid) {
  const double angular_frequency = std::sqrt(Column::wave_number_square() * modulus / column_density);
  std::vector<std::vector<MaxwellBranch>> cases;
  std::vector<MaxwellBranch> all;
  for (const double number : {0.2, 1.0, 5.0}) {
    cases.push_back({{.shear_modulus_Pa = 15e3, .relaxation_time_s = number / angular_frequency}});
    all.push_back({.shear_modulus_Pa = 8e3, .relaxation_time_s = number / angular_frequency});
  }
  cases.push_back(all);
  for (const std::vector<MaxwellBranch>& branches : cases) {
    const double number = static_cast<double>(branches.size()) + branches.front().relaxation_time_s * angular_frequency;
    const FreeDecay wanted(branches);
    const Column column(branches);
    ExplicitOptions options;
    options.largest_step_s = 0.04 * branches.front().relaxation_time_s;
    ExplicitDynamics dynamics(column.mesh, column.body, options);
    ExplicitState state = dynamics.state();
    state.at_start_J.reset();
    state.branches.reset();
    constexpr double amplitude = 2e-3;
    for (std::size_t n = 0; n < column.mesh.points.size(); ++n)
      state.displacements_m[3 * n] = amplitude * std::cos(half_turn * column.mesh.points[n][1] / Column::length);
    dynamics.set_state(state);
    const std::size_t end = 3 * node_at(column.mesh, {0.0, 0.0, 0.0});
    double worst = 0.0;
    double worst_balance = 0.0;
    for (int n = 1; n <= 100; ++n) {
      const double time = 0.05 * n * wanted.period_s();
      ASSERT_EQ(dynamics.advance_to(time).status, io::RunStatus::completed);
      worst = std::max(worst, std::abs(dynamics.state().displacements_m[end] / amplitude - wanted.at(time)));
      const MotionEnergies energies = dynamics.energies();
      worst_balance = std::max(worst_balance, std::abs(energies.imbalance_J()) / energies.at_start_J);
    }
    EXPECT_LT(worst, 1e-3) << number;
    EXPECT_LT(worst_balance, 1e-3) << number;
    EXPECT_LT(wanted.at(5.0 * wanted.period_s()), 0.9) << "it does decay";
  }
}

// The hollow cube breathes under a pressure of 20 Hz, as its elastic and viscous kin do: the energy balance closes to a
// thousandth of the largest work, and what the branch lost is a part of it.
TEST(MaxwellBranch, EnergyIsBalancedOverACycle) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  ExplicitBodyOptions of_body = silicone_options(mesh);
  for (ExplicitRegion& region : of_body.regions)
    region.material.branches = {maxwell_branch(modulus, {.source = "test", .tan_delta = 0.1, .frequency_Hz = 30.0})};
  of_body.supports = {{meshes::label_index(mesh, "ground"), {false, false, true}}};
  of_body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{20e-3, 0.0, 0.0}, {false, true, false}}};
  const ExplicitBody body(mesh, of_body);
  ExplicitOptions options;
  options.schedules = {{SinePressure{.low_Pa = 0.0, .high_Pa = 4e3, .frequency_Hz = 20.0}, 0.0}};
  ExplicitDynamics dynamics(mesh, body, options);
  double largest = 0.0;
  double worst = 0.0;
  double lost = 0.0;
  for (int n = 1; n <= 20; ++n) {
    ASSERT_EQ(dynamics.advance_to(0.0025 * n).status, io::RunStatus::completed);
    const MotionEnergies energies = dynamics.energies();
    largest = std::max(largest, energies.work.pressure_J);
    worst = std::max(worst, std::abs(energies.imbalance_J()));
    EXPECT_GE(energies.work.viscous_J, lost);
    lost = energies.work.viscous_J;
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(worst, 1e-3 * largest);
  EXPECT_GT(lost, 0.01 * largest);
}

// A tumbling body that has come to rest in its shape loses nothing any more, but momentum is kept all the time.
TEST(MaxwellBranch, FreeFlightKeepsMomentum) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  ExplicitBodyOptions of_body = silicone_options(mesh);
  for (ExplicitRegion& region : of_body.regions)
    region.material.branches = {{.shear_modulus_Pa = 50e3, .relaxation_time_s = 2e-3}};
  const ExplicitBody body(mesh, of_body);
  ExplicitDynamics dynamics(mesh, body, {});
  ExplicitState state = dynamics.state();
  state.at_start_J.reset();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point arm = difference(mesh.points[n], {0.01, 0.01, 0.01});
    const Point v = sum(Point{0.5, -0.2, 0.1}, sum(cross({20.0, -10.0, 30.0}, arm), Point{15.0 * arm[0], -20.0 * arm[1], 0.0}));
    for (std::size_t i = 0; i < 3; ++i) state.velocities_m_per_s[3 * n + i] = v[i];
  }
  dynamics.set_state(state);
  const Motion before = motion_of(dynamics);
  ASSERT_EQ(dynamics.advance_to(0.05).status, io::RunStatus::completed);
  const Motion after = motion_of(dynamics);
  EXPECT_LT(norm(difference(after.momentum, before.momentum)), 1e-11 * before.size);  // rounding, as without a branch
  EXPECT_LT(norm(difference(after.angular, before.angular)), 1e-5 * norm(before.angular));
  const double lost = dynamics.energies().work.viscous_J;
  EXPECT_GT(lost, 0.0);
  ASSERT_EQ(dynamics.advance_to(0.1).status, io::RunStatus::completed);
  EXPECT_LT(dynamics.energies().work.viscous_J - lost, 0.1 * lost);
}

}  // namespace
}  // namespace menger::fem
