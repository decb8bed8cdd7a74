#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_body.h"

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

/// Pressures of an inflation, ascending, Pa: zero, evenly spaced ones down to `lowest_Pa` <= 0, a third of all, and up to
/// `highest_Pa` >= 0. A side without range has none, so that no pressure comes twice.
/// @param count of all, >= 1, where both sides have a range
std::vector<double> pressures_between(double lowest_Pa, double highest_Pa, int count);

/// Pressures at fractions of a range, Pa: negative ones of `lowest_Pa` <= 0, the others of `highest_Pa` >= 0. Fractions of a side
/// without range are all zero, and are one pressure.
/// @param fractions ascending
std::vector<double> pressures_at(const std::vector<double>& fractions, double lowest_Pa, double highest_Pa);

}  // namespace menger::fem
