#include "evolution/reevaluation/reference_error.h"

#include <algorithm>
#include <utility>

#include "io/text/number_text.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {
namespace {

constexpr double pascal_per_kilopascal = 1e3;

void widen(std::optional<double>& largest, const std::optional<double>& value) {
  if (value) largest = std::max(largest.value_or(0.0), *value);
}

/// Returns the next finer elements and their name; the same elements if there are none.
std::pair<std::string, LocomotionOptions> finer_elements(LocomotionOptions elements, const VariantOptions& options) {
  if (elements.elements.kind == fem::ElementKind::three_field) {
    elements.elements_through_wall = options.elements_through_wall;
    return {std::to_string(elements.elements_through_wall) + " elements through the wall", elements};
  }
  if (elements.elements.fidelity == fem::Fidelity::draft) {
    elements.elements.fidelity = fem::Fidelity::standard;
    return {"fidelity standard", elements};
  }
  elements.elements.fidelity = fem::Fidelity::fine;
  return {"fidelity fine", elements};
}

}  // namespace

std::string_view to_string(VariantKind kind) {
  switch (kind) {
    case VariantKind::numerical:
      return "numerical";
    case VariantKind::sensitivity:
      return "sensitivity";
    case VariantKind::stiffness:
      break;
  }
  return "stiffness";
}

std::vector<ReferenceVariant> reference_variants(const ReevaluationStudy& study) {
  std::vector<ReferenceVariant> variants;
  if (!study.variants) return variants;
  const VariantOptions& options = *study.variants;
  const auto add = [&](std::string name, VariantKind kind, const LocomotionOptions& elements) {
    if (elements == study.elements) return;
    variants.push_back({.name = std::move(name), .kind = kind, .options = elements});
  };
  if (options.finer_elements) {
    const auto [name, finer] = finer_elements(study.elements, options);
    add(name, VariantKind::numerical, finer);
  }
  LocomotionOptions stiffer = study.elements;
  stiffer.bulk_modulus_ratio *= options.bulk_modulus_factor;
  add("bulk modulus ratio " + io::number_text(stiffer.bulk_modulus_ratio), VariantKind::numerical, stiffer);
  LocomotionOptions slower = study.elements;
  slower.step_safety *= options.step_factor;
  add("step safety " + io::number_text(slower.step_safety), VariantKind::numerical, slower);
  LocomotionOptions rougher = study.elements;
  rougher.friction_factor = options.friction_factor;
  add("friction times " + io::number_text(rougher.friction_factor), VariantKind::sensitivity, rougher);
  LocomotionOptions stronger = study.elements;
  stronger.pressure_factor = options.pressure_factor;
  add("pressure times " + io::number_text(stronger.pressure_factor), VariantKind::sensitivity, stronger);
  for (const double modulus_Pa : options.youngs_moduli_Pa) {
    LocomotionOptions softer = study.elements;
    softer.youngs_modulus_Pa = modulus_Pa;
    add("E " + io::number_text(modulus_Pa / pascal_per_kilopascal) + " kPa", VariantKind::stiffness, softer);
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
  for (const VariantKind kind : {VariantKind::numerical, VariantKind::sensitivity, VariantKind::stiffness}) {
    ReferenceError error{.kind = std::string(to_string(kind)), .largest_change = {}, .largest_angle_deg = {}};
    for (const VariantRun& run : runs) {
      if (run.variant.kind != kind) continue;
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
