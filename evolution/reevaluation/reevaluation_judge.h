#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "evolution/reference/reevaluation_study.h"

namespace menger::evolution {

/// The judge with one thing different.
struct JudgeVariant {
  std::string name;           ///< "2 elements through the wall", ...
  bool is_numerical = true;   ///< the judge's own error; else what is not known of the silicone
  LocomotionOptions options;  ///< finite elements
};

/// The variants that a study asks for; what is the judge itself is left out.
std::vector<JudgeVariant> judge_variants(const ReevaluationStudy& study);

/// A design judged by a variant.
struct VariantRun {
  std::size_t design = 0;  ///< position among the judged designs
  JudgeVariant variant;
  LocomotionRun run;
};

/// How far a variant moves the judge's answer on one design, and how far the surrogate is from it.
struct JudgeChange {
  std::optional<double> relative;   ///< see relative_change, from the judge to the variant
  std::optional<double> angle_deg;  ///< between both
};
JudgeChange change_of(const ReevaluationStudy& study, const LocomotionRun& judge, const LocomotionRun& variant);

/// The largest change of a kind of variants over the designs that were judged so.
struct JudgeError {
  std::string kind;  ///< "numerical" or "stiffness"
  std::size_t runs = 0;
  std::size_t compared = 0;  ///< of which both have a displacement
  std::optional<double> largest_change;
  std::optional<double> largest_angle_deg;
};
std::vector<JudgeError> judge_errors(const ReevaluationStudy& study, const std::vector<JudgedDesign>& designs,
                                     const std::vector<VariantRun>& runs);

}  // namespace menger::evolution
