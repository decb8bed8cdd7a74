#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/calibration/calibration_evaluation.h"
#include "voxel/calibration/calibration_fit.h"

namespace menger::voxel {

/// How a search for the least sum of squares ended.
struct SearchEnd {
  io::RunStatus status = io::RunStatus::completed;  ///< completed, not_converged or stopped
  std::string reason{};                             ///< if not completed
  double cost = 0.0;                                ///< half of the least sum that was found
  std::size_t iterations = 0;                       ///< of the search that found it
};

/// Unknowns at least a part of the width of their bounds inside them: from a bound a step that the others want is cut off at
/// once, and a search may end where it began.
/// @param margin part of the width, >= 0; 0: unknowns beyond a bound are put there
std::vector<double> moved_inside(std::vector<double> unknowns, const std::vector<FittedParameter>& parameters, double margin);

/// Margins of moved_inside that are tried one after the other until the surrogate has its equilibria: unknowns of an earlier fit
/// may lie beside states without any, and have some themselves.
inline constexpr std::array<double, 4> inside_margins{0.02, 0.005, 0.001, 0.0};

/// Puts those unknowns in their place that make the sum of squares least, within the bounds (Levenberg and Marquardt's method).
/// Steps to where the surrogate has no equilibrium are shortened; a search that ends for want of equilibria or derivatives leaves
/// what it has reached, which is never worse than where it began.
/// @return nothing where the curves have no answers or derivatives at the start, which then is left as it is
std::optional<SearchEnd> search_once(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                                     const CalibrationFitOptions& options);

/// The same, and begins anew from inside the bounds (see inside_margins), with its trust region as wide as at first, until that
/// gains less than a thousandth: a search that runs along bounds may end beside the minimum.
SearchEnd search_repeatedly(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                            const CalibrationFitOptions& options);

}  // namespace menger::voxel
