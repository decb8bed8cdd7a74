#include "fem/modes/vibration.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/modes/frequency_response.h"
#include "fem/modes/mass_matrix.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

constexpr double shear_modulus_Pa = 50e3;
constexpr double bulk_modulus_Pa = 2.5e6;
constexpr double density = 1000.0;

Body solid_body() {
  Body body;
  body.regions = {{materials::NeoHookean{shear_modulus_Pa}, materials::SimoTaylorVolume{bulk_modulus_Pa}, density}};
  return body;
}

Eigen::MatrixXd dense(Mat matrix) {
  MatrixHandle full;
  petsc(MatConvert(matrix, MATSEQDENSE, MAT_INITIAL_MATRIX, full.receive()));
  PetscInt rows = 0;
  petsc(MatGetSize(full, &rows, nullptr));
  Eigen::MatrixXd copy(rows, rows);
  const double* data = nullptr;
  petsc(MatDenseGetArrayRead(full, &data));
  std::copy_n(data, rows * rows, copy.data());
  petsc(MatDenseRestoreArrayRead(full, &data));
  return copy;
}

Eigen::VectorXd eigen(std::span<const double> field) {
  return Eigen::Map<const Eigen::VectorXd>(field.data(), static_cast<Eigen::Index>(field.size()));
}

/// Frequencies of the components that are not held, by a dense solver.
std::vector<double> dense_frequencies_Hz(const LinearisedBody& body) {
  const Eigen::MatrixXd K = dense(body.stiffness());
  const Eigen::MatrixXd M = dense(body.mass());
  std::vector<Eigen::Index> moving;
  for (std::size_t n = 0; n < body.assembly().held().size(); ++n)
    if (body.assembly().held()[n] == 0) moving.push_back(static_cast<Eigen::Index>(n));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pairs(K(moving, moving), M(moving, moving));
  std::vector<double> frequencies;
  for (const double eigenvalue : pairs.eigenvalues())
    frequencies.push_back(std::sqrt(std::max(0.0, eigenvalue)) / (2.0 * std::numbers::pi));
  return frequencies;
}

// Exact on cubes: the sums of rows and columns are rho V, to rounding.
TEST(MassMatrix, SumsToTheMassInEachDirectionAndCouplesNone) {
  constexpr double mass_kg = density * (512.0 - 64.0) / 4.0 * 1e-9;
  for (const int degree : {1, 2}) {
    const Space space = make_space(hollow_cube_quarter(), degree, 0, MPI_COMM_SELF);
    const Body body = solid_body();
    const Assembly assembly(space, body);
    const MatrixHandle mass = assembly.make_matrix(true);
    assemble_mass(assembly, body, mass);
    const Eigen::MatrixXd M = dense(mass);
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        double sum = 0.0;
        for (Eigen::Index a = i; a < M.rows(); a += 3)
          for (Eigen::Index b = j; b < M.cols(); b += 3) sum += M(a, b);
        EXPECT_NEAR(sum, i == j ? mass_kg : 0.0, 1e-12 * mass_kg);
      }
    }
    EXPECT_NEAR(mass_of(space, body), mass_kg, 1e-12 * mass_kg);
  }
}

TEST(MassMatrix, HasNothingInHeldRows) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  const Assembly assembly(space, body);
  const MatrixHandle mass = assembly.make_matrix(true);
  assemble_mass(assembly, body, mass);
  const Eigen::MatrixXd M = dense(mass);
  for (Eigen::Index n = 0; n < M.rows(); ++n) {
    const bool is_held = assembly.held()[static_cast<std::size_t>(n)] != 0;
    EXPECT_EQ(M.row(n).isZero(0.0), is_held);
  }
}

/// A rod along x whose lateral motion is held: plane waves of the speed sqrt((kappa + 4/3 mu)/rho). It is so thin that sections
/// that warp, with half a shear wave across, vibrate much faster.
class HeldRod {
 public:
  static constexpr double length_m = 0.1;
  static double wave_speed() { return std::sqrt((bulk_modulus_Pa + 4.0 / 3.0 * shear_modulus_Pa) / density); }
  /// Angular wave number of mode n = 1, 2, ... of the rod held at one end.
  static double wave_number(int n) { return (n - 0.5) * std::numbers::pi / length_m; }

