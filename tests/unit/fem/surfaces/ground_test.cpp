#include "fem/surfaces/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/unit/fem/surfaces/face_samples.h"

namespace menger::fem {
namespace {

constexpr GroundPlane ground{.height_m = 0.25, .stiffness_Pa_per_m = 3e4};

/// A bent face in its reference configuration, and the same lowered partly into the ground.
template <std::size_t n>
struct SampleContact {
  FaceNodes<n> reference;
  FaceNodes<n> current;
};

template <std::size_t n>
SampleContact<n> sample_contact() {
  SampleSurface<n> surface;
  add_rectangle(surface, {0.1, 0.2, 0.1}, {0.2, 0.9, 0.3}, {0.8, 0.1, 0.2}, 1, 1);
  SampleContact<n> contact;
  contact.reference = surface.positions(0);
  surface.deform(bent);
  contact.current = surface.positions(0);
  for (Point& p : contact.current) p[2] -= 0.15;
  return contact;
}

/// A tilted unit square z = slope x - depth over the ground, as `cells` faces along x.
template <std::size_t n>
SampleSurface<n> tilted_plate(std::size_t cells, double slope, double depth) {
  SampleSurface<n> surface;
  add_rectangle(surface, {0.0, 0.0, ground.height_m - depth}, {0.0, 1.0, 0.0}, {1.0, 0.0, slope}, 1, cells);
  return surface;
}

template <std::size_t n>
SampleSurface<n> level_plate(std::size_t cells) {
  SampleSurface<n> surface;
  add_rectangle(surface, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, 1, cells);
  return surface;
}

/// Sinks by d = depth - slope x over the reference area 1: E = eps/2 int d^2, F = eps int d, exact for the rule.
template <std::size_t n>
void expect_sunken_plate() {
  const double depth = 0.3;
  const double slope = 0.2;
  const auto reference = level_plate<n>(1).positions(0);
  const auto current = tilted_plate<n>(1, slope, depth).positions(0);
  const double end = depth - slope;
  EXPECT_NEAR(ground_energy_J(ground, reference, current), 0.5 * 3e4 * (depth * depth * depth - end * end * end) / (3.0 * slope),
              1e-11);
  EXPECT_NEAR(ground_force_N(ground, reference, current), 3e4 * (depth - 0.5 * slope), 1e-11);
}

TEST(Ground, PressesAPlateBelowItAsAPolynomialSays) {
  expect_sunken_plate<4>();
  expect_sunken_plate<9>();
}

TEST(Ground, LeavesWhatIsAboveItAlone) {
  const auto reference = level_plate<4>(1).positions(0);
  const auto current = tilted_plate<4>(1, 0.2, -1e-9).positions(0);
  EXPECT_EQ(ground_energy_J(ground, reference, current), 0.0);
  EXPECT_EQ(ground_force_N(ground, reference, current), 0.0);
  EXPECT_EQ(ground_gradient_N(ground, reference, current), (std::array<double, 4>{}));
  EXPECT_EQ(ground_hessian(ground, reference, current), (std::array<double, 16>{}));
}

/// A plate that rises out of the ground at x = 0.37: E = eps depth^3 / (6 slope), F = eps depth^2 / (2 slope). The kink sits
/// inside one face, so with faces of size h the force is off by at most eps slope h^2 and the energy by less.
template <std::size_t n>
void expect_partly_sunken_plate() {
  const double slope = 0.5;
  const double depth = 0.37 * slope;
  for (const std::size_t cells : {1U, 4U, 16U, 64U}) {
    const auto reference = level_plate<n>(cells);
    const auto current = tilted_plate<n>(cells, slope, depth);
    double energy = 0.0;
    double force = 0.0;
    for (std::size_t f = 0; f < cells; ++f) {
      energy += ground_energy_J(ground, reference.positions(f), current.positions(f));
      force += ground_force_N(ground, reference.positions(f), current.positions(f));
    }
    const double h = 1.0 / static_cast<double>(cells);
    // Gauss's rule of 3 or 4 points misses at most a tenth of the square that the kink cuts off.
    EXPECT_NEAR(force, 3e4 * depth * depth / (2.0 * slope), 0.1 * 3e4 * slope * h * h) << cells;
    EXPECT_NEAR(energy, 3e4 * depth * depth * depth / (6.0 * slope), 0.1 * 3e4 * slope * slope * h * h * h) << cells;
  }
}

TEST(Ground, ApproachesTheClosedFormOfAPlatePartlyInIt) {
  expect_partly_sunken_plate<4>();
  expect_partly_sunken_plate<9>();
}

/// Steps of 1e-6 m: truncation 0 except where a point of the rule touches down, of which there is none in a step here; rounding
/// 1e-16 E / h ~ 1e-8 N.
template <std::size_t n>
void expect_ground_gradient_by_differences() {
  const auto [reference, current] = sample_contact<n>();
  const auto gradient = ground_gradient_N(ground, reference, current);
  const double h = 1e-6;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t i = 0; i < 3; ++i) {
      auto plus = current;
      auto minus = current;
      plus[a][i] += h;
      minus[a][i] -= h;
      const double difference =
          (ground_energy_J(ground, reference, plus) - ground_energy_J(ground, reference, minus)) / (2.0 * h);
      EXPECT_NEAR(i == 2 ? gradient[a] : 0.0, difference, 1e-6) << a << " " << i;
    }
  }
  const double force = ground_force_N(ground, reference, current);
  EXPECT_GT(force, 1.0);
  EXPECT_NEAR(std::accumulate(gradient.begin(), gradient.end(), 0.0), -force, 1e-13 * force);
}

TEST(Ground, GradientMatchesDifferencesAndSumsToTheForce) {
  expect_ground_gradient_by_differences<4>();
  expect_ground_gradient_by_differences<9>();
}

template <std::size_t n>
void expect_ground_hessian_by_differences() {
  const auto [reference, current] = sample_contact<n>();
  const auto hessian = ground_hessian(ground, reference, current);
  const double h = 1e-6;
  for (std::size_t b = 0; b < n; ++b) {
    auto plus = current;
    auto minus = current;
    plus[b][2] += h;
    minus[b][2] -= h;
    const auto high = ground_gradient_N(ground, reference, plus);
    const auto low = ground_gradient_N(ground, reference, minus);
    for (std::size_t a = 0; a < n; ++a) {
      EXPECT_NEAR(hessian[a * n + b], (high[a] - low[a]) / (2.0 * h), 1e-5);
      EXPECT_EQ(hessian[a * n + b], hessian[b * n + a]);
    }
  }
  EXPECT_GT(*std::max_element(hessian.begin(), hessian.end()), 10.0);
}

TEST(Ground, HessianMatchesDifferences) {
  expect_ground_hessian_by_differences<4>();
  expect_ground_hessian_by_differences<9>();
}

}  // namespace
}  // namespace menger::fem
