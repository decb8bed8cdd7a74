#include "voxel/statics/tangent_factors.h"

namespace menger::voxel {

bool TangentFactors::factorise(const Eigen::SparseMatrix<double>& tangent) {
  if (tangent.rows() == 0) return true;  // a single voxel that is held
  if (!is_ordered_) {
    factors_.analyzePattern(tangent);
    is_ordered_ = true;
  }
  factors_.factorize(tangent);
  return factors_.info() == Eigen::Success;
}

Eigen::MatrixXd TangentFactors::solve(const Eigen::MatrixXd& residuals) const {
  if (residuals.size() == 0) return residuals;
  return factors_.solve(residuals);
}

}  // namespace menger::voxel
