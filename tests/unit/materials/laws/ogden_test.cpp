#include <gtest/gtest.h>

#include "materials/laws/ogden_response.h"
#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

/// Neo-Hookean written as Ogden's law, alpha = 2 and mu = the shear modulus: the same response by another route.
const Ogden<1> neo_hookean_as_ogden{{OgdenTerm{50e3, 2.0}}};

/// Mooney-Rivlin written as Ogden's law: 2 C10 with alpha = 2 and -2 C01 with alpha = -2.
const Ogden<2> mooney_rivlin_as_ogden{{OgdenTerm{40e3, 2.0}, OgdenTerm{-10e3, -2.0}}};

/// Rotated deformations with two or three stretches equal, or apart by 1e-15 to 1e-2.
std::vector<Tensor<double>> nearly_repeated_stretches() {
  std::vector<Tensor<double>> result;
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-2}) {
    for (const Tensor<double>& stretch : {diagonal(1.0 + gap, 1.0, 1.0 - gap), diagonal(1.6, 1.6 + gap, 0.4),
                                          diagonal(0.7, 0.7 + gap, 2.1), diagonal(2.5, 2.5 + gap, 2.5 - gap)}) {
      result.push_back(stretch);
      result.push_back(product(rotation(0.9), product(stretch, rotation(0.4))));
    }
  }
  return result;
}

TEST(OgdenLaw, WithExponentTwoIsNeoHookeanForAnySpacingOfTheStretches) {
  const NeoHookean direct{50e3};
  for (const Tensor<double>& F : nearly_repeated_stretches()) {
    const Kinematics<double> k = kinematics_of(F);
    const auto expected = stress_and_tangent(direct, k);
    const auto result = stress_and_tangent(neo_hookean_as_ogden, k);
    EXPECT_LT(distance(result.stress.components, expected.stress.components), 1e-13 * 50e3 * 6);
    EXPECT_LT(distance(result.tangent.components, expected.tangent.components), 1e-13 * 50e3 * 6);
    EXPECT_NEAR(strain_energy_density(neo_hookean_as_ogden, k), strain_energy_density(direct, k), 1e-13 * 50e3);
  }
}

TEST(OgdenLaw, WithExponentsPlusAndMinusTwoIsMooneyRivlin) {
  const MooneyRivlin direct{20e3, 5e3};
  for (const Tensor<double>& F : nearly_repeated_stretches()) {
    const Kinematics<double> k = kinematics_of(F);
    const auto expected = stress_and_tangent(direct, k);
    const auto result = stress_and_tangent(mooney_rivlin_as_ogden, k);
    EXPECT_LT(distance(result.stress.components, expected.stress.components), 1e-12 * 50e3);
    EXPECT_LT(distance(result.tangent.components, expected.tangent.components), 1e-12 * 50e3);
    EXPECT_NEAR(strain_energy_density(mooney_rivlin_as_ogden, k), strain_energy_density(direct, k), 1e-13 * 50e3);
  }
}

/// The limit must hold for exponents that are no even integers too.
TEST(OgdenLaw, TangentIsTheDifferenceOfTheStressAtRepeatedStretches) {
  const Ogden<3> law{{OgdenTerm{10e3, 2.7}, OgdenTerm{20e3, 1.3}, OgdenTerm{-3e3, -2.5}}};
  for (const Tensor<double>& F : nearly_repeated_stretches()) {
    const auto result = stress_and_tangent(law, kinematics_of(F));
    for (std::size_t n = 0; n < 9; ++n) {
      const double h = 1e-5;
      Tensor<double> up = F;
      Tensor<double> down = F;
      up.components[n] += h;
      down.components[n] -= h;
      const Tensor<double> above = first_piola_stress(law, kinematics_of(up));
      const Tensor<double> below = first_piola_stress(law, kinematics_of(down));
      for (std::size_t m = 0; m < 9; ++m) {
        const double expected = (above.components[m] - below.components[m]) / (2.0 * h);
        EXPECT_NEAR(result.tangent(m, n), expected, 2e-8 * largest(result.tangent.components));
      }
    }
  }
}

TEST(OgdenLaw, ConvertsTheConventionInWhichModuliAddUp) {
  const OgdenTerm term = OgdenTerm::from_shear_modulus(40.22206281e3, 3.252772413);
  EXPECT_NEAR(term.modulus_Pa, 24.73094192e3, 1e-5);
  EXPECT_NEAR(term.part_of_shear_modulus_Pa(), 40.22206281e3, 1e-9);
}

}  // namespace
}  // namespace menger::materials
