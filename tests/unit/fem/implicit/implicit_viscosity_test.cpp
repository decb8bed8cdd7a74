#include "fem/implicit/implicit_viscosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fem/implicit/implicit_samples.h"

namespace menger::fem {
namespace {

constexpr double viscosity = 7.0;

/// A smooth strain of some tenths with rotation.
Point bent(const Point& X) {
  return {0.1 * X[0] + 8.0 * X[0] * X[1], -0.2 * X[2] + 5.0 * X[1] * X[2], 0.15 * X[1] + 6.0 * X[0] * X[2]};
}

Point rate(const Point& X) { return {3.0 * X[1] + 200.0 * X[0] * X[0], X[2] - X[0], 2.0 * X[0] + 100.0 * X[1] * X[2]}; }

// The kernels of explicit dynamics are another implementation of the same stress, on boxes. Both compute 8 points of each element
// in double precision.
TEST(ImplicitViscosity, IsThatOfExplicitDynamics) {
  const meshes::HexahedralMesh mesh = hollow_cube();
  const ImplicitSample sample(mesh);
  const auto of_mesh = [&](const auto& function) {
    std::vector<double> values;
    for (const Point& X : mesh.points) {
      const Point value = function(X);
      values.insert(values.end(), value.begin(), value.end());
    }
    return values;
  };
  const std::vector<double> u = of_mesh(bent);
  const std::vector<double> v = of_mesh(rate);
  const ExplicitBody viscous(mesh, silicone_options(mesh, viscosity));
  const ExplicitBody elastic(mesh, silicone_options(mesh));
  const std::vector<double> with = internal_forces(viscous, {u.data(), v.data()});
  const std::vector<double> without = internal_forces(elastic, {u.data(), nullptr});

  const ImplicitViscosity elements(sample.space, {viscosity});
  std::vector<double> forces(u.size(), 0.0);
  const double dissipated = elements.add_forces(at_nodes(sample.space, bent), at_nodes(sample.space, rate), forces);
  double largest = 0.0;
  for (const double force : forces) largest = std::max(largest, std::abs(force));
  EXPECT_GT(largest, 1e-5);
  double power = 0.0;
  for (std::size_t node = 0; node < sample.space.positions.size(); ++node) {
    const std::size_t same = node_at(mesh, sample.space.positions[node]);
    const Point velocity = rate(sample.space.positions[node]);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(forces[3 * node + i], with[3 * same + i] - without[3 * same + i], 1e-9 * largest + 1e-12);
      power += forces[3 * node + i] * velocity[i];
    }
  }
  EXPECT_NEAR(dissipated, power, 1e-12 * power);
}

// Spinning and falling cost nothing, whatever the shape.
TEST(ImplicitViscosity, RigidMotionIsFree) {
  for (const int degree : {1, 2}) {
    const Space space = hollow_cube_space(degree);
    const ImplicitViscosity elements(space, {viscosity});
    const auto spinning = [](const Point& X) { return sum(Point{1.0, 2.0, 3.0}, cross({20.0, -10.0, 30.0}, sum(X, bent(X)))); };
    std::vector<double> forces(3 * space.positions.size(), 0.0);
    EXPECT_LT(elements.add_forces(at_nodes(space, bent), at_nodes(space, spinning), forces), 1e-20);
    for (const double force : forces) EXPECT_LT(std::abs(force), 1e-14);
  }
}

// Forces are linear in the velocities: the matrix times them is the forces.
TEST(ImplicitViscosity, MatrixTimesVelocitiesIsForce) {
  for (const int degree : {1, 2}) {
    const ImplicitSample sample(hollow_cube(1, 4e-3), degree);
    const Assembly assembly(sample.space, sample.body);
    const ImplicitViscosity elements(sample.space, {viscosity});
    const std::vector<double> u = at_nodes(sample.space, bent);
    const std::vector<double> v = at_nodes(sample.space, rate);
    const MatrixHandle matrix = assembly.make_matrix(true);
    petsc(MatZeroEntries(matrix));
    elements.add_matrix(assembly, u, 2.0, matrix);
    petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    VectorHandle in;
    VectorHandle out;
    petsc(MatCreateVecs(matrix, in.receive(), out.receive()));
    double* data = nullptr;
    petsc(VecGetArrayWrite(in, &data));
    std::copy(v.begin(), v.end(), data);
    petsc(VecRestoreArrayWrite(in, &data));
    petsc(MatMult(matrix, in, out));
    std::vector<double> forces(u.size(), 0.0);
    const double dissipated = elements.add_forces(u, v, forces);
    EXPECT_GT(dissipated, 0.0);
    const double largest =
        std::abs(*std::max_element(forces.begin(), forces.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    const double* product = nullptr;
    petsc(VecGetArrayRead(out, &product));
    for (std::size_t n = 0; n < forces.size(); ++n) EXPECT_NEAR(product[n], 2.0 * forces[n], 1e-12 * largest);
    petsc(VecRestoreArrayRead(out, &product));
  }
}

}  // namespace
}  // namespace menger::fem
