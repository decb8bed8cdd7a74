#include "voxel/calibration/calibration_evaluation.h"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace menger::voxel {
namespace {

using Eigen::Index;

/// Step of an unknown for differences: far above the tolerance of the equilibria, and small against 1, which is a large change.
constexpr double difference = 1e-4;

double bounded_loss(double residual, double scale) {
  const double ratio = residual / scale;
  return std::copysign(scale * std::sqrt(std::log1p(ratio * ratio)), residual);
}

double bounded_loss_slope(double residual, double scale) {
  const double ratio = std::abs(residual / scale);
  constexpr double linear = 1e-8;  // below this the loss equals the residual, to rounding
  return ratio < linear ? 1.0 : ratio / ((1.0 + ratio * ratio) * std::sqrt(std::log1p(ratio * ratio)));
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

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

Eigen::VectorXd CalibrationEvaluation::weighted(std::size_t curve, const Eigen::VectorXd& residuals) const {
  const double root = std::sqrt(curves_[curve].weight);
  if (!loss_scale_) return root * residuals;
  return root * residuals.unaryExpr([&](double value) { return bounded_loss(value, *loss_scale_); });
}

std::optional<Eigen::VectorXd> CalibrationEvaluation::curve_residuals(std::size_t curve,
                                                                      const SurrogateParameters& parameters) const {
  if (stop_ != nullptr && *stop_) return std::nullopt;
  const FittedCurve& fitted = curves_[curve];
  const auto responses = responses_of(fitted, responder_(parameters, fitted.load_case, fitted.states));
  if (!responses) return std::nullopt;
  return weighted(curve, vector_of(residuals_of(fitted, *responses)));
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

ParameterSpan CalibrationEvaluation::span_of(std::size_t parameter, std::span<const double> unknowns) const {
  const FittedParameter& fitted = parameters_[parameter];
  std::vector<double> moved(unknowns.begin(), unknowns.end());
  const auto moved_by = [&](double change) {
    moved[parameter] = unknowns[parameter] + change;
    return parameters_at(moved);
  };
  const bool has_above = unknowns[parameter] + difference <= fitted.unknown_of(fitted.bounds.highest);
  const bool has_below = unknowns[parameter] - difference >= fitted.unknown_of(fitted.bounds.lowest);
  return {.below = moved_by(-difference),
          .above = moved_by(difference),
          .below_by = has_below ? difference : 0.0,
          .above_by = has_above ? difference : 0.0};
}

std::optional<Eigen::VectorXd> CalibrationEvaluation::linearise_curve(std::size_t curve, std::span<const double> unknowns,
                                                                      const std::vector<ParameterSpan>& spans,
                                                                      RowMajorMatrix& jacobian) const {
  if (stop_ != nullptr && *stop_) return std::nullopt;
  const FittedCurve& fitted = curves_[curve];
  std::vector<ParameterSpan> asked;
  for (std::size_t p = 0; p < spans.size(); ++p) {
    if (has_influence_[curve][p]) asked.push_back(spans[p]);
  }
  const ResponseSlopes response = responder_.slopes(parameters_at(unknowns), fitted.load_case, fitted.states, asked);
  const auto responses = responses_of(fitted, response.response);
  if (!responses) return std::nullopt;
  const Eigen::VectorXd residuals = vector_of(residuals_of(fitted, *responses));
  Eigen::VectorXd factor = Eigen::VectorXd::Constant(residuals.size(), std::sqrt(fitted.weight));
  if (loss_scale_)
    factor.array() *= residuals.unaryExpr([&](double value) { return bounded_loss_slope(value, *loss_scale_); }).array();
  std::size_t next = 0;
  for (std::size_t p = 0; p < spans.size(); ++p) {
    if (!has_influence_[curve][p]) continue;
    const auto& slope = response.slopes[next++];
    if (!slope) return std::nullopt;
    const Eigen::VectorXd column = vector_of(slopes_of(fitted, response.response.columns, *slope));
    jacobian.block(first_row_[curve], static_cast<Index>(p), column.size(), 1) = factor.cwiseProduct(column);
  }
  return weighted(curve, residuals);
}

std::optional<CalibrationEvaluation::Linearisation> CalibrationEvaluation::linearise(std::span<const double> unknowns) const {
  std::vector<ParameterSpan> spans;
  for (std::size_t p = 0; p < parameters_.size(); ++p) spans.push_back(span_of(p, unknowns));
  Linearisation all{Eigen::VectorXd(first_row_.back()),
                    RowMajorMatrix::Zero(first_row_.back(), static_cast<Index>(parameters_.size()))};
  std::vector<std::optional<Eigen::VectorXd>> parts(curves_.size());
  tbb::parallel_for(std::size_t{0}, curves_.size(),
                    [&](std::size_t c) { parts[c] = linearise_curve(c, unknowns, spans, all.jacobian); });
  for (std::size_t c = 0; c < parts.size(); ++c) {
    if (!parts[c]) return std::nullopt;
    all.residuals.segment(first_row_[c], parts[c]->size()) = *parts[c];
  }
  return all;
}

std::optional<std::vector<FittedParameter>> CalibrationEvaluation::drop_without_influence(std::vector<double>& unknowns) {
  // The remaining error of an equilibrium must not count as influence; it is far below any sigma.
  constexpr double smallest_influence = 1e-6;
  const auto at = linearise(unknowns);
  if (!at) return std::nullopt;
  std::vector<FittedParameter> kept;
  std::vector<FittedParameter> dropped;
  std::vector<double> kept_unknowns;
  std::vector<std::vector<bool>> influence(curves_.size());
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    std::vector<bool> column;
    bool any = false;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const auto part = at->jacobian.block(first_row_[c], static_cast<Index>(p), first_row_[c + 1] - first_row_[c], 1);
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
