#include "voxel/calibration/calibration_confidence.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace menger::voxel {
namespace {

constexpr double normal_quantile_95 = 1.959963984540054;

/// Values of zero far from their bounds, explained by their residuals.
CalibrationFit fit_of(std::size_t parameter_count, std::size_t residual_count) {
  CalibrationFit fit;
  fit.parameter_count = parameter_count;
  fit.residual_count = residual_count;
  for (std::size_t p = 0; p < parameter_count; ++p) {
    FittedValue value;
    value.parameter.bounds = {-1e9, 1e9};
    fit.values.push_back(value);
  }
  return fit;
}

double half_width(const FittedValue& value) { return 0.5 * (value.confidence_95->second - value.confidence_95->first); }

TEST(CalibrationConfidence, OfALineIsThatOfTheNormalEquations) {
  Eigen::MatrixXd jacobian(4, 2);
  jacobian << 1, -1, 1, 0, 1, 1, 1, 2;
  CalibrationFit fit = fit_of(2, 4);
  set_confidence(fit, jacobian, Eigen::VectorXd::Ones(4));
  const Eigen::Matrix2d covariance = (jacobian.transpose() * jacobian).inverse();
  for (int p = 0; p < 2; ++p) {
    const auto at = static_cast<std::size_t>(p);
    ASSERT_TRUE(fit.values[at].confidence_95);
    EXPECT_NEAR(half_width(fit.values[at]), normal_quantile_95 * std::sqrt(covariance(p, p)), 1e-9);
  }
  EXPECT_NEAR(*fit.correlation[0][1], covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)), 1e-12);
}

TEST(CalibrationConfidence, OfAMeanHoldsForAnyWeights) {
  // The weighted mean of numbers of variance one has the variance sum w^2 / (sum w)^2; the same weight for all changes nothing.
  const Eigen::Vector4d weights(1.0, 4.0, 9.0, 1.0);
  for (const Eigen::Vector4d& w : {weights, Eigen::Vector4d(25.0 * weights), Eigen::Vector4d(Eigen::Vector4d::Constant(7.0))}) {
    CalibrationFit fit = fit_of(1, 4);
    set_confidence(fit, w.cwiseSqrt(), w);
    ASSERT_TRUE(fit.values[0].confidence_95);
    EXPECT_NEAR(half_width(fit.values[0]), normal_quantile_95 * w.norm() / w.sum(), 1e-9);
  }
}

TEST(CalibrationConfidence, IsNotNarrowedByWhatCannotBeToldApartBesideIt) {
  // The first two only show as their sum, with which the third correlates by one half: known would be neither.
  Eigen::MatrixXd jacobian(2, 3);
  jacobian << 1, 1, 0.5, 0, 0, std::sqrt(0.75);
  CalibrationFit fit = fit_of(3, 2);
  set_confidence(fit, jacobian, Eigen::VectorXd::Ones(2));
  for (const std::size_t p : {0U, 1U}) {
    EXPECT_EQ(fit.values[p].determination, Determination::not_separable);
    EXPECT_FALSE(fit.values[p].confidence_95);
    EXPECT_FALSE(fit.correlation[p][2]);
  }
  ASSERT_TRUE(fit.values[2].confidence_95);
  EXPECT_NEAR(half_width(fit.values[2]), normal_quantile_95 / std::sqrt(0.75), 1e-6);
}

TEST(CalibrationConfidence, GivesNoIntervalToASmallPartOfAnUndeterminedCombination) {
  // Two values that make up for each other one to twenty: the larger part of the combination is not all of it.
  Eigen::MatrixXd jacobian(3, 2);
  jacobian << 1, 0.05, 2, 0.1, 3, 0.15;
  for (const double weight : {1.0, 4.0, 0.1}) {
    CalibrationFit fit = fit_of(2, 3);
    set_confidence(fit, std::sqrt(weight) * jacobian, Eigen::VectorXd::Constant(3, weight));
    for (const FittedValue& value : fit.values) EXPECT_EQ(value.determination, Determination::not_separable) << weight;
  }
  jacobian(0, 1) = 0.06;
  CalibrationFit fit = fit_of(2, 3);
  set_confidence(fit, jacobian, Eigen::VectorXd::Ones(3));
  const Eigen::Matrix2d covariance = (jacobian.transpose() * jacobian).inverse();
  ASSERT_TRUE(fit.values[1].confidence_95);
  EXPECT_NEAR(half_width(fit.values[1]), normal_quantile_95 * std::sqrt(covariance(1, 1)), 1e-6 * half_width(fit.values[1]));
}

/// A value may lose its influence on the way of a fit: its column is then zero, or so small that its square is.
TEST(CalibrationConfidence, GivesNoIntervalToAValueWithoutInfluenceWhereTheFitEnds) {
  for (const double influence : {0.0, 1e-200, 1e-310}) {
    Eigen::MatrixXd jacobian(4, 2);
    jacobian << 1, influence, 1, 0, 1, 0, 1, 0;
    CalibrationFit fit = fit_of(2, 4);
    set_confidence(fit, jacobian, Eigen::VectorXd::Ones(4));
    ASSERT_TRUE(fit.values[0].confidence_95) << influence;
    EXPECT_NEAR(half_width(fit.values[0]), normal_quantile_95 / 2.0, 1e-9) << influence;
    EXPECT_EQ(fit.values[1].determination, Determination::no_influence) << influence;
    EXPECT_FALSE(fit.values[1].confidence_95) << influence;
    EXPECT_FALSE(fit.correlation[1][1]) << influence;
  }
}

TEST(CalibrationConfidence, GivesNoIntervalsWithoutFiniteDerivatives) {
  Eigen::MatrixXd jacobian(3, 2);
  jacobian << 1, 1, 1, 2, 1, std::nan("");
  CalibrationFit fit = fit_of(2, 3);
  set_confidence(fit, jacobian, Eigen::VectorXd::Ones(3));
  for (const FittedValue& value : fit.values) EXPECT_FALSE(value.confidence_95);
}

}  // namespace
}  // namespace menger::voxel
