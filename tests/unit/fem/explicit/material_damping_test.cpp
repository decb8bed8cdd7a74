#include "fem/explicit/material_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace menger::fem {
namespace {

TEST(MaterialDamping, LossFactorAtItsFrequencyIsThatOfTheData) {
  const materials::LossData loss{.source = "test", .tan_delta = 0.2, .frequency_Hz = 5.0};
  // loss modulus over storage modulus of small shear, omega eta / mu
  EXPECT_NEAR(2.0 * std::numbers::pi * 5.0 * viscosity_Pa_s(80e3, loss) / 80e3, 0.2, 1e-15);
}

// g w tau / (1 + (1 + g) w^2 tau^2) at w = 2 pi f is the data's, and less on both sides; half as much where that formula says so.
TEST(MaterialDamping, BranchDampsMostAtTheFrequencyOfTheData) {
  for (const double tan_delta : {0.05, 0.1, 0.5}) {
    const MaxwellBranch branch = maxwell_branch(80e3, {.source = "test", .tan_delta = tan_delta, .frequency_Hz = 5.0});
    const auto loss_factor = [&](double frequency_Hz) {
      const double g = branch.shear_modulus_Pa / 80e3;
      const double number = 2.0 * std::numbers::pi * frequency_Hz * branch.relaxation_time_s;
      return g * number / (1.0 + (1.0 + g) * number * number);
    };
    EXPECT_NEAR(loss_factor(5.0), tan_delta, 1e-14);
    EXPECT_LT(loss_factor(4.9), tan_delta);
    EXPECT_LT(loss_factor(5.1), tan_delta);
    EXPECT_NEAR(loss_factor(5.0 * (2.0 + std::sqrt(3.0))), 0.5 * tan_delta, 1e-14);
  }
  EXPECT_FALSE(maxwell_branch(80e3, {.source = "test", .tan_delta = 0.0, .frequency_Hz = 5.0}).is_there());
}

}  // namespace
}  // namespace menger::fem
