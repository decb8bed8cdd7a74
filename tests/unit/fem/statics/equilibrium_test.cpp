#include "fem/statics/equilibrium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/laws/homogeneous_deformations.h"
#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

/// A bar of unit area along x that may contract freely, with symmetry at its three lower sides.
Body bar_body(const materials::HyperelasticLaw& law) {
  Body body;
  body.regions = {{law, materials::SimoTaylorVolume{1e8}, 0.0}};
  body.supports = {{x_min, {true, false, false}}, {y_min, {false, true, false}}, {z_min, {false, false, true}}};
  return body;
}

// A dead traction equal to the nominal stress at a stretch gives that stretch, in both degrees. The formula is that of an
// incompressible bar: tolerance is the stress, 5e4 Pa, over the bulk modulus.
TEST(Equilibrium, OfAPulledBarHasTheStretchOfItsFormula) {
  const materials::HyperelasticLaw law = materials::Yeoh{21e3, 2.5e3, 0.1e3};
  const double stretch = 1.4;
  const auto nominal = materials::nominal_stress(law, materials::LoadingMode::uniaxial, stretch);
  for (const int degree : {1, 2}) {
    const Space space = make_space(meshes::box({1.0, 1.0, 1.0}, {2, 1, 2}), degree, 0, MPI_COMM_SELF);
    Body body = bar_body(law);
    body.tractions = {{x_max, {nominal.stress_Pa, 0.0, 0.0}}};
    Equilibrium equilibrium(space, body, {});
    BodyState state = equilibrium.rest();
    for (const double factor : {0.5, 1.0}) {
      const EquilibriumReport report = equilibrium.solve(state, {}, factor);
      ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    }
    double error = 0.0;
    for (std::size_t a = 0; a < space.positions.size(); ++a) {
      const Point& x = space.positions[a];
      error = std::max({error, std::abs(state.displacements_m[3 * a] - (stretch - 1.0) * x[0]),
                        std::abs(state.displacements_m[3 * a + 2] - (1.0 / std::sqrt(stretch) - 1.0) * x[2])});
    }
    EXPECT_LT(error, 5e-4);
  }
}

TEST(Equilibrium, OfABodyWithoutLoadsIsRest) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  Equilibrium equilibrium(space, body, {});
  BodyState state = equilibrium.rest();
  const PlenumControl none = PressureControl{0.0};
  const EquilibriumReport report = equilibrium.solve(state, {&none, 1}, 1.0);
  EXPECT_EQ(report.status, io::RunStatus::completed);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.factorisations, 0);
  for (const double u : state.displacements_m) EXPECT_EQ(u, 0.0);
}

// The predicted pressure changes the way, not the solution.
TEST(Equilibrium, IsTheSameWithEitherNewtonMethod) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  std::vector<BodyState> states;
  std::vector<int> iterations;
  for (const bool predicts : {true, false}) {
    EquilibriumOptions options;
    options.predict_pressure = predicts;
    Equilibrium equilibrium(space, body, options);
    states.push_back(equilibrium.rest());
    int count = 0;
    for (const double pressure_Pa : {1e3, 2e3, 3e3}) {
      const PlenumControl control = PressureControl{pressure_Pa};
      const EquilibriumReport report = equilibrium.solve(states.back(), {&control, 1}, 1.0);
      ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
      count += report.iterations;
    }
    iterations.push_back(count);
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < states[0].displacements_m.size(); ++n)
    largest = std::max(largest, std::abs(states[0].displacements_m[n] - states[1].displacements_m[n]));
  EXPECT_LT(largest, 1e-10);  // of 1e-4 m, the tolerance of forces being 1e-7
  EXPECT_LE(iterations[0], iterations[1]);
}

TEST(Equilibrium, IterativeAndDirectSolverAgree) {
  const Space space = make_space(hollow_cube_quarter(), 2, 0, MPI_COMM_SELF);
  const Body body = quarter_body();
  std::vector<BodyState> states;
  for (const LinearMethod method : {LinearMethod::direct, LinearMethod::iterative}) {
    EquilibriumOptions options;
    options.linear.method = method;
    Equilibrium equilibrium(space, body, options);
    states.push_back(equilibrium.rest());
    const PlenumControl control = PressureControl{2e3};
    const EquilibriumReport report = equilibrium.solve(states.back(), {&control, 1}, 1.0);
    ASSERT_EQ(report.status, io::RunStatus::completed) << report.reason;
    EXPECT_EQ(report.negative_pivots.has_value(), method == LinearMethod::direct);
  }
  for (std::size_t n = 0; n < states[0].displacements_m.size(); ++n)
    EXPECT_NEAR(states[0].displacements_m[n], states[1].displacements_m[n], 1e-10);
}

TEST(Equilibrium, OfABodyThatIsNotHeldIsNotFound) {
  for (const int degree : {1, 2}) {
    const Space space = make_space(hollow_cube(), degree, 0, MPI_COMM_SELF);
    Body body = quarter_body();
    body.supports.clear();
    Equilibrium equilibrium(space, body, {});
    BodyState state = equilibrium.rest();
    const PlenumControl control = PressureControl{1e3};
    const EquilibriumReport report = equilibrium.solve(state, {&control, 1}, 1.0);
    EXPECT_EQ(report.status, io::RunStatus::not_converged);
    EXPECT_NE(report.reason.find("singular"), std::string::npos) << report.reason;
    for (const double u : state.displacements_m) EXPECT_TRUE(std::isfinite(u));
  }
}

