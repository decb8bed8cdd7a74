#include "evolution/search/search_plan.h"

#include <algorithm>
#include <cmath>

#include "evolution/genome/robot_form.h"
#include "meshes/design/fractal.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {

std::string_view to_string(Objective objective) {
  return objective == Objective::body_lengths ? "body-lengths" : "squared-metres-per-scale";
}

std::string_view to_string(DuplicatePolicy policy) {
  switch (policy) {
    case DuplicatePolicy::archived_result:
      return "archived-result";
    case DuplicatePolicy::culled:
      return "culled";
    case DuplicatePolicy::redrawn:
      return "redrawn";
  }
  return "";
}

std::string_view to_string(SelectionTime time) { return time == SelectionTime::generational ? "generational" : "steady_state"; }

std::size_t SearchPlan::left_out_scenarios() const {
  constexpr double rounding = 1e-9;  // of a share that was written in decimals
  const auto left_out = static_cast<std::size_t>(quantile * static_cast<double>(scenarios) + rounding);
  return std::min(left_out, scenarios - 1);  // a quantile next to 1 is rounded to all of them
}

Phenotype as_simulated(const SearchPlan& plan, const Phenotype& phenotype) {
  return plan.stand ? standing(phenotype) : phenotype;
}

double body_lengths(const std::array<double, 3>& displacement_m, int level, double cell_edge_m) {
  return meshes::horizontal_displacement(displacement_m) / meshes::body_length_m(level, cell_edge_m);
}

double level_score(const SearchPlan& plan, const std::array<double, 3>& displacement_m, int level) {
  if (plan.objective == Objective::body_lengths) return body_lengths(displacement_m, level, plan.cell_edge_m);
  const double squared_m2 = displacement_m[0] * displacement_m[0] + displacement_m[1] * displacement_m[1];
  return squared_m2 / std::pow(3.0, level);
}

std::string_view fitness_unit(Objective objective) { return objective == Objective::body_lengths ? "body_lengths" : "m2"; }

}  // namespace menger::evolution
