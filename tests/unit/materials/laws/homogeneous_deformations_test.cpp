#include "materials/laws/homogeneous_deformations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

const std::array<LoadingMode, 3> modes{LoadingMode::uniaxial, LoadingMode::equibiaxial, LoadingMode::planar};

/// Nominal stress from the first Piola stress of the three-dimensional law: P = P_1 - P_3 l_3 / l_1, since the pressure that
/// frees the last face adds p / l_a to P_a.
template <class Law>
double from_tensor(const Law& law, LoadingMode mode, double stretch) {
  const std::array<double, 3> l = stretches_of(mode, stretch);
  const Tensor<double> P = first_piola_stress(law, kinematics_of(diagonal(l[0], l[1], l[2])));
  return P(0, 0) - P(2, 2) * l[2] / l[0];
}

TEST(HomogeneousDeformations, AgreeWithTheThreeDimensionalLaws) {
  for_each_law([](const auto& law) {
    for (const LoadingMode mode : modes) {
      for (const double stretch : {0.5, 0.9, 1.0, 1.001, 1.3, 1.9}) {
        const NominalStress stress = nominal_stress(law, mode, stretch);
        EXPECT_EQ(stress.status, LawStatus::valid);
        const double expected = from_tensor(law, mode, stretch);
        EXPECT_NEAR(stress.stress_Pa, expected, 1e-12 * std::abs(expected) + 1e-8) << name_of(law) << stretch;
      }
    }
  });
}

/// The formulas as textbooks print them, with W_i = dW/dI_i; nominal stress = Cauchy stress / l.
TEST(HomogeneousDeformations, FollowTheClosedForms) {
  const double c10 = 20e3;
  const double c01 = 5e3;
  const MooneyRivlin law{c10, c01};
  for (const double l : {0.6, 1.2, 2.5}) {
    const double uniaxial = 2.0 * (l * l - 1.0 / l) * (c10 + c01 / l) / l;
    const double equibiaxial = 2.0 * (l * l - std::pow(l, -4)) * (c10 + l * l * c01) / l;
    const double planar = 2.0 * (l * l - 1.0 / (l * l)) * (c10 + c01) / l;
    EXPECT_NEAR(nominal_stress(law, LoadingMode::uniaxial, l).stress_Pa, uniaxial, 1e-12 * std::abs(uniaxial));
    EXPECT_NEAR(nominal_stress(law, LoadingMode::equibiaxial, l).stress_Pa, equibiaxial, 1e-12 * std::abs(equibiaxial));
    EXPECT_NEAR(nominal_stress(law, LoadingMode::planar, l).stress_Pa, planar, 1e-12 * std::abs(planar));
  }
}

TEST(HomogeneousDeformations, FollowTheClosedFormsOfOgden) {
  const Ogden<2> law{{OgdenTerm{60e3, 1.5}, OgdenTerm{-2.5e3, -4.0}}};
  for (const double l : {0.6, 1.2, 2.5}) {
    double uniaxial = 0.0;
    double equibiaxial = 0.0;
    double planar = 0.0;
    for (const auto& [mu, a] : law.terms) {
      uniaxial += mu * (std::pow(l, a - 1.0) - std::pow(l, -0.5 * a - 1.0));
      equibiaxial += mu * (std::pow(l, a - 1.0) - std::pow(l, -2.0 * a - 1.0));
      planar += mu * (std::pow(l, a - 1.0) - std::pow(l, -a - 1.0));
    }
    EXPECT_NEAR(nominal_stress(law, LoadingMode::uniaxial, l).stress_Pa, uniaxial, 1e-12 * std::abs(uniaxial));
    EXPECT_NEAR(nominal_stress(law, LoadingMode::equibiaxial, l).stress_Pa, equibiaxial, 1e-12 * std::abs(equibiaxial));
    EXPECT_NEAR(nominal_stress(law, LoadingMode::planar, l).stress_Pa, planar, 1e-12 * std::abs(planar));
  }
}

TEST(HomogeneousDeformations, StartWithTheModuliOfSmallStrain) {
  for_each_law([](const auto& law) {
    const double mu = law.shear_modulus_at_rest_Pa();
    const double strain = 1e-7;
    EXPECT_NEAR(nominal_stress(law, LoadingMode::uniaxial, 1.0 + strain).stress_Pa / strain, 3.0 * mu, 1e-5 * mu);
    EXPECT_NEAR(nominal_stress(law, LoadingMode::equibiaxial, 1.0 + strain).stress_Pa / strain, 6.0 * mu, 1e-5 * mu);
    EXPECT_NEAR(nominal_stress(law, LoadingMode::planar, 1.0 + strain).stress_Pa / strain, 4.0 * mu, 1e-5 * mu);
  });
}

/// Curvatures are the slopes of the slopes along any incompressible path.
TEST(HomogeneousDeformations, CurvaturesMatchDifferencesOfTheSlopes) {
  for_each_law([](const auto& law) {
    const std::array<double, 3> start{1.4, 1.1, 1.0 / (1.4 * 1.1)};
    const std::array<double, 3> direction{0.6, 0.3, -0.9};
    const double h = 1e-5;
    std::array<double, 3> up{};
    std::array<double, 3> down{};
    for (std::size_t a = 0; a < 3; ++a) {
      up[a] = start[a] * std::exp(h * direction[a]);
      down[a] = start[a] * std::exp(-h * direction[a]);
    }
    const PrincipalDerivatives middle = principal_derivatives(law, start);
    const PrincipalDerivatives above = principal_derivatives(law, up);
    const PrincipalDerivatives below = principal_derivatives(law, down);
    for (std::size_t a = 0; a < 3; ++a) {
      double expected = 0.0;
      for (std::size_t b = 0; b < 3; ++b) expected += middle.curvatures[a][b] * direction[b];
      EXPECT_NEAR((above.slopes[a] - below.slopes[a]) / (2.0 * h), expected, 1e-3) << name_of(law);
    }
  });
}

TEST(HomogeneousDeformations, ReportGentsLimitAsAStatus) {
  const Gent law{50e3, 6.0};  // uniaxial limit: l^2 + 2/l = 9
  EXPECT_EQ(nominal_stress(law, LoadingMode::uniaxial, 2.88).status, LawStatus::valid);
  const NominalStress beyond = nominal_stress(law, LoadingMode::uniaxial, 2.9);
  EXPECT_EQ(beyond.status, LawStatus::locking_stretch_exceeded);
  EXPECT_EQ(beyond.stress_Pa, 0.0);
  EXPECT_EQ(nominal_stress(law, LoadingMode::equibiaxial, 2.2).status, LawStatus::locking_stretch_exceeded);
  EXPECT_EQ(nominal_stress(law, LoadingMode::uniaxial, 0.0).status, LawStatus::inverted);
  EXPECT_EQ(nominal_stress(law, LoadingMode::uniaxial, -1.0).status, LawStatus::inverted);
}

}  // namespace
}  // namespace menger::materials
