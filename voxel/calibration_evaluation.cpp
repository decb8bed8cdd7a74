#include "voxel/calibration_evaluation.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace menger::voxel {
namespace {

using Eigen::Index;

/// Of an unknown: well above what the equilibria are solved to, and small against the 1 that is a large change.
constexpr double difference = 1e-4;

double bounded_loss(double residual, double scale) {
  const double ratio = residual / scale;
  return std::copysign(scale * std::sqrt(std::log1p(ratio * ratio)), residual);
}

Index size_of(const auto& values) { return static_cast<Index>(values.size()); }

}  // namespace

CalibrationEvaluation::CalibrationEvaluation(const std::vector<FittedCurve>& curves, std::vector<FittedParameter> parameters,
                                             const SurrogateParameters& base, const Responder& responder,
                                             std::optional<double> loss_scale, const std::atomic<bool>* stop)
    : curves_(curves),
      first_row_{0},
      parameters_(std::move(parameters)),
      base_(base),
      responder_(responder),
      loss_scale_(loss_scale),
      stop_(stop),
      has_influence_(curves.size(), std::vector<bool>(parameters_.size(), true)) {
  for (const FittedCurve& curve : curves_) first_row_.push_back(first_row_.back() + static_cast<Index>(curve.residual_count()));
}

std::size_t CalibrationEvaluation::residual_count() const { return static_cast<std::size_t>(first_row_.back()); }

Eigen::VectorXd CalibrationEvaluation::weights() const {
  Eigen::VectorXd weights(first_row_.back());
  for (std::size_t c = 0; c < curves_.size(); ++c)
    weights.segment(first_row_[c], first_row_[c + 1] - first_row_[c]).setConstant(curves_[c].weight);
  return weights;
}

SurrogateParameters CalibrationEvaluation::parameters_at(std::span<const double> unknowns) const {
  SurrogateParameters parameters = base_;
  for (std::size_t p = 0; p < parameters_.size(); ++p)
    set_value(parameters, parameters_[p], parameters_[p].value_of(unknowns[p]));
  return parameters;
}

std::optional<Eigen::VectorXd> CalibrationEvaluation::curve_residuals(std::size_t curve,
                                                                      const SurrogateParameters& parameters) const {
  if (stop_ != nullptr && *stop_) return std::nullopt;
  const FittedCurve& fitted = curves_[curve];
  const auto answers = answers_of(fitted, responder_(parameters, fitted.load_case, fitted.states));
  if (!answers) return std::nullopt;
  const std::vector<double> values = residuals_of(fitted, *answers);
  Eigen::VectorXd residuals = Eigen::Map<const Eigen::VectorXd>(values.data(), size_of(values));
  if (loss_scale_) residuals = residuals.unaryExpr([&](double value) { return bounded_loss(value, *loss_scale_); }).eval();
  return std::sqrt(fitted.weight) * residuals;
}

std::optional<Eigen::VectorXd> CalibrationEvaluation::residuals(std::span<const double> unknowns) const {
  const SurrogateParameters parameters = parameters_at(unknowns);
  std::vector<std::optional<Eigen::VectorXd>> parts(curves_.size());
  tbb::parallel_for(std::size_t{0}, curves_.size(), [&](std::size_t c) { parts[c] = curve_residuals(c, parameters); });
  Eigen::VectorXd all(first_row_.back());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (!parts[c]) return std::nullopt;
    all.segment(first_row_[c], parts[c]->size()) = *parts[c];
  }
  return all;
}

std::optional<Eigen::VectorXd> CalibrationEvaluation::derivative(std::size_t curve, std::size_t parameter,
                                                                 std::span<const double> unknowns,
                                                                 const Eigen::VectorXd& at) const {
  const FittedParameter& fitted = parameters_[parameter];
  std::vector<double> moved(unknowns.begin(), unknowns.end());
  const auto answer_at = [&](double unknown, double bound_side) -> std::optional<Eigen::VectorXd> {
    const bool inside = bound_side > 0.0 ? unknown <= fitted.unknown_of(fitted.bounds.highest)
                                         : unknown >= fitted.unknown_of(fitted.bounds.lowest);
    if (!inside) return std::nullopt;
    moved[parameter] = unknown;
    return curve_residuals(curve, parameters_at(moved));
  };
  const auto above = answer_at(unknowns[parameter] + difference, 1.0);
  const auto below = answer_at(unknowns[parameter] - difference, -1.0);
  const auto here = at.segment(first_row_[curve], first_row_[curve + 1] - first_row_[curve]);
  if (above && below) return (*above - *below) / (2.0 * difference);
  if (above) return (*above - here) / difference;
  if (below) return (here - *below) / difference;
  return std::nullopt;
}

std::optional<RowMajorMatrix> CalibrationEvaluation::jacobian(std::span<const double> unknowns, const Eigen::VectorXd& at) const {
  const std::size_t width = parameters_.size();
  std::vector<std::optional<Eigen::VectorXd>> parts(curves_.size() * width);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t n) {
    if (has_influence_[n / width][n % width]) parts[n] = derivative(n / width, n % width, unknowns, at);
  });
  RowMajorMatrix jacobian = RowMajorMatrix::Zero(first_row_.back(), static_cast<Index>(width));
  for (std::size_t n = 0; n < parts.size(); ++n) {
    if (!has_influence_[n / width][n % width]) continue;
    if (!parts[n]) return std::nullopt;
    jacobian.block(first_row_[n / width], static_cast<Index>(n % width), parts[n]->size(), 1) = *parts[n];
  }
  return jacobian;
}

std::optional<std::vector<FittedParameter>> CalibrationEvaluation::drop_without_influence(std::vector<double>& unknowns) {
  // What an equilibrium leaves of its tolerance is no influence: far less than any sigma.
  constexpr double smallest_influence = 1e-6;
  const auto at = residuals(unknowns);
  if (!at) return std::nullopt;
  const auto derivatives = jacobian(unknowns, *at);
  if (!derivatives) return std::nullopt;
  std::vector<FittedParameter> kept;
  std::vector<FittedParameter> dropped;
  std::vector<double> kept_unknowns;
  std::vector<std::vector<bool>> influence(curves_.size());
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    std::vector<bool> column;
    bool any = false;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const auto part = derivatives->block(first_row_[c], static_cast<Index>(p), first_row_[c + 1] - first_row_[c], 1);
      column.push_back(part.size() > 0 && part.cwiseAbs().maxCoeff() > smallest_influence);
      any = any || column.back();
    }
    (any ? kept : dropped).push_back(parameters_[p]);
    if (!any) continue;
    kept_unknowns.push_back(unknowns[p]);
    for (std::size_t c = 0; c < curves_.size(); ++c) influence[c].push_back(column[c]);
  }
  parameters_ = std::move(kept);
  unknowns = std::move(kept_unknowns);
  has_influence_ = std::move(influence);
  return dropped;
}

}  // namespace menger::voxel
