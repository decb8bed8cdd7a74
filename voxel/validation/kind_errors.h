#pragma once

#include <vector>

#include "voxel/model/expected_errors.h"
#include "voxel/validation/validation.h"

namespace menger::voxel {

/// Returns what comparisons found for parameters, by kind of body. Only numbers inside the range of validity count, and only
/// bodies with a displacement there.
ExpectedErrors expected_errors(const std::vector<CurveComparison>& comparisons, const SurrogateParameters& parameters);

}  // namespace menger::voxel