  static std::vector<double> frequencies_Hz(int degree, std::size_t elements, int count) {
    const double side = 0.001;
    const Space space = make_space(meshes::box({length_m, side, side}, {elements, 1, 1}), degree, 0, MPI_COMM_SELF);
    Body body = solid_body();
    body.supports = {{x_min, {true, true, true}},
                     {y_min, {false, true, true}},
                     {y_max, {false, true, true}},
                     {z_min, {false, true, true}},
                     {z_max, {false, true, true}}};
    Equilibrium equilibrium(space, body, {});
    return vibrations(equilibrium, equilibrium.rest(), 1.0, {.mode_count = count}).frequencies_Hz;
  }
};

// Linear elements with consistent mass have a dispersion relation in closed form; 1e-7 is what the solver leaves of the square.
TEST(Vibration, OfARodOfLinearElementsHasTheirDispersion) {
  constexpr std::size_t elements = 8;
  const std::vector<double> frequencies = HeldRod::frequencies_Hz(1, elements, 3);
  ASSERT_EQ(frequencies.size(), 3U);
  for (int n = 1; n <= 3; ++n) {
    const double h = HeldRod::length_m / elements;
    const double cosine = std::cos(HeldRod::wave_number(n) * h);
    const double omega = HeldRod::wave_speed() / h * std::sqrt(6.0 * (1.0 - cosine) / (2.0 + cosine));
    EXPECT_NEAR(frequencies[static_cast<std::size_t>(n) - 1], omega / (2.0 * std::numbers::pi), 1e-7 * omega);
  }
}

// Frequencies converge with twice the degree; the observed order of the third mode on 8 and 16 elements misses it by the next
// term, of relative size (k h)^2.
TEST(Vibration, ConvergesWithTwiceTheDegree) {
  const double exact = HeldRod::wave_speed() * HeldRod::wave_number(3) / (2.0 * std::numbers::pi);
  for (const int degree : {1, 2}) {
    const double coarse = HeldRod::frequencies_Hz(degree, 8, 3).at(2) / exact - 1.0;
    const double fine = HeldRod::frequencies_Hz(degree, 16, 3).at(2) / exact - 1.0;
    EXPECT_GT(fine, 0.0);  // Rayleigh's quotient over fewer motions is larger
    EXPECT_NEAR(std::log2(coarse / fine), 2.0 * degree, 0.1);
  }
}

// All of the spectrum of a small body, which no held component joins.
TEST(Vibration, OfOneElementAgreesWithADenseSolver) {
  const Space space = make_space(meshes::box({0.01, 0.012, 0.015}, {1, 1, 1}), 1, 0, MPI_COMM_SELF);
  Body body = solid_body();
  body.supports = {{x_min, {true, true, true}}};
  Equilibrium equilibrium(space, body, {});
  LinearisedBody linearised(equilibrium, equilibrium.rest());
  const VibrationReport report = vibrations(linearised, {.mode_count = 50});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 0);
  const std::vector<double> expected = dense_frequencies_Hz(linearised);
  ASSERT_EQ(report.frequencies_Hz.size(), 12U);
  for (std::size_t n = 0; n < 12; ++n) EXPECT_NEAR(report.frequencies_Hz[n], expected[n], 1e-8 * expected[n]);
}

// Equal frequencies come as often as they occur, rigid motions not at all.
TEST(Vibration, OfAFreeCubeHasEveryFrequencyOfADenseSolverButSixRigidMotions) {
  const Space space = make_space(meshes::box({0.01, 0.01, 0.01}, {2, 2, 2}), 1, 0, MPI_COMM_SELF);
  const Body body = solid_body();
  Equilibrium equilibrium(space, body, {});
  LinearisedBody linearised(equilibrium, equilibrium.rest());
  const VibrationReport report = vibrations(linearised, {.mode_count = 20});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 6);
  ASSERT_EQ(report.frequencies_Hz.size(), 20U);
  const std::vector<double> expected = dense_frequencies_Hz(linearised);
  for (std::size_t n = 0; n < 20; ++n) EXPECT_NEAR(report.frequencies_Hz[n], expected[n + 6], 1e-8 * expected[n + 6]);
}

TEST(Vibration, ModesAreOrthonormalInTheMassAndSolveTheirEquation) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  Equilibrium equilibrium(space, body, {});
  LinearisedBody linearised(equilibrium, equilibrium.rest());
  const VibrationReport report = vibrations(linearised, {.mode_count = 8});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  const Eigen::MatrixXd K = dense(linearised.stiffness());
  const Eigen::MatrixXd M = dense(linearised.mass());
  for (std::size_t a = 0; a < report.modes.size(); ++a) {
    const Eigen::VectorXd x = eigen(report.modes[a]);
    const double omega = 2.0 * std::numbers::pi * report.frequencies_Hz[a];
    EXPECT_LT((K * x - omega * omega * (M * x)).norm(), 1e-7 * (K * x).norm());
    EXPECT_GT(x.maxCoeff(), (1.0 - 1e-5) * -x.minCoeff());
    for (std::size_t b = 0; b <= a; ++b) EXPECT_NEAR(x.dot(M * eigen(report.modes[b])), a == b ? 1.0 : 0.0, 1e-7);
    for (std::size_t n = 0; n < report.modes[a].size(); ++n) {
      const double held_part = linearised.assembly().held()[n] != 0 ? x[static_cast<Eigen::Index>(n)] : 0.0;
      EXPECT_LT(std::abs(held_part), 1e-9 * x.maxCoeff());
    }
  }
}

