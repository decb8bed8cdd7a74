#include "materials/fit/fit_confidence.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "materials/fit/student_quantile.h"
#include "materials/laws/law_parameters.h"

namespace menger::materials {
namespace {

/// Returns the positions of the parameters that are not at a bound.
std::vector<std::size_t> free_parameters(const LawFit& fit) {
  std::vector<std::size_t> free;
  const auto parameters = parameters_of(fit.law);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (std::find(fit.at_bound.begin(), fit.at_bound.end(), parameters[p].first) == fit.at_bound.end()) free.push_back(p);
  }
  return free;
}

double uniaxial_Pa(const HyperelasticLaw& law, double stretch) {
  return nominal_stress(law, LoadingMode::uniaxial, stretch).stress_Pa;
}

/// Returns the derivatives of the stress at each stretch with respect to the logarithms of the given parameters.
Eigen::MatrixXd jacobian_of(const HyperelasticLaw& law, const std::vector<std::size_t>& free, const std::vector<double>& values,
                            const std::vector<double>& stretch) {
  constexpr double step = 1e-5;
  Eigen::MatrixXd jacobian(stretch.size(), free.size());
  for (std::size_t column = 0; column < free.size(); ++column) {
    std::vector<double> above = values;
    std::vector<double> below = values;
    above[free[column]] *= 1.0 + step;
    below[free[column]] *= 1.0 - step;
    const HyperelasticLaw upper = with_parameters(law, above);
    const HyperelasticLaw lower = with_parameters(law, below);
    for (std::size_t i = 0; i < stretch.size(); ++i) {
      jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(column)) =
          (uniaxial_Pa(upper, stretch[i]) - uniaxial_Pa(lower, stretch[i])) / (2.0 * step);
    }
  }
  return jacobian;
}

}  // namespace

void set_confidence(LawFit& fit, const std::vector<double>& stretch) {
  fit.confidence_95.clear();
  const std::vector<std::size_t> free = free_parameters(fit);
  std::vector<double> values;
  for (const auto& [name, value] : parameters_of(fit.law)) values.push_back(value);
  const bool vanishes = std::any_of(free.begin(), free.end(), [&](std::size_t p) { return values[p] == 0.0; });
  if (free.empty() || vanishes) return;
  const Eigen::MatrixXd jacobian = jacobian_of(fit.law, free, values, stretch);
  if (!jacobian.allFinite()) return;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian.rows(), jacobian.cols());
  qr.setThreshold(1e-7);  // finite differences give the columns no more accurately
  qr.compute(jacobian);
  const auto width = static_cast<Eigen::Index>(free.size());
  if (qr.rank() < width) return;
  const Eigen::MatrixXd inverse =
      qr.matrixR().topLeftCorner(width, width).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(width, width));
  const Eigen::VectorXd deviations = qr.colsPermutation() * inverse.rowwise().norm();
  const auto freedom = static_cast<int>(stretch.size() - free.size());
  const double spread_Pa = fit.rmse_Pa * std::sqrt(static_cast<double>(stretch.size()) / freedom);
  fit.confidence_95.resize(values.size());
  for (std::size_t column = 0; column < free.size(); ++column) {
    const double value = values[free[column]];
    const double relative = student_quantile_95(freedom) * spread_Pa * deviations[static_cast<Eigen::Index>(column)];
    const double half = std::abs(value) * relative;
    fit.confidence_95[free[column]] = {value - half, value + half};
  }
}

}  // namespace menger::materials
