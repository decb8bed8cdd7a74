#include "materials/laws/volumetric_energy.h"

#include <gtest/gtest.h>

#include <array>
#include <tuple>

namespace menger::materials {
namespace {

constexpr double kappa = 2.5e6;

template <class F>
void for_each_volume(F&& f) {
  std::apply([&](const auto&... volumes) { (f(volumes), ...); },
             std::tuple{QuadraticVolume{kappa}, LogSquaredVolume{kappa}, SimoTaylorVolume{kappa}});
}

TEST(VolumetricEnergy, DerivativesMatchCentralDifferences) {
  for_each_volume([](const auto& volume) {
    for (const double J : {0.5, 0.99, 1.0, 1.02, 1.7}) {
      const double h = 1e-5;
      EXPECT_NEAR(volume.derivative(J), (volume.energy(J + h) - volume.energy(J - h)) / (2.0 * h), 1e-8 * kappa) << J;
      EXPECT_NEAR(volume.second_derivative(J), (volume.derivative(J + h) - volume.derivative(J - h)) / (2.0 * h), 1e-8 * kappa);
    }
  });
}

TEST(VolumetricEnergy, IsAtRestWithTheBulkModulus) {
  for_each_volume([](const auto& volume) {
    EXPECT_EQ(volume.energy(1.0), 0.0);
    EXPECT_EQ(volume.derivative(1.0), 0.0);
    EXPECT_EQ(volume.second_derivative(1.0), kappa);
  });
}

TEST(VolumetricEnergy, KeepsItsDigitsNearRest) {
  for_each_volume([](const auto& volume) {
    for (const int power : {10, 20, 30, 40}) {
      const double theta = std::ldexp(1.0, -power);
      EXPECT_NEAR(volume.energy(1.0 + theta) / (0.5 * kappa * theta * theta), 1.0, 1.1 * theta + 1e-14) << power;
      EXPECT_NEAR(volume.derivative(1.0 + theta) / (kappa * theta), 1.0, 1.6 * theta + 1e-14) << power;
    }
  });
}

TEST(VolumetricEnergy, HasItsNamedForm) {
  EXPECT_NEAR(QuadraticVolume{kappa}.energy(1.2), 0.5 * kappa * 0.04, 1e-9 * kappa);
  EXPECT_NEAR(LogSquaredVolume{kappa}.energy(1.2), 0.5 * kappa * std::log(1.2) * std::log(1.2), 1e-9 * kappa);
  EXPECT_NEAR(SimoTaylorVolume{kappa}.energy(1.2), kappa * ((1.44 - 1.0) / 4.0 - 0.5 * std::log(1.2)), 1e-9 * kappa);
}

}  // namespace
}  // namespace menger::materials
