#include "evolution/reevaluation/reevaluation_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "evolution/search/search_plan.h"
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

/// Distance before displacement counts; empty where it counts from the start.
io::CsvCell left_out_cell(const std::optional<std::array<double, 3>>& left_out_m) {
  return left_out_m ? io::cell(meshes::horizontal_displacement(*left_out_m)) : io::CsvCell{};
}

/// How far the centre was above its start at the lowest; below it, a body has fallen over or in.
template <class Trajectory>
std::optional<double> lowest_rise_m(const Trajectory& trajectory) {
  if (trajectory.empty()) return std::nullopt;
  double lowest = 0.0;
  for (const auto& point : trajectory)
    lowest = std::min(lowest, point.centre_of_mass_m[2] - trajectory.front().centre_of_mass_m[2]);
  return lowest;
}

/// Where the surrogate was at a time, of a trajectory in the order of time that goes so far.
std::array<double, 3> interpolated(const voxel::Trajectory& trajectory, double time_s) {
  const auto after = std::ranges::lower_bound(trajectory, time_s, {}, &voxel::TrajectoryPoint::time_s);
  if (after == trajectory.begin()) return after->centre_of_mass_m;
  if (after == trajectory.end()) return trajectory.back().centre_of_mass_m;
  const auto before = after - 1;
  const double part = (time_s - before->time_s) / (after->time_s - before->time_s);
  std::array<double, 3> position{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    position.at(axis) = std::lerp(before->centre_of_mass_m.at(axis), after->centre_of_mass_m.at(axis), part);
  return position;
}

}  // namespace

io::CsvTable reevaluation_table(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::vector<std::string> columns{"design", "individual", "rank", "selection", "cells"};
  columns.push_back("fitness_" + std::string(fitness_unit(study.search.search.objective)));
  add(columns, "surrogate_", {"status", "outside_validity"});
  add(columns, "surrogate_", motion_columns());
  add(columns, "surrogate_", {"lowest_dz_m"});
  add(columns, "elements_", {"status", "reason", "time_s"});
  add(columns, "elements_", motion_columns());
  add(columns, "elements_", {"lowest_dz_m"});
  add(columns, "",
      {"distance_ratio", "angle_deg", "surrogate_relative_error", "surrogate_steps", "elements_steps", "elements_count",
       "surrogate_seconds", "elements_seconds", "surrogate_left_out_m", "elements_left_out_m", "is_balanced",
       "surrogate_reason"});
  io::CsvTable table(columns);
  for (const JudgedDesign& judged : findings.designs) {
    const Evaluation& surrogate = judged.surrogate.result;
    const LocomotionRun& elements = judged.elements;
    Row row;
    add_name(row, study, judged.design);
    row.insert(row.end(), {io::cell(std::uint64_t{judged.design.body.count()}), io::cell(judged.design.fitness),
                           io::cell(io::to_string(surrogate.status)), io::cell(surrogate.outside_validity)});
    add_motion(row, study, surrogate.displacement_m);
    row.push_back(io::cell(lowest_rise_m(judged.surrogate.trajectory)));
    row.insert(row.end(), {io::cell(status_word(elements)), io::cell(elements.reason), io::cell(elements.time_s)});
    add_motion(row, study, elements.displacement_m);
    row.push_back(io::cell(lowest_rise_m(elements.trajectory)));
    const ModelGap gap = gap_of(study, judged);
    row.insert(row.end(), {io::cell(gap.ratio), io::cell(gap.angle_deg), io::cell(gap.relative_error), io::cell(surrogate.steps),
                           io::cell(elements.steps), io::cell(elements.elements), io::cell(surrogate.seconds),
                           io::cell(elements.seconds), left_out_cell(surrogate.left_out_m), left_out_cell(elements.left_out_m),
                           io::cell(judged.is_balanced ? "true" : "false"), io::cell(surrogate.reason)});
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

io::CsvTable judge_table(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::vector<std::string> columns{"design", "individual", "rank", "selection", "variant", "kind", "status", "reason"};
  add(columns, "", motion_columns());
  add(columns, "", {"relative_change", "change_angle_deg", "surrogate_relative_error", "steps", "elements", "seconds"});
  io::CsvTable table(columns);
  const auto add_row = [&](const JudgedDesign& judged, const std::string& variant, const std::string& kind,
                           const LocomotionRun& run) {
    Row row;
    add_name(row, study, judged.design);
    row.insert(row.end(), {io::cell(variant), io::cell(kind), io::cell(status_word(run)), io::cell(run.reason)});
    add_motion(row, study, run.displacement_m);
    const JudgeChange change = change_of(study, judged.elements, run);
    row.insert(row.end(), {io::cell(change.relative), io::cell(change.angle_deg), io::cell(gap_of(study, judged).relative_error),
                           io::cell(run.steps), io::cell(run.elements), io::cell(run.seconds)});
    table.add_cells(row);
  };
  for (std::size_t n = 0; n < findings.designs.size(); ++n) {
    const auto is_of_design = [&](const VariantRun& run) { return run.design == n; };
    if (std::ranges::none_of(findings.variants, is_of_design)) continue;
    add_row(findings.designs[n], "judge", "judge", findings.designs[n].elements);
    for (const VariantRun& run : findings.variants) {
      if (!is_of_design(run)) continue;
      add_row(findings.designs[n], run.variant.name, run.variant.is_numerical ? "numerical" : "stiffness", run.run);
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
              ranking.compared, ranking.judged, method);
    };
    const auto add_share = [&](const char* quantity, const std::optional<Share>& found) {
      add_row(quantity, found ? std::optional(found->value) : std::nullopt, found ? std::optional(found->interval) : std::nullopt,
              found ? found->count : 0, found ? found->of : 0, "Wilson");
    };
    const auto add_regret = [&](std::size_t k, const std::optional<TopRegret>& found) {
      const std::string top = "top_" + std::to_string(k);
      const char* method = "best of all - best of the surrogate's best";
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

io::CsvTable trajectory_comparison(const JudgedDesign& design) {
  io::CsvTable table({"time_s", "surrogate_dx_m", "surrogate_dy_m", "surrogate_dz_m", "elements_dx_m", "elements_dy_m",
                      "elements_dz_m", "separation_m"});
  const voxel::Trajectory& surrogate = design.surrogate.trajectory;
  const std::vector<Position>& elements = design.elements.trajectory;
  if (surrogate.empty() || elements.empty()) return table;
  const std::array<double, 3> start = surrogate.front().centre_of_mass_m;
  const std::array<double, 3> elements_start = elements.front().centre_of_mass_m;
  for (std::size_t n = 0; n < elements.size(); ++n) {
    const double time_s = elements[n].time_s;
    // The last record of a run that completed may lie a part of a step behind that of the other model.
    const bool is_last = n + 1 == elements.size();
    if (time_s > surrogate.back().time_s && !(is_last && design.surrogate.result.displacement_m)) break;
    std::array<double, 3> a = interpolated(surrogate, time_s);
    std::array<double, 3> b = elements[n].centre_of_mass_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      a.at(axis) -= start.at(axis);
      b.at(axis) -= elements_start.at(axis);
    }
    table.add_row(time_s, a[0], a[1], a[2], b[0], b[1], b[2], std::hypot(b[0] - a[0], b[1] - a[1]));
  }
  return table;
}

}  // namespace menger::evolution
