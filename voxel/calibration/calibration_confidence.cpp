#include "voxel/calibration/calibration_confidence.h"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "materials/fit/student_quantile.h"

namespace menger::voxel {
namespace {

using Eigen::Index;

constexpr double least_singular_value = 1e-6;  // columns from differences are no more accurate
constexpr double least_influence = 1e-6;       // standard deviations, above the remaining error of equilibria

bool is_at_bound(const FittedValue& value) {
  constexpr double near = 1e-6;  // of the width between the bounds
  const FittedParameter& p = value.parameter;
  const double low = p.unknown_of(p.bounds.lowest);
  const double high = p.unknown_of(p.bounds.highest);
  const double at = p.unknown_of(value.value);
  return at <= low + near * (high - low) || at >= high - near * (high - low);
}

/// Whether the whole range of a value changes no residual: what it had an effect on may have vanished on the way of the fit.
bool is_without_influence(const FittedValue& value, const Eigen::VectorXd& column) {
  const FittedParameter& p = value.parameter;
  const double width = p.unknown_of(p.bounds.highest) - p.unknown_of(p.bounds.lowest);
  return column.lpNorm<Eigen::Infinity>() * width <= least_influence;
}

std::vector<Index> free_columns(const CalibrationFit& fit) {
  std::vector<Index> columns;
  for (std::size_t v = 0; v < fit.parameter_count; ++v) {
    if (fit.values[v].determination == Determination::determined) columns.push_back(static_cast<Index>(v));
  }
  return columns;
}

/// Covariance of unknowns, and the part of their variances from combinations on which the residuals do not depend.
struct Covariance {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd undetermined;
};

Covariance covariance_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights) {
  // Columns of very different length are scaled. Singular values then depend on how values combine, not on how large they are.
  const Eigen::VectorXd length = jacobian.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  const Eigen::MatrixXd scaled = jacobian * length.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinU | Eigen::ComputeFullV);
  const Index size = scaled.cols();
  Eigen::VectorXd singular = Eigen::VectorXd::Zero(size);  // with fewer residuals than values the rest is zero
  singular.head(svd.singularValues().size()) = svd.singularValues();
  const double floor = least_singular_value * std::max(singular[0], std::numeric_limits<double>::min());
  // Combinations beyond all residuals have no weight of their own. With the mean weight a common factor has no effect.
  Eigen::MatrixXd spread = weights.mean() * Eigen::MatrixXd::Identity(size, size);
  const Index rank = std::min(size, svd.matrixU().cols());
  spread.topLeftCorner(rank, rank) = svd.matrixU().transpose() * weights.asDiagonal() * svd.matrixU();
  const Eigen::MatrixXd back =
      length.cwiseInverse().asDiagonal() * svd.matrixV() * singular.cwiseMax(floor).cwiseInverse().asDiagonal();
  Covariance covariance{back * spread * back.transpose(), Eigen::VectorXd::Zero(size)};
  for (Index k = 0; k < size; ++k) {
    if (singular[k] <= floor) covariance.undetermined += spread(k, k) * back.col(k).cwiseAbs2();
  }
  return covariance;
}

void set_interval(FittedValue& value, double half_width) {
  const FittedParameter& p = value.parameter;
  const double at = p.unknown_of(value.value);
  // Nothing was searched beyond the bounds, and the end of an interval in a logarithm may have no finite value.
  value.confidence_95 = {p.value_of(std::max(at - half_width, p.unknown_of(p.bounds.lowest))),
                         p.value_of(std::min(at + half_width, p.unknown_of(p.bounds.highest)))};
  const double width = value.confidence_95->second - value.confidence_95->first;
  if (!(width <= std::abs(value.value))) value.determination = Determination::wide;
}

}  // namespace

void set_confidence(CalibrationFit& fit, const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& weights) {
  for (std::size_t v = 0; v < fit.parameter_count; ++v) {
    FittedValue& value = fit.values[v];
    if (is_at_bound(value)) {
      value.determination = Determination::at_bound;
    } else if (!jacobian.allFinite()) {
      value.determination = Determination::not_separable;
    } else if (is_without_influence(value, jacobian.col(static_cast<Index>(v)))) {
      value.determination = Determination::no_influence;
    }
  }
  fit.correlation.assign(fit.parameter_count, std::vector<std::optional<double>>(fit.parameter_count));
  const std::vector<Index> columns = free_columns(fit);
  if (columns.empty()) return;
  const Covariance covariance = covariance_of(jacobian(Eigen::all, columns), weights);

  const bool has_freedom = fit.residual_count > fit.parameter_count;
  const bool widened = !fit.explained && has_freedom;
  const double factor = widened ? materials::student_quantile_95(static_cast<int>(fit.residual_count - fit.parameter_count)) *
                                      std::sqrt(fit.reduced_chi2())
                                : boost::math::quantile(boost::math::normal(), 0.975);
  std::vector<Index> known;  // positions among the free columns
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto at = static_cast<Index>(i);
    FittedValue& value = fit.values[static_cast<std::size_t>(columns[i])];
    const double variance = covariance.matrix(at, at);
    // The comparison is false for a variance beyond all numbers, too.
    if (!std::isfinite(factor * variance) || covariance.undetermined[at] >= 0.5 * variance) {
      value.determination = Determination::not_separable;
      continue;
    }
    set_interval(value, factor * std::sqrt(variance));
    known.push_back(at);
  }
  for (const Index i : known) {
    for (const Index j : known) {
      fit.correlation[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])]
                     [static_cast<std::size_t>(columns[static_cast<std::size_t>(j)])] =
          covariance.matrix(i, j) / std::sqrt(covariance.matrix(i, i) * covariance.matrix(j, j));
    }
  }
}

}  // namespace menger::voxel
