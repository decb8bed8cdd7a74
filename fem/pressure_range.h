#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "fem/load_case_body.h"

namespace menger::fem {

/// Between which pressures a body can be driven.
struct PressureRange {
  double lowest_pressure_Pa = 0.0;            ///< that was reached, < 0
  double highest_pressure_Pa = 0.0;           ///< that was reached, at most the largest that was allowed
  std::optional<double> contact_pressure_Pa;  ///< at which walls of a chamber first touch
  std::optional<double> limit_pressure_Pa;    ///< the first maximum over the volume
  bool stopped = false;                       ///< by the user; the rest means little then
  std::string reason;                         ///< what was not found and why, for people; empty if both were
};

/// Follows a body under vacuum, at most of its shear modulus or one atmosphere, down to the first contact of walls, or to where
/// they buckle: there the equilibrium is unstable at given pressure, and what the body does next depends on flaws that no model
/// knows. Then from rest up by the volume of its chambers to the first maximum of the pressure or to `largest_pressure_Pa`.
/// @param body of an inflation
PressureRange find_pressure_range(LoadCaseBody& body, std::optional<double> largest_pressure_Pa, const std::atomic<bool>* stop);

}  // namespace menger::fem
