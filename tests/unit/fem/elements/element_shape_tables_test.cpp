#include "fem/elements/element_shape_tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace menger::fem {
namespace {

double power(double x, std::size_t exponent) {
  double result = 1.0;
  for (std::size_t n = 0; n < exponent; ++n) result *= x;
  return result;
}

double slope(double x, std::size_t exponent) {
  return exponent == 0 ? 0.0 : static_cast<double>(exponent) * power(x, exponent - 1);
}

/// Node of the reference cube [-1, 1]^3.
template <int degree>
std::array<double, 3> node(std::size_t a) {
  constexpr std::size_t side = degree + 1;
  const auto at = [](std::size_t n) { return 2.0 * static_cast<double>(n) / degree - 1.0; };
  return {at(a % side), at(a / side % side), at(a / (side * side))};
}

/// The point of the Gauss rule, found from the values of the linear functions rather than from the rule.
template <int degree>
std::array<double, 3> point(std::size_t q) {
  constexpr auto shape = element_shape_tables<degree>();
  std::array<double, 3> x{};
  for (std::size_t a = 0; a < shape.nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) x[i] += shape.value[q][a] * node<degree>(a)[i];
  return x;
}

// The monomials up to the degree in each direction span the shape functions, so these equations leave no value or slope free.
// Tolerance: rounding of 27 terms of about 1.
template <int degree>
void expect_monomials_to_be_interpolated() {
  constexpr auto shape = element_shape_tables<degree>();
  constexpr std::size_t side = degree + 1;
  for (std::size_t monomial = 0; monomial < shape.nodes; ++monomial) {
    const std::array<std::size_t, 3> e{monomial % side, monomial / side % side, monomial / (side * side)};
    for (std::size_t q = 0; q < shape.points; ++q) {
      double value = 0.0;
      std::array<double, 3> gradient{};
      for (std::size_t a = 0; a < shape.nodes; ++a) {
        const auto X = node<degree>(a);
        const double nodal = power(X[0], e[0]) * power(X[1], e[1]) * power(X[2], e[2]);
        value += shape.value[q][a] * nodal;
        for (std::size_t i = 0; i < 3; ++i) gradient[i] += shape.gradient[q][a][i] * nodal;
      }
      const auto x = point<degree>(q);
      EXPECT_NEAR(value, power(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2]), 1e-14);
      EXPECT_NEAR(gradient[0], slope(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2]), 1e-13);
      EXPECT_NEAR(gradient[1], power(x[0], e[0]) * slope(x[1], e[1]) * power(x[2], e[2]), 1e-13);
      EXPECT_NEAR(gradient[2], power(x[0], e[0]) * power(x[1], e[1]) * slope(x[2], e[2]), 1e-13);
    }
  }
}

TEST(ElementShapeTables, InterpolateEveryMonomialOfTheirDegree) {
  expect_monomials_to_be_interpolated<1>();
  expect_monomials_to_be_interpolated<2>();
}

template <int degree>
void expect_partition_of_unity() {
  constexpr auto shape = element_shape_tables<degree>();
  for (std::size_t q = 0; q < shape.points; ++q) {
    double value = 0.0;
    std::array<double, 3> gradient{};
    for (std::size_t a = 0; a < shape.nodes; ++a) {
      value += shape.value[q][a];
      for (std::size_t i = 0; i < 3; ++i) gradient[i] += shape.gradient[q][a][i];
    }
    EXPECT_NEAR(value, 1.0, 1e-15 * shape.nodes);
    for (const double component : gradient) EXPECT_NEAR(component, 0.0, 1e-15 * shape.nodes);
  }
}

TEST(ElementShapeTables, SumUpToOneWithoutSlope) {
  expect_partition_of_unity<1>();
  expect_partition_of_unity<2>();
}

// m points of Gauss's rule integrate polynomials of degree 2 m - 1 in each direction; the next even degree they do not.
template <int degree>
void expect_gauss_to_be_exact() {
  constexpr auto shape = element_shape_tables<degree>();
  constexpr std::size_t exact = 2 * degree + 1;
  for (std::size_t e = 0; e <= exact + 1; ++e) {
    for (std::size_t i = 0; i < 3; ++i) {
      double integral = 0.0;
      for (std::size_t q = 0; q < shape.points; ++q) {
        const auto x = point<degree>(q);
        integral += shape.weight[q] * power(x[i], e) * power(x[(i + 1) % 3], 2);
      }
      const double truth = e % 2 == 1 ? 0.0 : 2.0 / (static_cast<double>(e) + 1.0) * (2.0 / 3.0) * 2.0;
      if (e <= exact) {
        EXPECT_NEAR(integral, truth, 1e-14 * static_cast<double>(shape.points));
      } else {
        EXPECT_GT(std::abs(integral - truth), 1e-2);
      }
    }
  }
}

TEST(ElementShapeTables, IntegrateWithTheExactnessOfGauss) {
  expect_gauss_to_be_exact<1>();
  expect_gauss_to_be_exact<2>();
}

TEST(ElementShapeTables, HaveOneConstantModeAndForDegreeTwoTheCoordinates) {
  constexpr auto linear = element_shape_tables<1>();
  constexpr auto quadratic = element_shape_tables<2>();
  for (std::size_t q = 0; q < linear.points; ++q) EXPECT_EQ(linear.mode[q][0], 1.0);
  for (std::size_t q = 0; q < quadratic.points; ++q) {
    EXPECT_EQ(quadratic.mode[q][0], 1.0);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(quadratic.mode[q][i + 1], point<2>(q)[i], 1e-14);
  }
}

}  // namespace
}  // namespace menger::fem
