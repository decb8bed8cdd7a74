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
  double cost = 0.0;                                ///< half of the least sum found
  std::size_t iterations = 0;                       ///< of the search that found it
};

/// Moves unknowns inside their bounds by at least a margin. Starting at a bound, a step that the other unknowns need is cut off
/// at once, and a search may end where it began.
/// @param margin fraction of the width between the bounds, >= 0; 0: unknowns beyond a bound are set to it
std::vector<double> moved_inside(std::vector<double> unknowns, const std::vector<FittedParameter>& parameters, double margin);

/// Margins of moved_inside, tried one after the other until the surrogate has equilibria. Unknowns of an earlier fit may have
/// equilibria while states near them have none.
inline constexpr std::array<double, 4> inside_margins{0.02, 0.005, 0.001, 0.0};

/// Minimises the sum of squares within the bounds (Levenberg-Marquardt method). @param unknowns the start; replaced by the result
///
/// A step to unknowns without an equilibrium of the surrogate is shortened. A search that ends because equilibria or derivatives
/// are missing leaves its last result, which is never worse than the start.
/// @return nothing if the curves have no responses or derivatives at the start; the unknowns are then unchanged
std::optional<SearchEnd> search_once(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                                     const CalibrationFitOptions& options);

/// Searches like search_once, and then again from inside the bounds (see inside_margins) with the initial trust region, until
/// this gains less than a thousandth. This is needed because a search along bounds may end beside the minimum.
SearchEnd search_repeatedly(const CalibrationEvaluation& evaluation, std::vector<double>& unknowns,
                            const CalibrationFitOptions& options);

}  // namespace menger::voxel
