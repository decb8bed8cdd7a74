#include "evolution/reevaluation/reevaluation_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "evolution/search/search_plan.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {
namespace {

using Row = std::vector<io::CsvCell>;

void add(std::vector<std::string>& columns, const std::string& prefix, const std::vector<std::string>& names) {
  for (const std::string& name : names) columns.push_back(prefix + name);
}

const std::vector<std::string>& motion_columns() {
  static const std::vector<std::string> columns{
      "dx_m", "dy_m", "dz_m", "distance_m", "direction_deg", "body_lengths", "body_lengths_per_minute"};
  return columns;
}

void add_motion(Row& row, const ReevaluationStudy& study, const std::optional<std::array<double, 3>>& displacement_m) {
  if (!displacement_m) {
    row.resize(row.size() + motion_columns().size());
    return;
  }
  const Motion motion = motion_of(study, *displacement_m);
  for (const double value : *displacement_m) row.push_back(io::cell(value));
  row.insert(row.end(), {io::cell(motion.horizontal_m), io::cell(motion.direction_deg), io::cell(motion.body_lengths),
                         io::cell(motion.body_lengths_per_minute)});
}

void add_name(Row& row, const ReevaluationStudy& study, const ChosenDesign& design) {
  row.insert(row.end(), {io::cell(design_hash(design.phenotype, study.level)), io::cell(design.individual),
                         io::cell(std::uint64_t{design.rank}), io::cell(design.is_top ? "top" : "sample")});
}

/// Returns the horizontal distance before displacement counts; empty if it counts from the start.
io::CsvCell left_out_cell(const std::optional<std::array<double, 3>>& left_out_m) {
  return left_out_m ? io::cell(meshes::horizontal_displacement(*left_out_m)) : io::CsvCell{};
}

/// Returns the least height of the centre relative to its start, <= 0. A body with a very low value has fallen over or collapsed.
std::optional<double> lowest_rise_m(const voxel::Trajectory& trajectory) {
  if (trajectory.empty()) return std::nullopt;
  double lowest = 0.0;
  for (const voxel::TrajectoryPoint& point : trajectory) lowest = std::min(lowest, voxel::displacement_m(trajectory, point)[2]);
  return lowest;
}

std::string number_or_dash(const std::optional<double>& value, const char* format) {
  return value ? io::formatted(format, *value) : "-";
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() >= width ? text : std::string(width - text.size(), ' ') + text;
}

std::string design_line(const ReevaluationStudy& study, const ReevaluatedDesign& evaluated) {
  const auto speed = [&](const std::optional<std::array<double, 3>>& displacement_m) {
    return displacement_m ? std::optional(motion_of(study, *displacement_m).body_lengths_per_minute) : std::nullopt;
  };
  const ModelGap gap = gap_of(study, evaluated);
  std::string line = padded(std::to_string(evaluated.design.rank), 5) + padded(evaluated.design.is_top ? "top" : "sample", 8) +
                     padded(std::to_string(evaluated.design.individual), 11) +
                     padded(number_or_dash(speed(evaluated.surrogate.result.displacement_m), "%.3f"), 13) +
                     padded(number_or_dash(speed(evaluated.elements.displacement_m), "%.3f"), 13) +
                     padded(number_or_dash(gap.ratio, "%.3f"), 9) + padded(number_or_dash(gap.angle_deg, "%.0f"), 8) + "  " +
                     std::string(status_word(evaluated.elements));
  if (!evaluated.elements.reason.empty()) line += ": " + evaluated.elements.reason;
  const Evaluation& surrogate = evaluated.surrogate.result;
  if (surrogate.status != io::RunStatus::completed)
    line += "; " + model_of_search(study) + " " + std::string(io::to_string(surrogate.status)) + ": " + surrogate.reason;
  if (!evaluated.is_balanced) line += "; falls over by itself";
  return line + "\n";
}

std::string interval_text(const std::optional<Interval>& interval) {
  if (!interval) return "no interval";
  return "95 % interval " + io::formatted("%.2f", interval->low) + " to " + io::formatted("%.2f", interval->high);
}

std::string correlation_text(const char* name, const std::optional<RankCorrelation>& found) {
  if (!found) return std::string(name) + " has no value";
  return std::string(name) + " " + io::formatted("%.2f", found->value) + " (" + interval_text(found->interval) + ")";
}

std::string direction_text(const char* angle, const std::optional<Share>& found) {
  if (!found) return "";
  return "  directions within " + std::string(angle) + " degrees: " + std::to_string(found->count) + " of " +
         std::to_string(found->of) + " (" + interval_text(found->interval) + ")\n";
}

std::string regret_text(const std::string& model, std::size_t k, const std::optional<TopRegret>& found) {
  if (!found) return "";
  std::string text = "  evaluating only the " + model + "'s best" + (k > 1 ? " " + std::to_string(k) : std::string()) +
                     " on finite elements loses " + io::formatted("%.3f", found->regret) + " of " +
                     io::formatted("%.3f body lengths per minute, the speed of the best design", found->best);
  if (k > 1)
    text += "; " + std::to_string(found->shared) + " of the best " + std::to_string(k) + " designs are the same in both models";
  return text + "\n";
}

std::string ranking_text(const ReevaluationStudy& study, const Ranking& ranking) {
  const std::string model = model_of_search(study);
  std::string text = ranking.name + ": " + std::to_string(ranking.compared) + " of " + std::to_string(ranking.evaluated) +
                     " designs completed in both models\n  rank correlation of the distances: " +
                     correlation_text("Spearman", ranking.spearman) + ", " + correlation_text("Kendall", ranking.kendall) + "\n";
  text += direction_text("45", ranking.within_45_deg) + direction_text("90", ranking.within_90_deg);
  if (!ranking.best && ranking.compared > 1)
    text += "  none of them goes " + io::body_lengths(study.least_body_lengths) +
            " on finite elements, the least that is ranked: slower walks count as none, and none is the best\n";
  text += regret_text(model, 1, ranking.best);
  if (ranking.k > 1) text += regret_text(model, ranking.k, ranking.best_of_k);
  return text;
}

std::string variant_text(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::string text;
  for (const ReferenceError& error : reference_errors(study, findings.designs, findings.variants)) {
    text += error.kind == "numerical" ? "numerical error of the finite elements: " : "the silicone's uncertain stiffness: ";
    text += "displacement changes by up to ";
    text += error.largest_change ? io::formatted("%.0f", 100.0 * *error.largest_change) + " %" : "-";
    text += ", direction by up to " + number_or_dash(error.largest_angle_deg, "%.0f") + " degrees, in " +
            std::to_string(error.compared) + " of " + std::to_string(error.runs) + " runs\n";
  }
  std::vector<double> gaps;
  for (const ReevaluatedDesign& design : findings.designs) {
    if (const auto error = gap_of(study, design).relative_error) gaps.push_back(*error);
  }
  if (text.empty() || gaps.empty()) return text;
  std::ranges::sort(gaps);
  return text + "the " + model_of_search(study) + "'s displacement is off by " +
         io::formatted("%.0f", 100.0 * 0.5 * (gaps[(gaps.size() - 1) / 2] + gaps[gaps.size() / 2])) + " % (median of " +
         std::to_string(gaps.size()) + " designs)\n";
}

/// Returns the digits of a body: its layers from the ground up, joined by "/", each of rows along x that are joined by ",".
std::string layers_text(const meshes::Polycube& body) {
  const std::string digits = body.digits();
  const auto nx = static_cast<std::size_t>(body.nx());
  const std::size_t layer = nx * static_cast<std::size_t>(body.ny());
  std::string text;
  for (std::size_t at = 0; at < digits.size(); at += nx) {
    if (at > 0) text += at % layer == 0 ? '/' : ',';
    text += digits.substr(at, nx);
  }
  return text;
}

/// The model whose numbers are under the columns called surrogate: "voxels", or the elements of the search, "draft elements".
std::string model_under(const ReevaluationStudy& study) {
  if (!study.compares_elements()) return "voxels";
  const fem::ElementChoice& elements = study.search.silicone.elements;
  return std::string(elements.kind == fem::ElementKind::thin_wall ? to_string(elements.fidelity) : "three_field") + " elements";
}

}  // namespace

