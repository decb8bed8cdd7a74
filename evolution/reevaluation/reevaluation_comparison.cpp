#include "evolution/reevaluation/reevaluation_comparison.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshes/design/fractal.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

double body_length_m(const ReevaluationStudy& study) {
  return meshes::body_length_m(study.level, study.search.search.cell_edge_m);
}

double least_m(const ReevaluationStudy& study) { return study.least_body_lengths * body_length_m(study); }

/// Returns whether a distance is large enough to divide by it.
bool is_enough(double distance_m, double least) { return distance_m > 0.0 && distance_m >= least; }

/// Returns body lengths per minute, or 0 if the distance is too small for ranking.
double ranked_speed(const ReevaluationStudy& study, const std::array<double, 3>& displacement_m) {
  const Motion motion = motion_of(study, displacement_m);
  return is_enough(motion.horizontal_m, least_m(study)) ? motion.body_lengths_per_minute : 0.0;
}

/// Returns the regret, or none if k is the number of all designs, or if none of them goes far enough on finite elements to be
/// ranked, since it would be 0.
std::optional<TopRegret> regret_of(const std::vector<double>& surrogate, const std::vector<double>& elements, std::size_t k) {
  const bool has_best = std::ranges::any_of(elements, [](double speed) { return speed > 0.0; });
  return has_best && k < surrogate.size() ? top_regret(surrogate, elements, k) : std::nullopt;
}

}  // namespace

std::string model_of_search(const ReevaluationStudy& study) { return study.compares_elements() ? "search" : "surrogate"; }

Motion motion_of(const ReevaluationStudy& study, const std::array<double, 3>& displacement_m) {
  constexpr double seconds_per_minute = 60.0;
  Motion motion;
  motion.horizontal_m = meshes::horizontal_displacement(displacement_m);
  const double angle = std::atan2(displacement_m[1], displacement_m[0]) * degrees_per_radian;
  if (is_enough(motion.horizontal_m, least_m(study))) motion.direction_deg = angle <= -180.0 ? 180.0 : angle;
  motion.body_lengths = motion.horizontal_m / body_length_m(study);
  motion.body_lengths_per_minute = motion.body_lengths * seconds_per_minute / study.measured_s();
  return motion;
}

std::optional<double> angle_between_deg(const std::array<double, 3>& a, const std::array<double, 3>& b, double least) {
  if (!is_enough(meshes::horizontal_displacement(a), least) || !is_enough(meshes::horizontal_displacement(b), least))
    return std::nullopt;
  const double along = a[0] * b[0] + a[1] * b[1];
  const double across = a[0] * b[1] - a[1] * b[0];
  return std::abs(std::atan2(across, along)) * degrees_per_radian;
}

std::optional<double> relative_change(const std::array<double, 3>& a, const std::array<double, 3>& b, double least) {
  const double distance_m = meshes::horizontal_displacement(a);
  if (!is_enough(distance_m, least)) return std::nullopt;
  return std::hypot(b[0] - a[0], b[1] - a[1]) / distance_m;
}

ModelGap gap_of(const ReevaluationStudy& study, const ReevaluatedDesign& design) {
  const auto& surrogate = design.surrogate.result.displacement_m;
  const auto& elements = design.elements.displacement_m;
  if (!surrogate || !elements) return {};
  const double least = least_m(study);
  ModelGap gap{.ratio = {},
               .angle_deg = angle_between_deg(*surrogate, *elements, least),
               .relative_error = relative_change(*elements, *surrogate, least)};
  const double distance_m = meshes::horizontal_displacement(*surrogate);
  if (is_enough(distance_m, least)) gap.ratio = meshes::horizontal_displacement(*elements) / distance_m;
  return gap;
}

Ranking rank_designs(const ReevaluationStudy& study, const std::string& name, std::span<const ReevaluatedDesign* const> designs,
                     std::size_t k) {
  std::vector<double> surrogate;
  std::vector<double> elements;
  std::size_t with_direction = 0;
  std::size_t within_45 = 0;
  std::size_t within_90 = 0;
  for (const ReevaluatedDesign* design : designs) {
    if (!design->surrogate.result.displacement_m || !design->elements.displacement_m) continue;
    surrogate.push_back(ranked_speed(study, *design->surrogate.result.displacement_m));
    elements.push_back(ranked_speed(study, *design->elements.displacement_m));
    const auto angle = gap_of(study, *design).angle_deg;
    if (!angle) continue;
    ++with_direction;
    if (*angle <= 45.0) ++within_45;
    if (*angle <= 90.0) ++within_90;
  }
  return {.name = name,
          .evaluated = designs.size(),
          .compared = surrogate.size(),
          .spearman = spearman_correlation(surrogate, elements),
          .kendall = kendall_correlation(surrogate, elements),
          .within_45_deg = share(within_45, with_direction),
          .within_90_deg = share(within_90, with_direction),
          .best = regret_of(surrogate, elements, 1),
          .best_of_k = regret_of(surrogate, elements, k),
          .k = k};
}

std::vector<Ranking> rank_all(const ReevaluationStudy& study, const std::vector<ReevaluatedDesign>& designs) {
  std::vector<const ReevaluatedDesign*> all;
  std::vector<const ReevaluatedDesign*> top;
  std::vector<const ReevaluatedDesign*> sample;
  std::vector<const ReevaluatedDesign*> balanced;
  for (const ReevaluatedDesign& design : designs) {
    all.push_back(&design);
    (design.design.is_top ? top : sample).push_back(&design);
    if (design.is_balanced) balanced.push_back(&design);
  }
  std::vector<Ranking> rankings;
  const auto add = [&](const std::string& name, const std::vector<const ReevaluatedDesign*>& set) {
    if (set.size() >= 2) rankings.push_back(rank_designs(study, name, set, study.top));
  };
  if (!sample.empty()) add("sample", sample);
  if (!sample.empty()) add("top", top);
  if (balanced.size() < all.size()) add("balanced", balanced);
  add("all", all);
  return rankings;
}

}  // namespace menger::evolution
