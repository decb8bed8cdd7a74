#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "fem/load_cases/load_case_body.h"

namespace menger::fem {

/// The range of pressures in which a body can be driven.
struct PressureRange {
  double lowest_pressure_Pa = 0.0;            ///< lowest pressure that was reached, < 0
  double highest_pressure_Pa = 0.0;           ///< highest pressure that was reached, at most the largest that was allowed
  std::optional<double> contact_pressure_Pa;  ///< at which walls of a chamber first touch
  std::optional<double> limit_pressure_Pa;    ///< the first maximum over the volume
  bool stopped = false;                       ///< whether the user stopped the search; the other members are then incomplete
  std::string reason;                         ///< what was not found and why, for users; empty if both were found
};

/// Finds the range of pressures of a body.
///
/// The body is first followed under vacuum, at most of its shear modulus or one atmosphere, down to the first contact of walls or
/// to where they buckle. Buckled equilibria are unstable at given pressure, and the further motion depends on flaws that are not
/// part of any model. Then the body is followed from rest by increasing the volume of its chambers, up to the first maximum of
/// the pressure or to `largest_pressure_Pa`.
/// @param body of an inflation
PressureRange find_pressure_range(LoadCaseBody& body, std::optional<double> largest_pressure_Pa, const std::atomic<bool>* stop);

/// Returns the pressures of an inflation, ascending, Pa: zero, evenly spaced ones down to `lowest_Pa` <= 0, which are a third of
/// all, and evenly spaced ones up to `highest_Pa` >= 0. A side without range has none, so that no pressure is repeated.
/// @param count of all pressures, >= 1, if both sides have a range
std::vector<double> pressures_between(double lowest_Pa, double highest_Pa, int count);

/// Returns the pressures at fractions of a range, Pa. Negative fractions are of `lowest_Pa` <= 0, the others of `highest_Pa` >=
/// 0. Fractions of a side without range are all zero, and give one pressure.
/// @param fractions ascending
std::vector<double> pressures_at(const std::vector<double>& fractions, double lowest_Pa, double highest_Pa);

}  // namespace menger::fem
