#include "materials/laws/stability.h"

#include <gtest/gtest.h>

#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

TEST(Stability, LawsWithPositiveTermsAreStableEverywhere) {
  for (const LoadingMode mode : {LoadingMode::uniaxial, LoadingMode::equibiaxial, LoadingMode::planar}) {
    for_each_law([&](const auto& law) {
      if (name_of(law) == "gent") return;
      EXPECT_EQ(first_unstable_stretch(law, mode, 10.0), std::nullopt) << name_of(law);
    });
  }
}

/// Fits of a silicone whose first unstable stretches were found with other code on a grid of 0.01.
TEST(Stability, FindsTheKnownFirstUnstableStretches) {
  const Yeoh yeoh{20446.40842, 4473.011129, -534.0704709};
  EXPECT_NEAR(*first_unstable_stretch(yeoh, LoadingMode::uniaxial, 10.0), 2.57, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(yeoh, LoadingMode::equibiaxial, 10.0), 1.89, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(yeoh, LoadingMode::planar, 10.0), 2.48, 0.011);
  const MooneyRivlin mooney{49084.55397, -35110.00717};
  EXPECT_NEAR(*first_unstable_stretch(mooney, LoadingMode::uniaxial, 10.0), 1.19, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(mooney, LoadingMode::equibiaxial, 10.0), 1.09, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(mooney, LoadingMode::planar, 10.0), 1.16, 0.011);
}

TEST(Stability, EndsWhereGentsLawDoes) {
  const Gent law{45780.03569, 6.389523004};
  EXPECT_NEAR(*first_unstable_stretch(law, LoadingMode::uniaxial, 10.0), 2.96, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(law, LoadingMode::equibiaxial, 10.0), 2.17, 0.011);
  EXPECT_NEAR(*first_unstable_stretch(law, LoadingMode::planar, 10.0), 2.88, 0.011);
  EXPECT_EQ(first_unstable_stretch(law, LoadingMode::equibiaxial, 2.0), std::nullopt);
}

/// Compression in one mode is tension in another, in which the same laws were looked at.
TEST(Stability, CompressionIsTensionInAnotherMode) {
  const Yeoh yeoh{20446.40842, 4473.011129, -534.0704709};
  const Gent gent{45780.03569, 6.389523004};
  for (const HyperelasticLaw& law : {HyperelasticLaw(yeoh), HyperelasticLaw(gent)}) {
    EXPECT_EQ(first_unstable_stretch(law, LoadingMode::uniaxial, 0.3), std::nullopt);  // 1.83 in equibiaxial tension
    const double planar = *first_unstable_stretch(law, LoadingMode::planar, 0.3);
    EXPECT_NEAR(1.0 / planar, *first_unstable_stretch(law, LoadingMode::planar, 10.0), 0.05);  // a grid step is 0.04 there
    const double equibiaxial = *first_unstable_stretch(law, LoadingMode::equibiaxial, 0.3);
    EXPECT_NEAR(std::pow(equibiaxial, -2), *first_unstable_stretch(law, LoadingMode::uniaxial, 10.0), 0.05);
  }
  EXPECT_EQ(first_unstable_stretch(MooneyRivlin{20e3, 5e3}, LoadingMode::equibiaxial, 0.3), std::nullopt);
}

TEST(Stability, NegativeModulusIsUnstableAtRest) {
  EXPECT_EQ(first_unstable_stretch(NeoHookean{-1.0}, LoadingMode::uniaxial, 2.0), 1.0);
}

TEST(Stability, KnowsTheBiaxialRatioOfNeoHookean) {
  const double l = 1.5;
  const double expected = (l - std::pow(l, -5)) / (l - std::pow(l, -2));
  EXPECT_NEAR(*equibiaxial_ratio(NeoHookean{50e3}, l), expected, 1e-12);
  EXPECT_EQ(equibiaxial_ratio(Gent{50e3, 1.0}, 1.5), std::nullopt);
  EXPECT_EQ(equibiaxial_ratio(NeoHookean{50e3}, 1.0), std::nullopt);
}

}  // namespace
}  // namespace menger::materials
