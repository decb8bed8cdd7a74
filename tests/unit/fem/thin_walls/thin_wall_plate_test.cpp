// Plates of several walls: patch tests, zero modes, natural frequencies.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/unit/fem/thin_walls/thin_wall_samples.h"

namespace menger::fem {
namespace {

/// Elements of different sizes.
Grid irregular_plate(double thick = 1e-3) {
  Grid grid;
  grid.lines = {{{0.0, 2e-3, 5e-3, 6.5e-3}, {0.0, 3e-3, 4e-3, 6e-3}, {-0.5 * thick, 0.5 * thick}}};
  return grid;
}

/// The largest force on nodes that are not on the edges of a plate.
double largest_inside(const Grid& grid, const std::vector<double>& forces) {
  double result = 0.0;
  for (std::size_t node = 0; node < grid.node_count(); ++node) {
    if (grid.is_at_end(node, 0) || grid.is_at_end(node, 1)) continue;
    for (std::size_t i = 0; i < 3; ++i) result = std::max(result, std::abs(forces[3 * node + i]));
  }
  return result;
}

TEST(WallPatch, ConstantStretchNeedsNoForcesInside) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = irregular_plate();
  // Two columns in the plane, and the normal as long as keeps the volume.
  const std::array<double, 3> f1{1.2, 0.1, 0.3};
  const std::array<double, 3> f2{-0.1, 0.9, 0.2};
  const std::array<double, 3> n{f1[1] * f2[2] - f1[2] * f2[1], f1[2] * f2[0] - f1[0] * f2[2], f1[0] * f2[1] - f1[1] * f2[0]};
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  const auto u = grid.displacements([&](const std::array<double, 3>& X) {
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i) value[i] = f1[i] * X[0] + f2[i] * X[1] + n[i] / square * X[2] - X[i];
    return value;
  });
  for (const auto& law : all_laws()) {
    Patch<double> patch(kernels, ThinWallElement::wall, grid);
    const std::vector<double> forces = patch.forces(silicone_of(law), u);
    EXPECT_LT(largest_inside(grid, forces), 1e-12 * largest(forces)) << materials::name_of(law);  // rounding
    const double whole = patch.energy(silicone_of(law), u);
    const double area = 6.5e-3 * 6e-3;
    const double one = Patch<double>(kernels, ThinWallElement::wall, one_box()).energy(silicone_of(law), [&] {
      return one_box().displacements([&](const std::array<double, 3>& X) {
        std::array<double, 3> value{};
        for (std::size_t i = 0; i < 3; ++i) value[i] = f1[i] * X[0] + f2[i] * X[1] + n[i] / square * X[2] - X[i];
        return value;
      });
    }());
    EXPECT_NEAR(whole / area, one / 6e-6, 1e-12 * whole / area);
  }
}

/// Bending and twisting of a plate with small curvatures, 1/m.
struct Curvatures {
  double x, y, xy;
};

TEST(WallPatch, ConstantBendingNeedsNoForcesInsideAndHasTheEnergyOfAPlate) {
  const auto kernels = best_thin_wall_kernels<double>();
  const double thick = 1e-3;
  const Grid grid = irregular_plate(thick);
  for (const auto& law : all_laws()) {
    const ThinWallMaterial material = silicone_of(law);
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    const double kappa = material.bulk_modulus_Pa;
    const double E = 9.0 * kappa * mu / (3.0 * kappa + mu);
    const double nu = (3.0 * kappa - 2.0 * mu) / (2.0 * (3.0 * kappa + mu));
    const double D = E * thick * thick * thick / (12.0 * (1.0 - nu * nu));
    for (const Curvatures& k : {Curvatures{1e-4, 0.0, 0.0}, {0.0, 1e-4, 0.0}, {0.0, 0.0, 1e-4}, {1e-4, -0.5e-4, 0.7e-4}}) {
      SCOPED_TRACE(std::string(materials::name_of(law)) + ' ' + std::to_string(1e4 * k.x) + ' ' + std::to_string(1e4 * k.xy));
      const auto u = grid.displacements([&](const std::array<double, 3>& X) {
        return std::array{-(k.x * X[0] + k.xy * X[1]) * X[2], -(k.y * X[1] + k.xy * X[0]) * X[2],
                          0.5 * (k.x * X[0] * X[0] + k.y * X[1] * X[1]) + k.xy * X[0] * X[1]};
      });
      Patch<double> patch(kernels, ThinWallElement::wall, grid);
      const std::vector<double> forces = patch.forces(material, u);
      // turns of 6e-7 in the square, by the stiffness of whole faces; bending strains are 5e-8
      EXPECT_LT(largest_inside(grid, forces), 2e-4 * largest(forces));
      const double density = 0.5 * D * (k.x * k.x + k.y * k.y + 2.0 * nu * k.x * k.y + 2.0 * (1.0 - nu) * k.xy * k.xy);
      const double tolerance = law.index() == 0 ? 2e-3 : 1e-4;  // (mu / kappa)^2 of the neo-Hookean; turns
      EXPECT_NEAR(patch.energy(material, u) / (6.5e-3 * 6e-3), density, tolerance * density);
    }
  }
}

/// The stiffness at rest by central differences of forces, which are odd there but for 1e-6 of them.
Eigen::MatrixXd stiffness(Patch<double>& patch, const ThinWallMaterial& material, std::size_t components, double step_m) {
  Eigen::MatrixXd K(components, components);
  std::vector<double> u(components, 0.0);
  for (std::size_t n = 0; n < components; ++n) {
    u[n] = step_m;
    const std::vector<double> ahead = patch.forces(material, u);
    u[n] = -step_m;
    const std::vector<double> behind = patch.forces(material, u);
    u[n] = 0.0;
    for (std::size_t m = 0; m < components; ++m)
      K(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) = (ahead[m] - behind[m]) / (2.0 * step_m);
  }
  return K;
}