/// A proper rotation that no axis of a mesh keeps.
Point turned(const Point& x) {
  const Eigen::Vector3d y = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()) * Eigen::Vector3d(x.data());
  return {y[0], y[1], y[2]};
}

// A body turned as mesh, or turned in space from its rest, vibrates alike. 1e-7: rounding of a stiffness whose largest eigenvalue
// is some 1e5 of the least.
TEST(Vibration, DoesNotChangeUnderRotation) {
  const auto of_mesh = [](const meshes::HexahedralMesh& mesh, bool turns_state) {
    const Space space = make_space(mesh, 2, 0, MPI_COMM_SELF);
    const Body body = solid_body();
    Equilibrium equilibrium(space, body, {});
    BodyState state = equilibrium.rest();
    for (std::size_t a = 0; turns_state && a < space.positions.size(); ++a) {
      const Point moved = difference(turned(space.positions[a]), space.positions[a]);
      std::copy(moved.begin(), moved.end(), state.displacements_m.begin() + static_cast<std::ptrdiff_t>(3 * a));
    }
    return vibrations(equilibrium, state, 1.0, {.mode_count = 5});
  };
  const meshes::HexahedralMesh upright = meshes::box({0.01, 0.013, 0.017}, {2, 2, 2});
  meshes::HexahedralMesh tilted = upright;
  for (auto& point : tilted.points) point = turned(point);
  const VibrationReport reference = of_mesh(upright, false);
  ASSERT_EQ(reference.status, io::RunStatus::completed) << reference.reason;
  for (const VibrationReport& report : {of_mesh(tilted, false), of_mesh(upright, true)}) {
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    EXPECT_EQ(report.rigid_modes, 6);
    for (std::size_t n = 0; n < 5; ++n)
      EXPECT_NEAR(report.frequencies_Hz[n], reference.frequencies_Hz[n], 1e-7 * reference.frequencies_Hz[n]);
  }
}

/// A free hollow cube under pressure: six components of three of its nodes hold it while it is inflated, without force.
struct InflatedCube {
  Space space = make_space(hollow_cube(), 1, 0, MPI_COMM_SELF);
  Body body = quarter_body();

  BodyState state_at(double pressure_Pa) {
    Body held = body;
    held.supports.clear();
    held.point_supports = {
        {{0.0, 0.0, 0.0}, {true, true, true}}, {{8e-3, 0.0, 0.0}, {false, true, true}}, {{0.0, 8e-3, 0.0}, {false, false, true}}};
    Equilibrium equilibrium(space, held, {});
    BodyState state = equilibrium.rest();
    const PlenumControl control = PressureControl{pressure_Pa};
    const EquilibriumReport report = equilibrium.solve(state, {&control, 1}, 1.0);
    EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
    return state;
  }
};

// Pressure that follows the wall costs no energy in a rigid motion.
TEST(Vibration, OfAFreeBodyUnderPressureHasSixRigidModes) {
  InflatedCube cube;
  cube.body.supports.clear();
  Equilibrium equilibrium(cube.space, cube.body, {});
  const VibrationReport report = vibrations(equilibrium, cube.state_at(5e3), 1.0, {.mode_count = 3});
  ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
  EXPECT_EQ(report.rigid_modes, 6);
}

// On a plane that it may slide along, a body keeps two translations and a rotation.
TEST(Vibration, KeepsTheRigidMotionsThatSupportsLeave) {
  const Space space = make_space(hollow_cube(), 1, 0, MPI_COMM_SELF);
  Body body = quarter_body();
  body.supports = {{z_min, {false, false, true}}};
  Equilibrium equilibrium(space, body, {});
  EXPECT_EQ(vibrations(equilibrium, equilibrium.rest()).rigid_modes, 3);
}

