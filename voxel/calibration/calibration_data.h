#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "meshes/load_cases/response_curve.h"
#include "voxel/statics/load_case_response.h"

namespace menger::voxel {

/// A response curve as a fit sees it: the ordinates that say something, each with its standard deviation.
struct FittedCurve {
  meshes::LoadCase load_case;
  std::vector<std::vector<double>> states;     ///< abscissae by row
  std::vector<std::string> ordinates;          ///< names of columns
  std::vector<std::vector<double>> reference;  ///< by ordinate, then row
  std::vector<double> sigma;                   ///< by ordinate, in its unit, > 0
  /// How much the curve counts in a fit, > 0: a factor of its squared residuals. It is not how well the curve is known:
  /// residuals, chi2 and intervals use sigma.
  double weight = 1.0;

  [[nodiscard]] std::size_t residual_count() const { return ordinates.size() * states.size(); }
};

/// Prepares a curve. The standard deviation of an ordinate is the stated relative uncertainty times its largest magnitude, but
/// not less than a hundredth of what the largest ordinate of the same unit has: an ordinate that hardly answers is not known to
/// five per cent of nearly nothing. Ordinates that are zero throughout together with all others of their unit are left out.
FittedCurve fitted_curve(const meshes::ResponseCurve& curve, double weight = 1.0);

/// The surrogate's ordinates at the states of a curve, by ordinate; nothing where it has no equilibrium at one of them.
std::optional<std::vector<std::vector<double>>> answers_of(const FittedCurve& curve, const LoadCaseResponse& response);

/// (answer - reference) / sigma, ordinate by ordinate.
std::vector<double> residuals_of(const FittedCurve& curve, const std::vector<std::vector<double>>& answers);

/// Derivatives of residuals_of by a parameter. @param columns, slope of a response to the curve's load case
std::vector<double> slopes_of(const FittedCurve& curve, const std::vector<std::string>& columns, const ResponseSlope& slope);

/// The unit at the end of a column's name, "Pa", "m", "N_m"; empty for a plain number.
std::string unit_of(const std::string& column);

}  // namespace menger::voxel
