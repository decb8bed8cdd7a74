// Stresses of walls and blocks that are stretched alike everywhere, against closed forms of the laws.

#include <gtest/gtest.h>

#include "materials/laws/homogeneous_deformations.h"
#include "materials/laws/nearly_incompressible.h"
#include "tests/unit/fem/thin_walls/thin_wall_samples.h"

namespace menger::fem {
namespace {

using materials::HyperelasticLaw;
using materials::LoadingMode;

/// Nominal stresses along the axes of a box that is stretched along them: forces on its faces by their areas.
std::array<double, 3> nominal_stresses(ThinWallElement element, const ThinWallMaterial& material,
                                       const std::array<double, 3>& stretches) {
  const auto kernels = best_thin_wall_kernels<double>();
  const Grid grid = one_box();
  Patch<double> patch(kernels, element, grid);
  const std::vector<double> f = patch.forces(material, grid.displacements([&](const std::array<double, 3>& X) {
    return std::array{(stretches[0] - 1.0) * X[0], (stretches[1] - 1.0) * X[1], (stretches[2] - 1.0) * X[2]};
  }));
  EXPECT_FALSE(patch.outcome.is_inverted());
  std::array<double, 3> stresses{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double area = grid.lines[(i + 1) % 3][1] * grid.lines[(i + 2) % 3][1];
    for (std::size_t n = 0; n < 8; ++n)
      if ((n >> i & 1U) != 0) stresses[i] += f[3 * n + i] / area;
  }
  return stresses;
}

/// In the plane of a wall, whose volume is kept.
std::array<double, 2> plane_stresses(const ThinWallMaterial& material, double first, double second) {
  const auto stresses = nominal_stresses(ThinWallElement::wall, material, {first, second, 1.0 / (first * second)});
  EXPECT_NEAR(stresses[2], 0.0, 1e-12 * material.bulk_modulus_Pa);  // the penalty has nothing to do
  return {stresses[0], stresses[1]};
}

TEST(MembraneLaw, StressesAreTheClosedFormsOfEveryLaw) {
  for (const HyperelasticLaw& law : all_laws()) {
    SCOPED_TRACE(materials::name_of(law));
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    const ThinWallMaterial material{.law = law, .bulk_modulus_Pa = 1e7 * mu};
    for (const double stretch : {0.7, 0.95, 1.05, 1.3, 1.8}) {
      for (const LoadingMode mode : {LoadingMode::uniaxial, LoadingMode::equibiaxial, LoadingMode::planar}) {
        const auto stretches = materials::stretches_of(mode, stretch);
        const auto expected = materials::nominal_stress(law, mode, stretch);
        ASSERT_EQ(expected.status, materials::LawStatus::valid);
        const auto stresses = plane_stresses(material, stretches[0], stretches[1]);
        // stresses of up to 20 mu change the volume by 2e-6
        EXPECT_NEAR(stresses[0], expected.stress_Pa, 2e-5 * mu) << stretch;
        if (mode == LoadingMode::planar) continue;
        EXPECT_NEAR(stresses[1], mode == LoadingMode::uniaxial ? 0.0 : expected.stress_Pa, 2e-5 * mu) << stretch;
      }
    }
  }
}

/// Stresses of the law and kappa/2 (J - 1)^2 in three dimensions, with the stretch across at which nothing acts across.
template <class Law>
std::array<double, 2> three_dimensional(const Law& law, double bulk_modulus_Pa, double first, double second) {
  const materials::NearlyIncompressible<Law, materials::QuadraticVolume> material{law, {bulk_modulus_Pa}};
  const auto stress = [&](double third) {
    return materials::first_piola_stress(material,
                                         materials::Tensor<double>{{first, 0.0, 0.0, 0.0, second, 0.0, 0.0, 0.0, third}});
  };
  double low = 0.5 / (first * second);
  double high = 2.0 / (first * second);
  for (int n = 0; n < 80; ++n) {
    const double middle = 0.5 * (low + high);
    (stress(middle)(2, 2) > 0.0 ? high : low) = middle;
  }
  return {stress(low)(0, 0), stress(low)(1, 1)};
}

TEST(MembraneLaw, StretchAcrossIsThatOfPlaneStress) {
  for (const HyperelasticLaw& law : all_laws()) {
    SCOPED_TRACE(materials::name_of(law));
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    for (const double ratio : {10.0, 50.0}) {
      const ThinWallMaterial material{.law = law, .bulk_modulus_Pa = ratio * mu};
      // Solved for in all laws but the neo-Hookean, which is exact to first order in mu / kappa.
      const bool is_neo_hookean = law.index() == 0;
      for (const auto& [first, second] : {std::pair{1.2, 0.9}, std::pair{1.5, 1.3}, std::pair{0.8, 0.9}}) {
        const auto expected = std::visit([&](const auto& any) { return three_dimensional(any, ratio * mu, first, second); }, law);
        const auto stresses = plane_stresses(material, first, second);
        // the second order has a factor of 5 at these stretches
        const double tolerance = is_neo_hookean ? 5.0 * mu / (ratio * ratio) : 1e-9 * mu;
        EXPECT_NEAR(stresses[0], expected[0], tolerance) << ratio << ' ' << first;
        EXPECT_NEAR(stresses[1], expected[1], tolerance) << ratio << ' ' << first;
      }
    }
  }
}

TEST(MembraneLaw, SmallStrainHasThePlaneStressModuli) {
  const double strain = 1e-6;
  for (const HyperelasticLaw& law : all_laws()) {
    SCOPED_TRACE(materials::name_of(law));
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    for (const double ratio : {50.0, 500.0}) {
      const double kappa = ratio * mu;
      const double E = 9.0 * kappa * mu / (3.0 * kappa + mu);
      const double nu = (3.0 * kappa - 2.0 * mu) / (2.0 * (3.0 * kappa + mu));
      const auto stresses = plane_stresses({.law = law, .bulk_modulus_Pa = kappa}, 1.0 + strain, 1.0);
      // strains of second order; the neo-Hookean's second order in mu / kappa is 16/3
      const double tolerance = 1e-5 + (law.index() == 0 ? 6.0 / (ratio * ratio) : 0.0);
      EXPECT_NEAR(stresses[0] / strain, E / (1.0 - nu * nu), tolerance * mu);
      EXPECT_NEAR(stresses[1] / strain, nu * E / (1.0 - nu * nu), tolerance * mu);
    }
  }
}

TEST(MembraneLaw, ANeoHookeanIsAYeohWithoutTheRest) {
  const double mu = 50e3;
  for (const double stretch : {0.8, 1.1, 1.6}) {
    const auto neo_hookean = plane_stresses({.law = materials::NeoHookean{mu}, .bulk_modulus_Pa = 50.0 * mu}, stretch, 1.1);
    const auto yeoh = plane_stresses({.law = materials::Yeoh{0.5 * mu, 0.0, 0.0}, .bulk_modulus_Pa = 50.0 * mu}, stretch, 1.1);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(neo_hookean[i], yeoh[i], 5.0 * mu / 2500.0);  // second order, as above
  }
}

TEST(BlockLaw, SmallStrainHasLamesModuli) {
  const double strain = 1e-6;
  for (const HyperelasticLaw& law : all_laws()) {
    SCOPED_TRACE(materials::name_of(law));
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    const ThinWallMaterial material = silicone_of(law);
    const auto stresses = nominal_stresses(ThinWallElement::block, material, {1.0 + strain, 1.0, 1.0});
    EXPECT_NEAR(stresses[0] / strain, 7.0 * mu, 3e-5 * mu);  // lambda is 5 mu; strains of second order
    EXPECT_NEAR(stresses[1] / strain, 5.0 * mu, 3e-5 * mu);
    EXPECT_NEAR(stresses[2] / strain, 5.0 * mu, 3e-5 * mu);
  }
}

// Where the volume is kept, a pressure is all that a block may add to the law.
TEST(BlockLaw, StressDifferencesAreThoseOfTheLaw) {
  const std::array<double, 3> stretches{1.4, 0.9, 1.0 / (1.4 * 0.9)};
  for (const HyperelasticLaw& law : all_laws()) {
    SCOPED_TRACE(materials::name_of(law));
    const double mu = materials::shear_modulus_at_rest_Pa(law);
    const auto expected = materials::principal_derivatives(law, stretches);
    const auto stresses = nominal_stresses(ThinWallElement::block, silicone_of(law), stretches);
    for (std::size_t i = 0; i < 2; ++i) {
      const double difference = stresses[i] * stretches[i] - stresses[i + 1] * stretches[i + 1];
      EXPECT_NEAR(difference, expected.slopes[i] - expected.slopes[i + 1], 1e-12 * mu);  // rounding
    }
  }
}

}  // namespace
}  // namespace menger::fem
