#include "fem_cross_code.h"

#include <gtest/gtest.h>

namespace menger::fem {
namespace {

TEST(HollowCube, AgreesWithOtherCodesForQ1P0) {
  expect_published({"cube Q1/P0 n = 1", 1, Formulation::three_field, 1, 3.2637, 2.9848, 59.833, 7.0827e-3});
}

TEST(HollowCube, AgreesWithOtherCodesForQ1P0OnTheHalvedMesh) {
  expect_published({"cube Q1/P0 n = 2", 1, Formulation::three_field, 2, 3.2563, 2.9463, 63.207, 7.7952e-3});
}

TEST(HollowCube, AgreesWithOtherCodesForQ2P1) {
  expect_published({"cube Q2/P1 n = 1", 2, Formulation::three_field, 1, 3.32526, 3.01402, 66.272, 8.0346e-3});
}

TEST(HollowCube, AgreesWithOtherCodesForQ2Displacement) {
  expect_published({"cube Q2 n = 1", 2, Formulation::displacement, 1, 3.17131, 2.84740, 61.705, 7.8289e-3});
}

}  // namespace
}  // namespace menger::fem
