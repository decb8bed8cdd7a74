#pragma once

#include <string>
#include <vector>

#include "evolution/outputs/result_facts.h"
#include "evolution/verdict/finding.h"

namespace menger::evolution {

/// The limits by which the verdict judges rankings, beside those of shapes (shape_findings.h) and walks (meshes::walk_limits).
/// They are choices, which the page states; they decide words, never numbers.
namespace judged_by {
inline constexpr double good_rank = 0.7;    ///< rank correlation from which a ranking can be relied on
inline constexpr double usable_rank = 0.3;  ///< below it, it cannot
}  // namespace judged_by

/// Says in plain words what results mean for their user. Every number has its source. What was not computed is said, with the
/// command that would compute it.
Verdict verdict_of(const ReportFacts& facts);

/// Returns sentences on the limits by which the verdict judges.
std::vector<std::string> judging_words();

}  // namespace menger::evolution
