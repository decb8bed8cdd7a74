#pragma once

#include <vector>

#include "voxel/model/pressure_law.h"

namespace menger::voxel {

/// Returns pressures (Pa) among which a law has its smallest and its largest value of a whole range: both ends, and every
/// pressure between them at which its slope changes sign.
///
/// Only plates that pressure draws in while it stretches them, or the opposite (slope and arc of opposite signs), have a slope
/// that changes sign: without an arc, or with one of the same sign, the law is monotone.
/// @param lowest_Pa, highest_Pa at which the law has a value
[[nodiscard]] std::vector<double> extreme_pressures(const PressureLaw& law, double lowest_Pa, double highest_Pa);

}  // namespace menger::voxel