// A column 10 times as long as wide buckles at a strain of about pi^2/4/12/100 = 0.2 %, far below this one.
TEST(Vibration, OfAStateThatWouldBuckleIsCalledUnstable) {
  const Space space = make_space(meshes::box({0.1, 0.01, 0.01}, {10, 1, 1}), 2, 0, MPI_COMM_SELF);
  Body body = solid_body();
  body.supports = {{x_min, {true, true, true}}};
  Equilibrium equilibrium(space, body, {});
  BodyState state = equilibrium.rest();
  constexpr double stretch = 0.97;
  for (std::size_t a = 0; a < space.positions.size(); ++a) {
    state.displacements_m[3 * a] = (stretch - 1.0) * space.positions[a][0];
    for (std::size_t i = 1; i < 3; ++i)
      state.displacements_m[3 * a + i] = (1.0 / std::sqrt(stretch) - 1.0) * space.positions[a][i];
  }
  const VibrationReport report = vibrations(equilibrium, state);
  EXPECT_EQ(report.status, io::RunStatus::limit_point);
  EXPECT_NE(report.reason.find("unstable"), std::string::npos) << report.reason;
  EXPECT_TRUE(report.frequencies_Hz.empty());
}

/// The quarter of a hollow cube under pressure, linearised, and two things to look at: the chamber's volume and a node at the
/// top.
struct DrivenCube {
  Space space = make_space(hollow_cube_quarter(), 1, 0, MPI_COMM_SELF);
  Body body = quarter_body();
  Equilibrium equilibrium{space, body, {}};
  std::vector<std::vector<double>> observables;

  BodyState state_at(double pressure_Pa) {
    BodyState state = equilibrium.rest();
    const PlenumControl control = PressureControl{pressure_Pa};
    const EquilibriumReport report = equilibrium.solve(state, {&control, 1}, 1.0);
    EXPECT_EQ(report.status, io::RunStatus::completed) << report.reason;
    return state;
  }
  [[nodiscard]] std::size_t top_component() const {
    std::size_t top = 0;
    for (std::size_t a = 0; a < space.positions.size(); ++a) {
      const Point& X = space.positions[a];
      if (X[0] == 0.0 && X[1] == 0.0 && X[2] > 7.9e-3) top = 3 * a + 2;
    }
    return top;
  }
  void observe(const LinearisedBody& linearised) {
    observables = {linearised.volume_gradient(0), std::vector<double>(3 * space.positions.size(), 0.0)};
    observables[1][top_component()] = 1.0;
  }
};

// The central difference of equilibria at p +- 10 Pa errs by their tolerance of forces, 1e-7 of those of p, over 20 Pa / p: 2e-5.
TEST(FrequencyResponse, AtRestIsTheDifferenceOfTwoEquilibria) {
  DrivenCube cube;
  constexpr double pressure_Pa = 3e3;
  constexpr double step_Pa = 10.0;
  const BodyState above = cube.state_at(pressure_Pa + step_Pa);
  const BodyState below = cube.state_at(pressure_Pa - step_Pa);
  const auto volume = [&](const BodyState& state) { return cube.equilibrium.totals(state).chamber_volumes_m3[0]; };
  const double by_volume = (volume(above) - volume(below)) / (2.0 * step_Pa);
  const std::size_t top = cube.top_component();
  const double by_top = (above.displacements_m[top] - below.displacements_m[top]) / (2.0 * step_Pa);

  LinearisedBody linearised(cube.equilibrium, cube.state_at(pressure_Pa));
  cube.observe(linearised);
  const VibrationReport modes = vibrations(linearised, {.mode_count = 4});
  const FrequencyResponse response =
      frequency_response(linearised, modes, linearised.volume_gradient(0), cube.observables, {.frequencies_Hz = {0.0}});
  ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
  EXPECT_NEAR(response.amplitudes[0][0]->real(), by_volume, 5e-5 * by_volume);
  EXPECT_NEAR(response.amplitudes[1][0]->real(), by_top, 5e-5 * by_top);
  EXPECT_EQ(response.amplitudes[0][0]->imag(), 0.0);
}

