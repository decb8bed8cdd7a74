#include "voxel/statics/tangent_factors.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/unit/voxel/statics/static_samples.h"

namespace menger::voxel {
namespace {

/// The tangent of a held body of 12 voxels under pressure and bending.
Eigen::SparseMatrix<double> tangent_under(double pressure_Pa) {
  SurrogateParameters parameters = sample_parameters();
  parameters.lateral_coupling = 0.4;
  parameters.extension.fill({2e-5, 1e-5, -3e-5});
  const StaticBody body = sample_body(meshes::Polycube::from_digits(3, 2, 2, "111111111111"), {meshes::Side::x_min}, parameters);
  Equilibrium equilibrium(body);
  StaticLoads loads = under_pressure(pressure_Pa);
  loads.points = {{11, {0.0, 0.0, 0.01 * sample_axial()}, {0.0, 0.0, 0.0}}};
  EXPECT_EQ(equilibrium.load(loads), io::RunStatus::completed);
  return equilibrium.linearise();
}

TEST(TangentFactors, SolveAsDenseOnesDoWhateverTheValues) {
  TangentFactors factors;
  for (const double pressure_Pa : {0.0, 3000.0}) {
    const Eigen::SparseMatrix<double> tangent = tangent_under(pressure_Pa);
    const Eigen::VectorXd residual = Eigen::VectorXd::LinSpaced(tangent.rows(), -1.0, 1.0);
    ASSERT_TRUE(factors.factorise(tangent));
    const Eigen::VectorXd expected = Eigen::MatrixXd(tangent).partialPivLu().solve(residual);
    // rounding times a condition number of 1e4
    EXPECT_LE((factors.solve(residual) - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(TangentFactors, OfASingularTangentThereAreNone) {
  Eigen::SparseMatrix<double> tangent = tangent_under(0.0);
  tangent *= 0.0;
  TangentFactors factors;
  EXPECT_FALSE(factors.factorise(tangent));
}

TEST(TangentFactors, OfNothingSolveNothing) {
  TangentFactors factors;
  ASSERT_TRUE(factors.factorise(Eigen::SparseMatrix<double>(0, 0)));
  EXPECT_EQ(factors.solve(Eigen::VectorXd(0)).size(), 0);
}

}  // namespace
}  // namespace menger::voxel
