#include "evolution/reevaluation/reference_error.h"

#include <algorithm>
#include <utility>

#include "io/text/number_text.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {
namespace {

constexpr double pascal_per_kilopascal = 1e3;

void widen(std::optional<double>& largest, const std::optional<double>& value) {
  if (value) largest = std::max(largest.value_or(0.0), *value);
}

}  // namespace

std::vector<ReferenceVariant> reference_variants(const ReevaluationStudy& study) {
  std::vector<ReferenceVariant> variants;
  if (!study.variants) return variants;
  const VariantOptions& options = *study.variants;
  const auto add = [&](std::string name, bool is_numerical, const LocomotionOptions& elements) {
    if (elements == study.elements) return;
    variants.push_back({.name = std::move(name), .is_numerical = is_numerical, .options = elements});
  };
  LocomotionOptions through = study.elements;
  through.elements_through_wall = options.elements_through_wall;
  add(std::to_string(through.elements_through_wall) + " elements through the wall", true, through);
  LocomotionOptions stiffer = study.elements;
  stiffer.bulk_modulus_ratio *= options.bulk_modulus_factor;
  add("bulk modulus ratio " + io::number_text(stiffer.bulk_modulus_ratio), true, stiffer);
  LocomotionOptions slower = study.elements;
  slower.step_safety *= options.step_factor;
  add("step safety " + io::number_text(slower.step_safety), true, slower);
  for (const double modulus_Pa : options.youngs_moduli_Pa) {
    LocomotionOptions softer = study.elements;
    softer.youngs_modulus_Pa = modulus_Pa;
    add("E " + io::number_text(modulus_Pa / pascal_per_kilopascal) + " kPa", false, softer);
  }
  return variants;
}

ReferenceChange change_of(const ReevaluationStudy& study, const LocomotionRun& reference, const LocomotionRun& variant) {
  if (!reference.displacement_m || !variant.displacement_m) return {};
  const double least_m = study.least_body_lengths * meshes::body_length_m(study.level, study.search.search.cell_edge_m);
  return {.relative = relative_change(*reference.displacement_m, *variant.displacement_m, least_m),
          .angle_deg = angle_between_deg(*reference.displacement_m, *variant.displacement_m, least_m)};
}

std::vector<ReferenceError> reference_errors(const ReevaluationStudy& study, const std::vector<ReevaluatedDesign>& designs,
                                             const std::vector<VariantRun>& runs) {
  std::vector<ReferenceError> errors;
  for (const bool is_numerical : {true, false}) {
    ReferenceError error{.kind = is_numerical ? "numerical" : "stiffness", .largest_change = {}, .largest_angle_deg = {}};
    for (const VariantRun& run : runs) {
      if (run.variant.is_numerical != is_numerical) continue;
      ++error.runs;
      const LocomotionRun& reference = designs.at(run.design).elements;
      if (reference.displacement_m && run.run.displacement_m) ++error.compared;
      const ReferenceChange change = change_of(study, reference, run.run);
      widen(error.largest_change, change.relative);
      widen(error.largest_angle_deg, change.angle_deg);
    }
    if (error.runs > 0) errors.push_back(error);
  }
  return errors;
}

}  // namespace menger::evolution