// Against direct solutions of (K (1 + i eta) - omega^2 M) u = f, below and above the first resonances.
TEST(FrequencyResponse, AgreesWithDirectSolutions) {
  DrivenCube cube;
  LinearisedBody linearised(cube.equilibrium, cube.state_at(3e3));
  cube.observe(linearised);
  const VibrationReport modes = vibrations(linearised, {.mode_count = 60});
  ASSERT_EQ(modes.status, io::RunStatus::completed) << modes.reason;
  const double first_Hz = modes.frequencies_Hz[0];
  const double last_Hz = modes.frequencies_Hz.back();
  const std::vector<double> frequencies_Hz{0.3 * first_Hz, 0.95 * first_Hz, 1.5 * first_Hz};
  const Eigen::MatrixXcd K = dense(linearised.stiffness()).cast<std::complex<double>>();
  const Eigen::MatrixXcd M = dense(linearised.mass()).cast<std::complex<double>>();
  const Eigen::VectorXcd load = eigen(linearised.volume_gradient(0)).cast<std::complex<double>>();
  for (const double loss_factor : {0.0, 0.1}) {
    const FrequencyResponse response = frequency_response(linearised, modes, linearised.volume_gradient(0), cube.observables,
                                                          {.frequencies_Hz = frequencies_Hz, .loss_factor = loss_factor});
    for (std::size_t f = 0; f < frequencies_Hz.size(); ++f) {
      const double omega = 2.0 * std::numbers::pi * frequencies_Hz[f];
      const Eigen::VectorXcd u = (K * std::complex<double>(1.0, loss_factor) - omega * omega * M).partialPivLu().solve(load);
      for (std::size_t w = 0; w < 2; ++w) {
        const std::complex<double> direct = (eigen(cube.observables[w]).cast<std::complex<double>>()).dot(u);
        // what the three terms for the highest modes leave out, and rounding
        const double tolerance = std::pow(frequencies_Hz[f] / last_Hz, 6) + 1e-8;
        EXPECT_LT(std::abs(*response.amplitudes[w][f] - direct), tolerance * std::abs(direct)) << frequencies_Hz[f];
      }
    }
  }
}

TEST(FrequencyResponse, HasNoAnswerBeyondItsModes) {
  DrivenCube cube;
  LinearisedBody linearised(cube.equilibrium, cube.equilibrium.rest());
  cube.observe(linearised);
  const VibrationReport modes = vibrations(linearised, {.mode_count = 3});
  ASSERT_EQ(modes.status, io::RunStatus::completed) << modes.reason;
  const double highest_Hz = modes.frequencies_Hz.back();
  const FrequencyResponse response =
      frequency_response(linearised, modes, linearised.volume_gradient(0), cube.observables,
                         {.frequencies_Hz = {0.5 * highest_Hz, highest_Hz, 2.0 * highest_Hz}, .loss_factor = 0.1});
  ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
  EXPECT_TRUE(response.amplitudes[0][0].has_value());
  EXPECT_FALSE(response.amplitudes[0][1].has_value());
  EXPECT_FALSE(response.amplitudes[0][2].has_value());
}

TEST(FrequencyResponse, HasNoAnswerAtAnUndampedResonanceAndAFiniteOneWithDamping) {
  DrivenCube cube;
  LinearisedBody linearised(cube.equilibrium, cube.equilibrium.rest());
  cube.observe(linearised);
  const VibrationReport modes = vibrations(linearised, {.mode_count = 4});
  ASSERT_EQ(modes.status, io::RunStatus::completed) << modes.reason;
  FrequencyResponseOptions options{.frequencies_Hz = {modes.frequencies_Hz[0]}};
  const auto response = [&] {
    return frequency_response(linearised, modes, linearised.volume_gradient(0), cube.observables, options).amplitudes[0][0];
  };
  EXPECT_FALSE(response().has_value());
  options.loss_factor = 0.05;
  ASSERT_TRUE(response().has_value());
  EXPECT_LT(response()->imag(), 0.0);  // the motion lags the load
}

// Chamber pressure cannot push a free body: without supports it responses with the same change of volume.
TEST(FrequencyResponse, OfAFreeBodyIsThatOfOneHeldWithoutForce) {
  InflatedCube cube;
  const BodyState state = cube.state_at(3e3);
  std::vector<double> responses;
  for (const bool is_held : {true, false}) {
    Body body = cube.body;
    body.supports.clear();
    if (is_held) {
      body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, true}},
                             {{8e-3, 0.0, 0.0}, {false, true, true}},
                             {{0.0, 8e-3, 0.0}, {false, false, true}}};
    }
    Equilibrium equilibrium(cube.space, body, {});
    LinearisedBody linearised(equilibrium, state);
    const std::vector<std::vector<double>> observables{linearised.volume_gradient(0)};
    const FrequencyResponse response = frequency_response(linearised, vibrations(linearised), linearised.volume_gradient(0),
                                                          observables, {.frequencies_Hz = {0.0}});
    ASSERT_EQ(response.status, io::RunStatus::completed) << response.reason;
    responses.push_back(response.amplitudes[0][0]->real());
  }
  EXPECT_NEAR(responses[1], responses[0],
              1e-8 * responses[0]);  // the cube of shift over eigenvalue, and rounding of the shifted system
}

}  // namespace
}  // namespace menger::fem