// All of the residual, chamber pressure, gravity, traction and ground included, is the derivative of the potential energy.
TEST(Assembly, ResidualIsTheDerivativeOfThePotentialEnergy) {
  for (const int degree : {1, 2}) {
    const Space space = make_space(hollow_cube_quarter(), degree, 0, MPI_COMM_SELF);
    Body body = quarter_body();
    body.gravity_m_per_s2 = {1.0, 2.0, -9.81};
    body.tractions = {{x_max, {10.0, -20.0, 30.0}}};
    Assembly assembly(space, body);
    const std::vector<double> pressures{4e3};
    const Loads loads{pressures, 0.7};
    std::vector<double> u(3 * space.positions.size());
    std::vector<double> direction(u.size());
    for (std::size_t n = 0; n < u.size(); ++n) {
      if (assembly.held()[n] != 0) continue;
      u[n] = 5e-5 * std::sin(1.7 * static_cast<double>(n));
      direction[n] = 1e-3 * std::cos(2.3 * static_cast<double>(n));
    }
    const auto energy_at = [&](double step) {
      std::vector<double> moved = u;
      for (std::size_t n = 0; n < u.size(); ++n) moved[n] += step * direction[n];
      const BodyTotals totals = assembly.assemble(moved, loads, {}, {}, nullptr);
      return totals.strain_energy_J - pressures[0] * totals.chamber_volumes_m3[0] - 0.7 * totals.dead_load_work_J;
    };
    std::vector<double> residual(u.size());
    std::vector<std::vector<double>> gradients(1);
    const BodyTotals totals = assembly.assemble(u, loads, residual, gradients, nullptr);
    ASSERT_GT(totals.smallest_ratio, 0.0);
    double slope = 0.0;
    double slope_of_volume = 0.0;
    for (std::size_t n = 0; n < u.size(); ++n) {
      slope += residual[n] * direction[n];
      slope_of_volume += gradients[0][n] * direction[n];
    }
    constexpr double step = 1e-4;  // the third derivative leaves an error of about its square
    EXPECT_NEAR((energy_at(step) - energy_at(-step)) / (2.0 * step), slope, 1e-6 * std::abs(slope));
    const auto volume_at = [&](double length) {
      std::vector<double> moved = u;
      for (std::size_t n = 0; n < u.size(); ++n) moved[n] += length * direction[n];
      return assembly.assemble(moved, loads, {}, {}, nullptr).chamber_volumes_m3[0];
    };
    EXPECT_NEAR((volume_at(step) - volume_at(-step)) / (2.0 * step), slope_of_volume, 1e-6 * std::abs(slope_of_volume));
  }
}

// The matrix of the follower load, the elements and the supports is the derivative of the residual, whichever way it is stored.
TEST(Assembly, StiffnessIsTheDerivativeOfTheResidual) {
  for (const int degree : {1, 2}) {
    for (const bool symmetric : {true, false}) {
      const Space space = make_space(hollow_cube_quarter(), degree, 0, MPI_COMM_SELF);
      const Body body = quarter_body();
      Assembly assembly(space, body);
      const std::vector<double> pressures{4e3};
      const Loads loads{pressures, 1.0};
      std::vector<double> u(3 * space.positions.size());
      std::vector<double> direction(u.size());
      for (std::size_t n = 0; n < u.size(); ++n) {
        if (assembly.held()[n] != 0) continue;
        u[n] = 5e-5 * std::sin(1.7 * static_cast<double>(n));
        direction[n] = 1e-3 * std::cos(2.3 * static_cast<double>(n));
      }
      const MatrixHandle matrix = assembly.make_matrix(symmetric);
      assembly.assemble(u, loads, {}, {}, matrix);
      VectorHandle x;
      VectorHandle y;
      petsc(MatCreateVecs(matrix, x.receive(), y.receive()));
      double* data = nullptr;
      petsc(VecGetArrayWrite(x, &data));
      std::copy(direction.begin(), direction.end(), data);
      petsc(VecRestoreArrayWrite(x, &data));
      petsc(MatMult(matrix, x, y));

      const auto residual_at = [&](double step) {
        std::vector<double> moved = u;
        for (std::size_t n = 0; n < u.size(); ++n) moved[n] += step * direction[n];
        std::vector<double> residual(u.size());
        assembly.assemble(moved, loads, residual, {}, nullptr);
        return residual;
      };
      constexpr double step = 1e-4;
      const std::vector<double> ahead = residual_at(step);
      const std::vector<double> behind = residual_at(-step);
      const double* product = nullptr;
      petsc(VecGetArrayRead(y, &product));
      double largest = 0.0;
      double error = 0.0;
      for (std::size_t n = 0; n < u.size(); ++n) {
        largest = std::max(largest, std::abs(product[n]));
        error = std::max(error, std::abs((ahead[n] - behind[n]) / (2.0 * step) - product[n]));
      }
      petsc(VecRestoreArrayRead(y, &product));
      EXPECT_LT(error, 1e-6 * largest);
    }
  }
}

}  // namespace
}  // namespace menger::fem
