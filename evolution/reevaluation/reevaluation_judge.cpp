#include "evolution/reevaluation/reevaluation_judge.h"

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

std::vector<JudgeVariant> judge_variants(const ReevaluationStudy& study) {
  std::vector<JudgeVariant> variants;
  if (!study.judge) return variants;
  const JudgeOptions& judge = *study.judge;
  const auto add = [&](std::string name, bool is_numerical, const LocomotionOptions& options) {
    if (options == study.elements) return;
    variants.push_back({.name = std::move(name), .is_numerical = is_numerical, .options = options});
  };
  LocomotionOptions through = study.elements;
  through.elements_through_wall = judge.elements_through_wall;
  add(std::to_string(through.elements_through_wall) + " elements through the wall", true, through);
  LocomotionOptions stiffer = study.elements;
  stiffer.bulk_modulus_ratio *= judge.bulk_modulus_factor;
  add("bulk modulus ratio " + io::number_text(stiffer.bulk_modulus_ratio), true, stiffer);
  LocomotionOptions slower = study.elements;
  slower.step_safety *= judge.step_factor;
  add("step safety " + io::number_text(slower.step_safety), true, slower);
  for (const double modulus_Pa : judge.youngs_moduli_Pa) {
    LocomotionOptions options = study.elements;
    options.youngs_modulus_Pa = modulus_Pa;
    add("E " + io::number_text(modulus_Pa / pascal_per_kilopascal) + " kPa", false, options);
  }
  return variants;
}

JudgeChange change_of(const ReevaluationStudy& study, const LocomotionRun& judge, const LocomotionRun& variant) {
  if (!judge.displacement_m || !variant.displacement_m) return {};
  const double least_m = study.least_body_lengths * meshes::body_length_m(study.level, study.search.search.cell_edge_m);
  return {.relative = relative_change(*judge.displacement_m, *variant.displacement_m, least_m),
          .angle_deg = angle_between_deg(*judge.displacement_m, *variant.displacement_m, least_m)};
}

std::vector<JudgeError> judge_errors(const ReevaluationStudy& study, const std::vector<JudgedDesign>& designs,
                                     const std::vector<VariantRun>& runs) {
  std::vector<JudgeError> errors;
  for (const bool is_numerical : {true, false}) {
    JudgeError error{.kind = is_numerical ? "numerical" : "stiffness", .largest_change = {}, .largest_angle_deg = {}};
    for (const VariantRun& run : runs) {
      if (run.variant.is_numerical != is_numerical) continue;
      ++error.runs;
      const LocomotionRun& judge = designs.at(run.design).elements;
      if (judge.displacement_m && run.run.displacement_m) ++error.compared;
      const JudgeChange change = change_of(study, judge, run.run);
      widen(error.largest_change, change.relative);
      widen(error.largest_angle_deg, change.angle_deg);
    }
    if (error.runs > 0) errors.push_back(error);
  }
  return errors;
}

}  // namespace menger::evolution
