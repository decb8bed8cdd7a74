#pragma once

#include <Eigen/Core>
#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "voxel/calibration/calibration_data.h"
#include "voxel/calibration/calibration_parameters.h"

namespace menger::voxel {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Computes the residuals of all curves as functions of the unknowns of a fit. They are one vector, and each is multiplied by the
/// root of its curve's weight.
///
/// Responses to the curves are computed in parallel. The numbers do not depend on the number of threads.
class CalibrationEvaluation {
 public:
  /// @param base parameters in which the fitted ones are set
  /// @param loss_scale if given (c), a residual r counts as c sqrt(ln(1 + (r / c)^2)) with the same sign (Cauchy's loss), so that
  /// outliers have little effect
  CalibrationEvaluation(const std::vector<FittedCurve>& curves, std::vector<FittedParameter> parameters,
                        const SurrogateParameters& base, const Responder& responder, std::optional<double> loss_scale = {},
                        const std::atomic<bool>* stop = nullptr);

  [[nodiscard]] std::size_t residual_count() const;
  [[nodiscard]] Eigen::VectorXd weights() const;  ///< by residual
  [[nodiscard]] const std::vector<FittedParameter>& parameters() const { return parameters_; }
  [[nodiscard]] SurrogateParameters parameters_at(std::span<const double> unknowns) const;

  /// The weighted residuals; nothing if the surrogate has no equilibrium in one of the states, or if the fit was stopped.
  [[nodiscard]] std::optional<Eigen::VectorXd> residuals(std::span<const double> unknowns) const;

  /// Residuals and their derivatives with respect to the unknowns, one row per residual. The responder computes derivatives from
  /// both sides, or from one side at bounds and where the other side has no response. Nothing if neither side has a response.
  struct Linearisation {
    Eigen::VectorXd residuals;
    RowMajorMatrix jacobian;
  };
  [[nodiscard]] std::optional<Linearisation> linearise(std::span<const double> unknowns) const;

  /// Finds which unknown influences which curve, so that later derivatives skip the other pairs, and drops parameters without any
  /// influence. @return the dropped parameters, or nothing if there is no response at these unknowns
  std::optional<std::vector<FittedParameter>> drop_without_influence(std::vector<double>& unknowns);

 private:
  /// Weighted residuals of one curve.
  [[nodiscard]] std::optional<Eigen::VectorXd> curve_residuals(std::size_t curve, const SurrogateParameters& parameters) const;
  /// Weighted residuals of one curve. Writes its rows of the jacobian.
  [[nodiscard]] std::optional<Eigen::VectorXd> linearise_curve(std::size_t curve, std::span<const double> unknowns,
                                                               const std::vector<ParameterSpan>& spans,
                                                               RowMajorMatrix& jacobian) const;
  [[nodiscard]] ParameterSpan span_of(std::size_t parameter, std::span<const double> unknowns) const;
  [[nodiscard]] Eigen::VectorXd weighted(std::size_t curve, const Eigen::VectorXd& residuals) const;

  const std::vector<FittedCurve>& curves_;
  std::vector<Eigen::Index> first_row_;  ///< by curve, then the number of all residuals
  std::vector<FittedParameter> parameters_;
  SurrogateParameters base_;
  const Responder& responder_;
  std::optional<double> loss_scale_;
  const std::atomic<bool>* stop_;
  std::vector<std::vector<bool>> has_influence_;  ///< by curve, then parameter
};

}  // namespace menger::voxel
