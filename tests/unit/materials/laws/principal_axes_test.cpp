#include "materials/laws/principal_axes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/materials/laws/law_samples.h"

namespace menger::materials {
namespace {

/// Q diag(values) Q^T with a rotation Q.
Tensor<double> symmetric_with(const std::array<double, 3>& values) {
  const Tensor<double> Q = rotation(0.7);
  return product(Q, product(diagonal(values[0], values[1], values[2]), transpose(Q)));
}

const std::array<std::array<double, 3>, 8> spacings{{{3.0, 1.5, 0.2},
                                                     {1.0, 1.0, 1.0},
                                                     {2.0, 2.0, 0.25},
                                                     {1.0, 1.0 + 1e-9, 1.0 - 1e-9},
                                                     {1.0 + 1e-4, 1.0, 1.0},
                                                     {4.0, 0.5, 0.5 + 1e-6},
                                                     {100.0, 0.1, 0.1},
                                                     {1.0, 1.0 + 1e-15, 1.0}}};

TEST(PrincipalAxes, RebuildTheTensorForAnySpacingOfItsValues) {
  for (const auto& values : spacings) {
    const Tensor<double> A = symmetric_with(values);
    const PrincipalAxes<double> axes = principal_axes(A);
    const Tensor<double> rebuilt =
        product(axes.axes, product(diagonal(axes.values[0], axes.values[1], axes.values[2]), transpose(axes.axes)));
    EXPECT_LT(distance(rebuilt.components, A.components), 4e-15 * values[0]) << values[0] << ' ' << values[1];
    const Tensor<double> unit = product(transpose(axes.axes), axes.axes);
    EXPECT_LT(distance(unit.components, identity<double>().components), 4e-15) << values[0] << ' ' << values[1];
  }
}

TEST(PrincipalAxes, FindTheValues) {
  for (auto values : spacings) {
    std::array<double, 3> found = principal_axes(symmetric_with(values)).values;
    std::sort(found.begin(), found.end());
    std::sort(values.begin(), values.end());
    EXPECT_LT(distance(found, values), 4e-15 * values[2]);
  }
}

TEST(PrincipalAxes, LeaveADiagonalTensorAlone) {
  const PrincipalAxes<double> axes = principal_axes(diagonal(2.0, 3.0, 3.0));
  EXPECT_EQ(axes.axes.components, identity<double>().components);
  EXPECT_EQ(axes.values, (std::array{2.0, 3.0, 3.0}));
}

}  // namespace
}  // namespace menger::materials
