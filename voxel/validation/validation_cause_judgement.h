#pragma once

#include <string>
#include <vector>

#include "voxel/validation/validation_cause.h"

namespace menger::voxel {

/// Whether a number counts in a report on what is inside the range of validity, or on all, see CauseReport::inside.
bool counts(Validity validity, bool inside);

/// Whether any number in displacement and volume is inside the range of validity.
bool has_inside(const std::vector<CurveComparison>& comparisons);

/// Sets the errors of a trial, of what counts; 0 where no displacement and no volume does.
void judge(CauseTrial& trial, std::vector<CurveComparison> comparisons, bool inside);

/// Which of the trials closes the gap, in a sentence; see explain_miss.
std::string verdict_of(const CauseReport& report);

}  // namespace menger::voxel
