#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "meshes/load_cases/response_curve.h"
#include "voxel/statics/load_case_response.h"

namespace menger::voxel {

/// A response curve prepared for a fit: the ordinates with information, each with its standard deviation.
struct FittedCurve {
  meshes::LoadCase load_case;
  std::vector<std::vector<double>> states;     ///< abscissae by row
  std::vector<std::string> ordinates;          ///< names of columns
  std::vector<std::vector<double>> reference;  ///< by ordinate, then row
  std::vector<double> sigma;                   ///< by ordinate, in its unit, > 0
  /// Weight of the curve in a fit, > 0: a factor on its squared residuals. It does not express how accurate the curve is:
  /// residuals, chi2 and intervals use sigma only.
  double weight = 1.0;

  [[nodiscard]] std::size_t residual_count() const { return ordinates.size() * states.size(); }
};

/// Prepares a response curve for a fit.
///
/// The standard deviation of an ordinate is the stated relative uncertainty times its largest magnitude. That magnitude counts as
/// at least a hundredth of that of the largest ordinate of the same unit, because an ordinate that hardly changes is not accurate
/// to a few per cent of almost zero. Ordinates are left out if they and all others of their unit are zero throughout.
FittedCurve fitted_curve(const meshes::ResponseCurve& curve, double weight = 1.0);

/// The ordinates of the surrogate at the states of a curve, by ordinate, then row; nothing if it has no equilibrium in one of the
/// states.
std::optional<std::vector<std::vector<double>>> responses_of(const FittedCurve& curve, const LoadCaseResponse& response);

/// Residuals (surrogate - reference) / sigma, ordinate by ordinate.
std::vector<double> residuals_of(const FittedCurve& curve, const std::vector<std::vector<double>>& responses);

/// Derivatives of residuals_of with respect to a parameter. @param columns, slope of a response to the load case of the curve
std::vector<double> slopes_of(const FittedCurve& curve, const std::vector<std::string>& columns, const ResponseSlope& slope);

/// The unit at the end of a column's name, such as "Pa", "m" or "N_m"; empty for a plain number.
std::string unit_of(const std::string& column);

}  // namespace menger::voxel