io::CsvTable reevaluation_table(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::vector<std::string> columns{"design", "individual", "rank", "selection", "cells"};
  columns.push_back("fitness_" + std::string(fitness_unit(study.search.search.objective)));
  add(columns, "surrogate_", {"model", "status", "outside_validity"});
  add(columns, "surrogate_", motion_columns());
  add(columns, "surrogate_", {"least_dz_m"});
  add(columns, "elements_", {"status", "reason", "time_s"});
  add(columns, "elements_", motion_columns());
  add(columns, "elements_", {"least_dz_m"});
  add(columns, "",
      {"distance_ratio", "angle_deg", "surrogate_relative_error", "surrogate_steps", "elements_steps", "elements_count",
       "surrogate_seconds", "elements_seconds", "surrogate_left_out_m", "elements_left_out_m", "is_balanced", "surrogate_reason",
       "body"});
  io::CsvTable table(columns);
  for (const ReevaluatedDesign& evaluated : findings.designs) {
    const Evaluation& surrogate = evaluated.surrogate.result;
    const LocomotionRun& elements = evaluated.elements;
    Row row;
    add_name(row, study, evaluated.design);
    row.insert(row.end(),
               {io::cell(std::uint64_t{evaluated.design.body.count()}), io::cell(evaluated.design.fitness),
                io::cell(model_under(study)), io::cell(io::to_string(surrogate.status)), io::cell(surrogate.outside_validity)});
    add_motion(row, study, surrogate.displacement_m);
    row.push_back(io::cell(lowest_rise_m(evaluated.surrogate.trajectory)));
    row.insert(row.end(), {io::cell(status_word(elements)), io::cell(elements.reason), io::cell(elements.time_s)});
    add_motion(row, study, elements.displacement_m);
    row.push_back(io::cell(lowest_rise_m(elements.trajectory)));
    const ModelGap gap = gap_of(study, evaluated);
    row.insert(row.end(), {io::cell(gap.ratio), io::cell(gap.angle_deg), io::cell(gap.relative_error), io::cell(surrogate.steps),
                           io::cell(elements.steps), io::cell(elements.elements), io::cell(surrogate.seconds),
                           io::cell(elements.seconds), left_out_cell(surrogate.left_out_m), left_out_cell(elements.left_out_m),
                           io::cell(evaluated.is_balanced ? "true" : "false"), io::cell(surrogate.reason),
                           io::cell(layers_text(evaluated.design.body))});
    table.add_cells(row);
  }
  return table;
}

