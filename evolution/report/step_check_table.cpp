#include "evolution/report/step_check_table.h"

#include <optional>

#include "io/text/formatted.h"

namespace menger::evolution {
namespace {

/// Returns the relative change of a number when the time step is halved: half / whole - 1.
std::optional<double> change(const std::optional<double>& whole, const std::optional<double>& half) {
  if (!whole || !half || *whole == 0.0) return std::nullopt;
  return *half / *whole - 1.0;
}

std::optional<double> lengths_of(const SearchPlan& plan, const Evaluation& result, int level) {
  if (!result.displacement_m) return std::nullopt;
  return body_lengths(*result.displacement_m, level, plan.cell_edge_m);
}

std::string change_text(const std::optional<double>& share) {
  return share ? io::formatted("%+.2g", 100.0 * *share) + " %" : std::string("no comparison");
}

}  // namespace

io::CsvTable step_check_table(const RunView& run) {
  const SearchPlan& plan = run.plan;
  const std::string unit(fitness_unit(plan.objective));
  io::CsvTable table({"generation", "place", "individual", "design", "level", "displacement_body_lengths",
                      "half_step_displacement_body_lengths", "change", "distance_m", "half_step_status", "half_step_reason",
                      "half_step_outside_validity", "half_step_steps", "score_" + unit, "half_step_score_" + unit});
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; generation += plan.step_checks.value().every) {
    std::uint64_t place = 0;
    for (const CheckedDesign& design : checked_designs(plan, *run.archive, generation, run.physics, run.half_step_physics)) {
      for (const CheckedLevel& level : design.levels) {
        const auto whole = lengths_of(plan, level.whole, level.level);
        const auto half = lengths_of(plan, level.half, level.level);
        table.add_row(generation, place, design.elite.individual, design_hash(design.elite.simulated, level.level), level.level,
                      whole, half, change(whole, half), level.distance_m(), io::to_string(level.half.status), level.half.reason,
                      level.half.outside_validity, level.half.steps, whole_step_score(plan, design),
                      half_step_score(plan, design));
      }
      ++place;
    }
  }
  return table;
}

std::string step_check_text(const SearchPlan& plan, int generation, const std::vector<CheckedDesign>& checked) {
  std::string text;
  for (const CheckedDesign& design : checked) {
    const auto whole = whole_step_score(plan, design);
    const auto half = half_step_score(plan, design);
    text += "     time step check, generation " + std::to_string(generation) + ", individual " +
            std::to_string(design.elite.individual) + ": ";
    text += half ? io::formatted("score %.4g with half the time step", *half) + ", " +
                       io::formatted("%.4g with the whole one", whole.value_or(0.0)) + ", " + change_text(change(whole, half))
                 : std::string("no score with half the time step");
    for (const CheckedLevel& level : design.levels) {
      text += "; level " + std::to_string(level.level) + " ";
      text += level.half.displacement_m
                  ? change_text(change(lengths_of(plan, level.whole, level.level), lengths_of(plan, level.half, level.level)))
                  : std::string(io::to_string(level.half.status)) + " (" + level.half.reason + ")";
    }
    text += "\n";
  }
  return text;
}

}  // namespace menger::evolution
