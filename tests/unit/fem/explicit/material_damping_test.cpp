#include "fem/explicit/material_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

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

// The published law of Ecoflex 00-30, mu (1 + (i w 330 us)^0.32), whose loss factor rises from 0.06 at 1 Hz to 0.15 at 30 Hz.
// SciPy's nnls for the same rates leaves 3.4 % between the frequencies of the data, at 2.4 Hz, and less elsewhere. One branch
// that damps as the law does at 30 Hz has less than a quarter of its loss factor at 1 Hz.
TEST(MaterialDamping, BranchesFollowALossFactorThatRises) {
  const auto law = [](double frequency_Hz) {
    const std::complex<double> added = std::pow(std::complex<double>(0.0, 2.0 * std::numbers::pi * frequency_Hz * 330e-6), 0.32);
    return added.imag() / (1.0 + added.real());
  };
  std::vector<materials::LossPoint> points;
  for (const double frequency_Hz : {1.0, 5.0, 10.0, 30.0}) points.push_back({law(frequency_Hz), frequency_Hz});
  const std::vector<MaxwellBranch> branches = maxwell_branches(80e3, materials::loss_data("test", points));
  ASSERT_EQ(branches.size(), 3U);
  for (double frequency_Hz = 1.0; frequency_Hz <= 30.0; frequency_Hz *= 1.1)
    EXPECT_NEAR(loss_factor(80e3, branches, frequency_Hz) / law(frequency_Hz), 1.0, 0.0345) << frequency_Hz;
  const std::vector<MaxwellBranch> one = maxwell_branches(80e3, {.source = "test", .tan_delta = law(30.0), .frequency_Hz = 30.0});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(loss_factor(80e3, one, 30.0), law(30.0), 1e-14);
  EXPECT_LT(loss_factor(80e3, one, 1.0), 0.25 * law(1.0));
}

// Data that two branches at the expected rates have made are met exactly; a loss factor that falls faster than any branch leaves
// branches out, and none has a negative modulus.
TEST(MaterialDamping, BranchesAreThoseOfTheData) {
  const auto time_s = [](double frequency_Hz) { return 1.0 / (2.0 * std::numbers::pi * frequency_Hz); };
  const std::vector<MaxwellBranch> made{{8e3, time_s(2.0)}, {16e3, time_s(1.5 * 20.0)}};
  const std::vector<MaxwellBranch> found = maxwell_branches(
      80e3, materials::loss_data("test", {{loss_factor(80e3, made, 2.0), 2.0}, {loss_factor(80e3, made, 20.0), 20.0}}));
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(found[k].shear_modulus_Pa, made[k].shear_modulus_Pa, 1e-9 * made[k].shear_modulus_Pa);
    EXPECT_NEAR(found[k].relaxation_time_s, made[k].relaxation_time_s, 1e-14 * made[k].relaxation_time_s);
  }
  const std::vector<MaxwellBranch> falling = maxwell_branches(80e3, materials::loss_data("test", {{0.3, 1.0}, {0.001, 30.0}}));
  ASSERT_EQ(falling.size(), 1U);
  EXPECT_GT(falling[0].shear_modulus_Pa, 0.0);
  EXPECT_TRUE(maxwell_branches(80e3, {.source = "test", .tan_delta = 0.0, .frequency_Hz = 5.0}).empty());
}

}  // namespace
}  // namespace menger::fem