io::CsvTable refused_table(const ReevaluationFindings& findings) {
  io::CsvTable table({"individual", "rank", "fitness", "phenotype", "reason"});
  for (const RefusedDesign& refused : findings.refused)
    table.add_row(refused.individual, std::uint64_t{refused.rank}, refused.fitness, refused.phenotype, refused.reason);
  return table;
}

io::CsvTable variant_table(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::vector<std::string> columns{"design", "individual", "rank", "selection", "variant", "kind", "status", "reason"};
  add(columns, "", motion_columns());
  add(columns, "", {"relative_change", "change_angle_deg", "surrogate_relative_error", "steps", "elements", "seconds"});
  io::CsvTable table(columns);
  const auto add_row = [&](const ReevaluatedDesign& evaluated, const std::string& variant, const std::string& kind,
                           const LocomotionRun& run) {
    Row row;
    add_name(row, study, evaluated.design);
    row.insert(row.end(), {io::cell(variant), io::cell(kind), io::cell(status_word(run)), io::cell(run.reason)});
    add_motion(row, study, run.displacement_m);
    const ReferenceChange change = change_of(study, evaluated.elements, run);
    row.insert(row.end(),
               {io::cell(change.relative), io::cell(change.angle_deg), io::cell(gap_of(study, evaluated).relative_error),
                io::cell(run.steps), io::cell(run.elements), io::cell(run.seconds)});
    table.add_cells(row);
  };
  for (std::size_t n = 0; n < findings.designs.size(); ++n) {
    const auto is_of_design = [&](const VariantRun& run) { return run.design == n; };
    if (std::ranges::none_of(findings.variants, is_of_design)) continue;
    add_row(findings.designs[n], "reference", "reference", findings.designs[n].elements);
    for (const VariantRun& run : findings.variants) {
      if (!is_of_design(run)) continue;
      add_row(findings.designs[n], run.variant.name, std::string(to_string(run.variant.kind)), run.run);
    }
  }
  return table;
}