TEST(ThinWallStiffness, HasSixZeroModesAndNoSoftOne) {
  const auto kernels = best_thin_wall_kernels<double>();
  for (const ThinWallElement element : both_elements) {
    for (const auto& law : all_laws()) {
      for (const double thick : {0.1e-3, 1e-3, 2e-3}) {
        SCOPED_TRACE(name_of(element) + ' ' + std::string(materials::name_of(law)) + ' ' + std::to_string(thick));
        Grid grid = one_box();
        grid.lines[2][1] = thick;
        Patch<double> patch(kernels, element, grid);
        const Eigen::MatrixXd K = stiffness(patch, silicone_of(law), 24, 1e-9);
        EXPECT_LT((K - K.transpose()).norm(), 1e-6 * K.norm());
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (K + K.transpose())).eigenvalues();
        const double mu = materials::shear_modulus_at_rest_Pa(law);
        EXPECT_LT(std::max(std::abs(values[0]), std::abs(values[5])), 1e-6 * values[23]);
        // The softest are bending and twisting of the thin one: some mu t^3 / l^2.
        EXPECT_GT(values[6], 0.2 * mu * thick * thick * thick / 13e-6);
      }
    }
  }
}

/// Natural frequencies in rad/s of a free plate with lumped masses, the lowest first.
Eigen::VectorXd frequencies(ThinWallElement element, const ThinWallMaterial& material, const Grid& grid, double density) {
  const auto kernels = best_thin_wall_kernels<double>();
  Patch<double> patch(kernels, element, grid);
  const std::size_t components = 3 * grid.node_count();
  Eigen::MatrixXd K = stiffness(patch, material, components, 1e-9);
  Eigen::VectorXd root(components);
  for (std::size_t node = 0; node < grid.node_count(); ++node) {
    double volume = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& lines = grid.lines[axis];
      const std::size_t n = grid.place(node)[axis];
      volume *= 0.5 * (lines[std::min(n + 1, lines.size() - 1)] - lines[n == 0 ? 0 : n - 1]);
    }
    for (std::size_t i = 0; i < 3; ++i) root[static_cast<Eigen::Index>(3 * node + i)] = 1.0 / std::sqrt(density * volume);
  }
  K = (root.asDiagonal() * (0.5 * (K + K.transpose())) * root.asDiagonal()).eval();
  const Eigen::VectorXd squares = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(squares[0], -1e-6 * squares[squares.size() - 1]);
  return squares.cwiseMax(0.0).cwiseSqrt();
}

// A mode without stiffness of its own would be softer the finer the mesh or far below the others; those of the plate converge.
TEST(ThinWallStiffness, APlateOfFourByFourHasNoSoftMode) {
  const ThinWallMaterial material = silicone_of(materials::NeoHookean{86.7e3});
  for (const double thick : {0.5e-3, 2e-3}) {
    const Eigen::VectorXd coarse = frequencies(ThinWallElement::wall, material, plate(4, 2.5e-3, thick), 1070.0);
    const Eigen::VectorXd fine = frequencies(ThinWallElement::wall, material, plate(8, 1.25e-3, thick), 1070.0);
    EXPECT_LT(coarse[5], 0.01 * coarse[6]);
    for (Eigen::Index mode = 6; mode < 12; ++mode)
      EXPECT_NEAR(coarse[mode], fine[mode], 0.3 * fine[mode]) << thick << ' ' << mode;
    // 150 components: lowest of the 22nd on are above what a plate of four elements can show
    for (Eigen::Index mode = 12; mode < 40; ++mode) EXPECT_GT(coarse[mode], 0.6 * fine[mode]) << thick << ' ' << mode;
  }
}

// A free square plate with Poisson's ratio 0.3: 13.47, 19.60 and 24.27 times sqrt(D / rho t) / L^2 where it is thin. The law is
// one that plane stress is solved for, as mu / kappa is not small here.
TEST(ThinWallStiffness, AFreePlateHasTheFrequenciesOfATheory) {
  const double mu = 50e3;
  const double nu = 0.3;
  const double E = 2.0 * mu * (1.0 + nu);
  const double length = 10e-3;
  const double thick = 0.2e-3;
  const double density = 1000.0;
  const ThinWallMaterial material{.law = materials::Yeoh{0.5 * mu, 0.0, 0.0}, .bulk_modulus_Pa = E / (3.0 * (1.0 - 2.0 * nu))};
  const double unit = std::sqrt(E * thick * thick / (12.0 * (1.0 - nu * nu) * density)) / (length * length);
  const Eigen::VectorXd coarse = frequencies(ThinWallElement::wall, material, plate(5, length / 5.0, thick), density);
  const Eigen::VectorXd fine = frequencies(ThinWallElement::wall, material, plate(10, length / 10.0, thick), density);
  const std::array<double, 3> expected{13.47, 19.60, 24.27};
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const auto place = static_cast<Eigen::Index>(6 + mode);
    EXPECT_NEAR(fine[place] / unit, expected[mode], 0.04 * expected[mode]);
    // Of second order; shear and what its square does are less than one per cent.
    EXPECT_NEAR((4.0 * fine[place] - coarse[place]) / (3.0 * unit), expected[mode], 0.01 * expected[mode]);
  }
}

}  // namespace
}  // namespace menger::fem
