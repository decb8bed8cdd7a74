#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "evolution/reference/reevaluation_study.h"

namespace menger::evolution {

/// What a variant shows.
enum class VariantKind {
  numerical,    ///< the numerical error: finer elements, shorter steps, other bulk modulus
  sensitivity,  ///< how much a walk hangs on small causes: one per cent of friction or pressure
  stiffness     ///< the uncertainty of the silicone's stiffness
};
std::string_view to_string(VariantKind kind);

/// The reference evaluator with one thing changed.
struct ReferenceVariant {
  std::string name;  ///< "2 elements through the wall", ...
  VariantKind kind = VariantKind::numerical;
  LocomotionOptions options;  ///< finite elements
};

/// Returns the variants that a study asks for, without those that do not differ from the reference evaluator.
std::vector<ReferenceVariant> reference_variants(const ReevaluationStudy& study);

/// The result of a design by a variant.
struct VariantRun {
  std::size_t design = 0;  ///< position among the re-evaluated designs
  ReferenceVariant variant;
  LocomotionRun run;
};

/// The change of a design's displacement from the reference evaluator to a variant.
struct ReferenceChange {
  std::optional<double> relative;   ///< see relative_change
  std::optional<double> angle_deg;  ///< between both displacements
};
ReferenceChange change_of(const ReevaluationStudy& study, const LocomotionRun& reference, const LocomotionRun& variant);

/// The largest changes by one kind of variants, over the designs that these evaluated.
struct ReferenceError {
  std::string kind;  ///< see VariantKind
  std::size_t runs = 0;
  std::size_t compared = 0;  ///< number of these with a displacement by both the variant and the reference evaluator
  std::optional<double> largest_change;
  std::optional<double> largest_angle_deg;
};
std::vector<ReferenceError> reference_errors(const ReevaluationStudy& study, const std::vector<ReevaluatedDesign>& designs,
                                             const std::vector<VariantRun>& runs);

}  // namespace menger::evolution
