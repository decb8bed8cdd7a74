#include "fem/elements/element_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace menger::fem {
namespace {

using Gradient = std::array<double, 9>;

/// A hexahedron without right angles, 10 to 14 mm along each axis.
std::array<double, 3> crooked(const std::array<double, 3>& place) {
  const auto [x, y, z] = place;
  return {0.010 * x + 0.002 * y, 0.012 * y - 0.001 * z * x, 0.014 * z + 0.003 * x};
}

/// Positions of the nodes of an element of a degree, x fastest.
std::vector<double> nodes_of(int degree) {
  std::vector<double> nodes;
  for (int z = 0; z <= degree; ++z) {
    for (int y = 0; y <= degree; ++y) {
      for (int x = 0; x <= degree; ++x) {
        const auto node = crooked({1.0 * x / degree, 1.0 * y / degree, 1.0 * z / degree});
        nodes.insert(nodes.end(), node.begin(), node.end());
      }
    }
  }
  return nodes;
}

/// Displacements (F - 1) X.
std::vector<double> moved_by(const Gradient& F, const std::vector<double>& nodes) {
  std::vector<double> displacements;
  for (std::size_t n = 0; n < nodes.size(); n += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      double u = -nodes[n + i];
      for (std::size_t j = 0; j < 3; ++j) u += F[3 * i + j] * nodes[n + j];
      displacements.push_back(u);
    }
  }
  return displacements;
}

TEST(MeanDeformation, IsThatOfAHomogeneousOne) {
  const Gradient F{1.3, 0.2, 0.0, -0.1, 0.9, 0.3, 0.0, 0.1, 1.1};
  const double J = 1.3 * (0.9 * 1.1 - 0.3 * 0.1) - 0.2 * (-0.1 * 1.1);
  for (const int degree : {1, 2}) {
    const std::vector<double> nodes = nodes_of(degree);
    const MeanDeformation mean = mean_deformation(degree, nodes, moved_by(F, nodes));
    for (std::size_t n = 0; n < 9; ++n) EXPECT_NEAR(mean.gradient[n], F[n], 1e-13);
    EXPECT_NEAR(mean.volume_ratio, J, 1e-13);
  }
}

// x = X (1 + a Y) in a cube has det F = 1 + a Y, and half of a L in the mean; the gradient at a corner is far from that.
TEST(MeanDeformation, HasTheVolumeOfABentElement) {
  constexpr double edge = 0.01;
  constexpr double a = 80.0;
  for (const int degree : {1, 2}) {
    std::vector<double> nodes;
    std::vector<double> displacements;
    for (int n = 0; n < (degree + 1) * (degree + 1) * (degree + 1); ++n) {
      const double x = edge / degree * (n % (degree + 1));
      const double y = edge / degree * (n / (degree + 1) % (degree + 1));
      nodes.insert(nodes.end(), {x, y, edge / degree * (n / (degree + 1) / (degree + 1))});
      displacements.insert(displacements.end(), {a * x * y, 0.0, 0.0});
    }
    const MeanDeformation mean = mean_deformation(degree, nodes, displacements);
    EXPECT_NEAR(mean.volume_ratio, 1.0 + 0.5 * a * edge, 1e-13);
    EXPECT_NEAR(mean.gradient[0], 1.0 + 0.5 * a * edge, 1e-13);
    EXPECT_NEAR(mean.gradient[1], 0.5 * a * edge, 1e-13);
  }
}

// A rod of an incompressible material in tension: sigma = mu (l^2 - 1/l) (neo-Hooke), mu_1 (l^alpha - l^(-alpha/2)) (Ogden).
TEST(ElementState, OfARodInTensionIsItsClosedForm) {
  constexpr double mu_Pa = 6e4;
  constexpr double alpha = 3.5;
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  for (const double stretch : {0.7, 1.0, 1.8}) {
    const double across = 1.0 / std::sqrt(stretch);
    const Gradient F{c * stretch, -s * across, 0.0, s * stretch, c * across, 0.0, 0.0, 0.0, across};  // then turned about z
    const ElementState neo_hookean = element_state(materials::NeoHookean{mu_Pa}, {F, 1.0});
    EXPECT_NEAR(neo_hookean.largest_stretch, std::max(stretch, across), 1e-13);
    EXPECT_NEAR(neo_hookean.von_mises_stress_Pa, mu_Pa * std::abs(stretch * stretch - 1.0 / stretch), 1e-9 * mu_Pa);
    EXPECT_EQ(neo_hookean.volume_ratio, 1.0);
    materials::Ogden<1> law{};
    law.terms[0] = {mu_Pa, alpha};
    const ElementState ogden = element_state(law, {F, 1.0});
    EXPECT_NEAR(ogden.von_mises_stress_Pa, mu_Pa * std::abs(std::pow(stretch, alpha) - std::pow(stretch, -0.5 * alpha)),
                1e-9 * mu_Pa);
  }
}

TEST(ElementState, OfACompressedElementHasTheStressOfItsShape) {
  constexpr double mu_Pa = 6e4;
  // sigma = mu J^(-5/3) dev(F F^T)
  const double J = 1.2 * 0.9 * 1.05;
  const Gradient F{1.2, 0.0, 0.0, 0.0, 0.9, 0.0, 0.0, 0.0, 1.05};
  const double a = 1.2 * 1.2;
  const double b = 0.9 * 0.9;
  const double d = 1.05 * 1.05;
  const double von_mises = std::sqrt(0.5 * ((a - b) * (a - b) + (b - d) * (b - d) + (d - a) * (d - a)));
  EXPECT_NEAR(element_state(materials::NeoHookean{mu_Pa}, {F, J}).von_mises_stress_Pa,
              mu_Pa * std::pow(J, -5.0 / 3.0) * von_mises, 1e-9 * mu_Pa);
}

TEST(ElementState, OfAnInvertedElementHasNoStress) {
  const Gradient F{-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  EXPECT_TRUE(std::isnan(element_state(materials::NeoHookean{1e5}, {F, -1.0}).von_mises_stress_Pa));
}

TEST(ElementState, PrincipalStretchesDoNotSeeRotationsAndDescend) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  // R U with a turn about z and U = diag(0.8, 1.5, 1.1)
  const Gradient F{0.8 * c, -1.5 * s, 0.0, 0.8 * s, 1.5 * c, 0.0, 0.0, 0.0, 1.1};
  const auto stretches = principal_stretches(F);
  EXPECT_NEAR(stretches[0], 1.5, 1e-13);
  EXPECT_NEAR(stretches[1], 1.1, 1e-13);
  EXPECT_NEAR(stretches[2], 0.8, 1e-13);
}

TEST(ElementState, VonMisesStressIsTheAxialOneAndRootThreeTimesShear) {
  EXPECT_DOUBLE_EQ(von_mises_stress({-700.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 700.0);
  EXPECT_DOUBLE_EQ(von_mises_stress({0.0, 0.0, 0.0, 0.0, 100.0, 0.0}), std::sqrt(3.0) * 100.0);
  EXPECT_DOUBLE_EQ(von_mises_stress({5e3, 5e3, 5e3, 0.0, 0.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(hydrostatic_pressure({-1.0, -2.0, -3.0, 9.0, 9.0, 9.0}), 2.0);
}

}  // namespace
}  // namespace menger::fem
