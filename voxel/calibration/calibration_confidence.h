#pragma once

#include <Eigen/Core>

#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

/// Sets determination, intervals and correlation of the fitted values, from the derivatives of the residuals with respect to
/// them.
///
/// Let A = W^(1/2) J be the jacobian over the values that are not at a bound, with columns scaled to one, and s, U, V its
/// singular values and vectors. The covariance is that of the weighted estimate for residuals of variance one,
///
///   V S^-1 (U^T W U) S^-1 V^T,    S = max(s, 1e-6 of the largest),
///
/// which is (J^T J)^-1 for equal weights. Difference quotients cannot distinguish smaller singular values from zero. Along such a
/// combination of values, the variance is counted as the least that it can be. A value with at least half of its variance from
/// such combinations is not separable and gets no interval. The other values keep what such combinations add to their variance,
/// at its least, so that their intervals are lower bounds. If the stated uncertainties do not explain the residuals, the
/// covariance is multiplied by chi2 per degree of freedom, and Student's quantile replaces the normal one.
/// A value whose whole range changes no residual where the fit ended has no influence. Without finite derivatives no value is
/// separable. Every interval consists of finite numbers.
/// @param fit with values, chi2, residual_count and parameter_count set
/// @param jacobian of the weighted residuals, W^(1/2) J: one column per fitted value, with respect to its unknown
/// @param weights of the squares of the residuals, the diagonal of W, > 0
void set_confidence(CalibrationFit& fit, const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights);

}  // namespace menger::voxel