io::CsvTable ranking_table(const ReevaluationFindings& findings) {
  io::CsvTable table({"designs", "quantity", "value", "low_95", "high_95", "count", "of", "method"});
  for (const Ranking& ranking : findings.rankings) {
    const auto add_row = [&](const std::string& quantity, std::optional<double> value, std::optional<Interval> interval,
                             std::size_t count, std::size_t of, const char* method) {
      table.add_row(ranking.name, quantity, value, interval ? std::optional(interval->low) : std::nullopt,
                    interval ? std::optional(interval->high) : std::nullopt, std::uint64_t{count}, std::uint64_t{of}, method);
    };
    const auto add_correlation = [&](const char* quantity, const std::optional<RankCorrelation>& found, const char* method) {
      add_row(quantity, found ? std::optional(found->value) : std::nullopt, found ? found->interval : std::nullopt,
              ranking.compared, ranking.evaluated, method);
    };
    const auto add_share = [&](const char* quantity, const std::optional<Share>& found) {
      add_row(quantity, found ? std::optional(found->value) : std::nullopt, found ? std::optional(found->interval) : std::nullopt,
              found ? found->count : 0, found ? found->of : 0, "Wilson");
    };
    const auto add_regret = [&](std::size_t k, const std::optional<TopRegret>& found) {
      const std::string top = "top_" + std::to_string(k);
      const char* method = "best of all designs - best of the top k in the model of the search";
      add_row(top + "_regret_body_lengths_per_minute", found ? std::optional(found->regret) : std::nullopt, std::nullopt,
              found ? found->shared : 0, k, method);
      std::optional<double> relative;
      if (found && found->best > 0.0) relative = found->regret / found->best;
      add_row(top + "_relative_regret", relative, std::nullopt, found ? found->shared : 0, k, method);
    };
    add_correlation("spearman", ranking.spearman, "mid-ranks; Fisher z, variance (1 + rho^2 / 2) / (n - 3)");
    add_correlation("kendall", ranking.kendall, "tau-b; Fisher z, variance 0.437 / (n - 4)");
    add_share("direction_within_45_deg", ranking.within_45_deg);
    add_share("direction_within_90_deg", ranking.within_90_deg);
    add_regret(1, ranking.best);
    if (ranking.k > 1) add_regret(ranking.k, ranking.best_of_k);
  }
  return table;
}

io::CsvTable trajectory_comparison(const ReevaluatedDesign& design) {
  io::CsvTable table({"time_s", "surrogate_dx_m", "surrogate_dy_m", "surrogate_dz_m", "elements_dx_m", "elements_dy_m",
                      "elements_dz_m", "separation_m"});
  const voxel::Trajectory& surrogate = design.surrogate.trajectory;
  const voxel::Trajectory& elements = design.elements.trajectory;
  if (surrogate.empty() || elements.empty()) return table;
  for (const voxel::TrajectoryPoint& point : elements) {
    // The last record of a completed run may be later than that of the other model by a part of a step.
    const bool is_last = &point == &elements.back();
    if (point.time_s > surrogate.back().time_s && !(is_last && design.surrogate.result.displacement_m)) break;
    const std::array<double, 3> a = voxel::displacement_m(surrogate, voxel::point_at(surrogate, point.time_s));
    const std::array<double, 3> b = voxel::displacement_m(elements, point);
    table.add_row(point.time_s, a[0], a[1], a[2], b[0], b[1], b[2], std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  return table;
}

std::string findings_text(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  const auto last = measured_periods(study.search);
  std::string measured;
  if (last)
    measured = " (displacement in one period of the last " + std::to_string(last->count) + ")";
  else if (study.measure_from_s > 0.0)
    measured = " (displacement measured from " + io::formatted("%.4g", study.measure_from_s) + " s on)";
  std::string text = std::to_string(findings.designs.size()) + " of " + std::to_string(findings.distinct) +
                     " robots re-evaluated for " + io::formatted("%.4g", study.duration_s) + " s" + measured +
                     ", body lengths per minute:\n" + padded("rank", 5) + padded("set", 8) + padded("individual", 11) +
                     padded(model_of_search(study), 13) + padded("elements", 13) + padded("ratio", 9) + padded("angle", 8) +
                     "  status\n";
  for (const ReevaluatedDesign& evaluated : findings.designs) text += design_line(study, evaluated);
  if (!findings.refused.empty()) {
    text += std::to_string(findings.refused.size()) +
            " designs that would have been chosen cannot be evaluated; the first (rank " +
            std::to_string(findings.refused.front().rank) + "): " + findings.refused.front().reason + "\n";
  }
  for (const Ranking& ranking : findings.rankings) text += ranking_text(study, ranking);
  return text + variant_text(study, findings);
}

}  // namespace menger::evolution
