#include "fem/elements/element_condensation.h"

#include <gtest/gtest.h>

#include "tests/unit/fem/elements/element_samples.h"

namespace menger::fem {
namespace {

template <int degree>
using Projection = detail::ModeProjection<degree, double>;

/// Positive volumes of the points, as different as in a badly distorted element.
template <int degree>
std::array<double, Projection<degree>::points> uneven_volumes() {
  std::array<double, Projection<degree>::points> volumes{};
  RandomNumbers random(11);
  for (double& volume : volumes) volume = 1.0 + random(0.6);
  return volumes;
}

template <int degree>
std::array<double, Projection<degree>::points> some_values(unsigned seed) {
  std::array<double, Projection<degree>::points> values{};
  RandomNumbers random(seed);
  for (double& value : values) value = random(1.0);
  return values;
}

// Tolerances of this file: rounding of the 4x4 inverse, whose condition is below 100.

template <int degree>
void expect_modes_to_be_kept() {
  const Projection<degree> projection(uneven_volumes<degree>());
  constexpr auto shape = element_shape_tables<degree>();
  std::array<double, shape.points> field{};
  for (std::size_t q = 0; q < shape.points; ++q)
    for (std::size_t m = 0; m < shape.modes; ++m) field[q] += (1.0 + static_cast<double>(m)) * shape.mode[q][m];
  const auto projected = projection.project(field);
  for (std::size_t q = 0; q < shape.points; ++q) EXPECT_NEAR(projected[q], field[q], 1e-13);
}

TEST(ModeProjection, KeepsWhatTheModesCanExpress) {
  expect_modes_to_be_kept<1>();
  expect_modes_to_be_kept<2>();
}

template <int degree>
void expect_remainder_to_be_orthogonal() {
  constexpr auto shape = element_shape_tables<degree>();
  const auto volumes = uneven_volumes<degree>();
  const Projection<degree> projection(volumes);
  const auto values = some_values<degree>(3);
  const auto projected = projection.project(values);
  double largest_remainder = 0.0;
  for (std::size_t m = 0; m < shape.modes; ++m) {
    double moment = 0.0;
    for (std::size_t q = 0; q < shape.points; ++q) {
      moment += volumes[q] * (values[q] - projected[q]) * shape.mode[q][m];
      largest_remainder = std::max(largest_remainder, std::abs(values[q] - projected[q]));
    }
    EXPECT_NEAR(moment, 0.0, 1e-13);
  }
  EXPECT_GT(largest_remainder, 0.1);  // otherwise the claim is empty
}

TEST(ModeProjection, LeavesARemainderOrthogonalToTheModes) {
  expect_remainder_to_be_orthogonal<1>();
  expect_remainder_to_be_orthogonal<2>();
}

// With the moments g_m of any field f, g . (M^-1 H M^-1) g is the integral of value times (projection of f)^2.
template <int degree>
void expect_sandwich_to_weigh_projections() {
  constexpr auto shape = element_shape_tables<degree>();
  const auto volumes = uneven_volumes<degree>();
  const Projection<degree> projection(volumes);
  const auto value = some_values<degree>(4);
  const auto sandwich = projection.sandwiched(value);
  for (unsigned seed = 5; seed < 12; ++seed) {
    const auto f = some_values<degree>(seed);
    const auto projected = projection.project(f);
    std::array<double, shape.modes> moment{};
    double integral = 0.0;
    for (std::size_t q = 0; q < shape.points; ++q) {
      for (std::size_t m = 0; m < shape.modes; ++m) moment[m] += volumes[q] * f[q] * shape.mode[q][m];
      integral += volumes[q] * value[q] * projected[q] * projected[q];
    }
    double form = 0.0;
    for (std::size_t m = 0; m < shape.modes; ++m)
      for (std::size_t n = 0; n < shape.modes; ++n) form += moment[m] * sandwich[m][n] * moment[n];
    EXPECT_NEAR(form, integral, 1e-12);
  }
  for (std::size_t m = 0; m < shape.modes; ++m)
    for (std::size_t n = 0; n < m; ++n) EXPECT_EQ(sandwich[m][n], sandwich[n][m]);
}

TEST(ModeProjection, SandwichIsTheWeightedSquareOfProjections) {
  expect_sandwich_to_weigh_projections<1>();
  expect_sandwich_to_weigh_projections<2>();
}

}  // namespace
}  // namespace menger::fem
