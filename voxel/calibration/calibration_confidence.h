#pragma once

#include <Eigen/Core>

#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

/// Sets determination, intervals and correlation of the fitted values from the derivatives of the residuals about them.
///
/// With A = W^(1/2) J over the values that are not at a bound, columns scaled to one, and its singular values s and vectors U, V,
/// the covariance is that of the weighted estimate for residuals of variance one,
///
///   V S^-1 (U^T W U) S^-1 V^T,    S = max(s, 1e-6 of the largest),
///
/// which is (J^T J)^-1 for equal weights. Differences do not tell smaller singular values from zero: along such a combination of
/// values the variance is counted as the least that it can be, and a value that has half of its variance from them is not
/// separable and gets no interval. The others are not narrowed by what cannot be told apart beside them. Where the stated
/// uncertainties do not explain the residuals the covariance is multiplied by chi2 per degree of freedom, and Student's quantile
/// takes the place of the normal one.
/// @param fit with values, chi2, residual_count and parameter_count set
/// @param jacobian of the weighted residuals, W^(1/2) J: one column per fitted value, by its unknown
/// @param weights of the squares of the residuals, the diagonal of W, > 0
void set_confidence(CalibrationFit& fit, const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights);

}  // namespace menger::voxel
