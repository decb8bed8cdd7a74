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

/// Residuals of all curves, one below the other and each by the root of its curve's weight, as functions of the unknowns of a
/// fit.
///
/// Curves are answered in parallel; the numbers do not depend on how many threads do it.
class CalibrationEvaluation {
 public:
  /// @param base parameters in which the fitted ones are set
  /// @param loss_scale with one, a residual r counts as c sqrt(ln(1 + (r / c)^2)) of the same sign (Cauchy's loss), so that far
  /// ones hardly pull
  CalibrationEvaluation(const std::vector<FittedCurve>& curves, std::vector<FittedParameter> parameters,
                        const SurrogateParameters& base, const Responder& responder, std::optional<double> loss_scale = {},
                        const std::atomic<bool>* stop = nullptr);

  [[nodiscard]] std::size_t residual_count() const;
  [[nodiscard]] Eigen::VectorXd weights() const;  ///< by residual
  [[nodiscard]] const std::vector<FittedParameter>& parameters() const { return parameters_; }
  [[nodiscard]] SurrogateParameters parameters_at(std::span<const double> unknowns) const;

  /// Nothing where the surrogate has no equilibrium in one of the states, or when it was stopped.
  [[nodiscard]] std::optional<Eigen::VectorXd> residuals(std::span<const double> unknowns) const;

  /// Residuals and their derivatives by the unknowns, one row per residual. The responder gives them from both sides, at bounds
  /// and where one side has no answer from the other. Nothing where neither side has one.
  struct Linearisation {
    Eigen::VectorXd residuals;
    RowMajorMatrix jacobian;
  };
  [[nodiscard]] std::optional<Linearisation> linearise(std::span<const double> unknowns) const;

  /// Looks which unknown has an influence on which curve, so that later derivatives leave the others out, and drops the
  /// parameters without any. @return the dropped ones, or nothing where there is no answer at these unknowns
  std::optional<std::vector<FittedParameter>> drop_without_influence(std::vector<double>& unknowns);

 private:
  /// Of one curve.
  [[nodiscard]] std::optional<Eigen::VectorXd> curve_residuals(std::size_t curve, const SurrogateParameters& parameters) const;
  /// Its part of the derivatives is put into the jacobian.
  [[nodiscard]] std::optional<Eigen::VectorXd> linearise_curve(std::size_t curve, std::span<const double> unknowns,
                                                               const std::vector<ParameterSpan>& spans,
                                                               RowMajorMatrix& jacobian) const;
  [[nodiscard]] ParameterSpan span_of(std::size_t parameter, std::span<const double> unknowns) const;
  [[nodiscard]] Eigen::VectorXd weighted(std::size_t curve, const Eigen::VectorXd& residuals) const;

  const std::vector<FittedCurve>& curves_;
  std::vector<Eigen::Index> first_row_;  ///< of each curve, and the number of all at the end
  std::vector<FittedParameter> parameters_;
  SurrogateParameters base_;
  const Responder& responder_;
  std::optional<double> loss_scale_;
  const std::atomic<bool>* stop_;
  std::vector<std::vector<bool>> has_influence_;  ///< by curve, then parameter
};

}  // namespace menger::voxel
