#pragma once

#include <string>

#include "evolution/outputs/result_facts.h"
#include "evolution/verdict/finding.h"

namespace menger::evolution {

/// The limits by which the verdict judges shapes of several bodies. They are choices, which the page states; they decide words,
/// never numbers.
namespace judged_by {
inline constexpr double good_error = 0.10;    ///< median error of shapes up to which they can be relied on
inline constexpr double usable_error = 0.25;  ///< above it they cannot
}  // namespace judged_by

/// Returns the finding on the shapes of a validation, without the end of its finite elements.
Finding finding_on_shapes(const ValidationFacts& facts);
Finding validation_finding(const ValidationFacts& facts);
Finding calibration_finding(const CalibrationFacts& facts);

/// Returns the worst of what validations mean for the shapes of the surrogate; missing if nothing was compared.
Tone tone_of_shapes(const ReportFacts& facts);

/// Returns the sentence of the headline on shapes. @param worst see tone_of_shapes; not missing
std::string shape_headline(const ReportFacts& facts, Tone worst, bool were_walks_compared);

}  // namespace menger::evolution
