#include "evolution/report/judgement_table.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/number_text.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {
namespace {

/// The word for how a judgement ended.
std::string_view end_of(const Judgement& judgement) {
  return judgement.found.has_result ? io::to_string(judgement.found.result.status) : "failed";
}

std::vector<Judgement> judgements_until(const RunArchive& archive, int generation) {
  std::vector<Judgement> judgements = archive.judgements();
  std::erase_if(judgements, [&](const Judgement& one) { return one.generation > generation; });
  return judgements;
}

std::string unit_text(const SearchPlan& plan) { return plan.objective == Objective::body_lengths ? " BL" : " m2"; }

}  // namespace

io::CsvTable judgement_table(const RunView& run) {
  const std::string unit(fitness_unit(run.plan.objective));
  io::CsvTable table({"generation", "place", "individual", "design", "form", "surrogate_" + unit, "judge_" + unit, "status",
                      "reason", "judge_dx_m", "judge_dy_m", "judge_dz_m", "judge_left_out_m", "judge_steps", "element_steps",
                      "element_steps_so_far", "judge_seconds"});
  std::uint64_t so_far = 0;
  for (const Judgement& one : run.archive->judgements()) {
    so_far += one.element_steps;
    const Evaluation& result = one.found.result;
    const auto part = [&](std::size_t axis) {
      return result.displacement_m ? std::optional(result.displacement_m->at(axis)) : std::nullopt;
    };
    std::optional<double> left_out_m;
    if (result.left_out_m) left_out_m = meshes::horizontal_displacement(*result.left_out_m);
    table.add_row(one.generation, std::uint64_t{one.place}, one.individual, one.found.design_hash, one.form, one.surrogate,
                  one.score, end_of(one), result.reason, part(0), part(1), part(2), left_out_m, result.steps, one.element_steps,
                  so_far, result.seconds);
  }
  return table;
}

io::CsvTable correction_table(const RunView& run) {
  const std::string unit(fitness_unit(run.plan.objective));
  io::CsvTable table({"generation", "judged", "correction", "ratio", "length_cells", "noise", "left_out_error_" + unit,
                      "left_out_error_of_ratio_" + unit});
  std::set<int> generations;
  for (const Judgement& one : run.archive->judgements()) generations.insert(one.generation);
  for (const int generation : generations) {
    const std::vector<Judgement> judgements = judgements_until(*run.archive, generation);
    const Discrepancy learnt = CorrectedFitness(run.distinction, judgements).discrepancy();
    const bool is_process = learnt.kind() == Correction::gaussian_process;
    table.add_row(generation, std::uint64_t{judgements.size()}, to_string(learnt.kind()), learnt.ratio(),
                  is_process ? std::optional(learnt.length_cells()) : std::nullopt,
                  is_process ? std::optional(learnt.noise()) : std::nullopt, learnt.error(), learnt.error_of_ratio());
  }
  return table;
}

GenerationCost generation_cost(const RunView& run, int generation) {
  GenerationCost cost;
  const std::string physics_hash = io::content_hash(run.physics);
  std::set<EvaluationKey> counted;
  for (const Contender& contender : run.archive->contenders(generation)) {
    const Individual individual = run.archive->individual(contender.id);
    if (individual.generation != generation) continue;
    const Phenotype phenotype = as_simulated(run.plan, individual.phenotype);
    for (const int level : run.plan.levels()) {
      const EvaluationKey key{design_hash(phenotype, level), level, physics_hash};
      const auto found = run.archive->evaluation(key);
      if (!found || found->generation != generation || !counted.insert(key).second) continue;
      cost.voxel_steps += found->result.steps * aggregate_cell_count(phenotype, level) * run.voxels_per_cell;
    }
  }
  for (const Judgement& one : run.archive->judgements())
    cost.element_steps += one.generation == generation ? one.element_steps : 0;
  return cost;
}

io::CsvTable cost_table(const RunView& run) {
  io::CsvTable table({"generation", "voxel_steps", "element_steps", "total_voxel_steps_so_far"});
  const double rate = run.plan.judging ? run.plan.judging->voxel_steps_per_element_step : 0.0;
  double total = 0.0;
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const GenerationCost cost = generation_cost(run, generation);
    total += static_cast<double>(cost.voxel_steps) + rate * static_cast<double>(cost.element_steps);
    table.add_row(generation, cost.voxel_steps, cost.element_steps, total);
  }
  return table;
}

std::string round_text(const SearchPlan& plan, const JudgingRound& round, const Discrepancy& discrepancy) {
  const std::string unit = unit_text(plan);
  std::string text = "     before generation " + std::to_string(round.generation) + ": ";
  if (round.is_exhausted) return text + "the budget of judging is spent, the search goes on with what it has learnt\n";
  if (round.judged.empty()) return text + "no survivor is left to be judged\n";
  text += "judged " + std::to_string(round.judged.size()) + "\n";
  for (const Judgement& one : round.judged) {
    text += "       individual " + std::to_string(one.individual) + ": ";
    text += one.score ? io::formatted("%.4f", *one.score) + unit : std::string(end_of(one)) + ", no fitness";
    text += ", surrogate " + io::formatted("%.4f", one.surrogate) + unit;
    if (!one.found.result.reason.empty()) text += " (" + one.found.result.reason + ")";
    text += "\n";
  }
  text += "       correction: " + std::string(to_string(discrepancy.kind())) + ", ratio " +
          io::formatted("%.3f", discrepancy.ratio());
  if (discrepancy.error()) text += ", error on robots left out " + io::formatted("%.4f", *discrepancy.error()) + unit;
  return text + "; " + io::formatted("%.3g", static_cast<double>(round.element_steps)) + " of " +
         io::formatted("%.3g", plan.judging->budget_element_steps) + " element-steps spent\n";
}

std::optional<Judgement> best_judged(const RunArchive& archive) {
  const std::vector<Judgement> judgements = archive.judgements();
  const auto best = std::ranges::max_element(judgements, {}, &Judgement::score);
  return best == judgements.end() || !best->score ? std::nullopt : std::optional(*best);
}

std::string judging_text(const RunView& run) {
  const std::vector<Judgement> judgements = run.archive->judgements();
  const auto failed = std::ranges::count_if(judgements, [](const Judgement& one) { return !one.score; });
  std::string text = std::to_string(judgements.size()) + " robots judged, " + std::to_string(failed) + " without a fitness";
  if (const auto best = best_judged(*run.archive)) {
    const std::string unit = unit_text(run.plan);
    text += "; the best: individual " + std::to_string(best->individual) + ", " + io::formatted("%.4f", *best->score) + unit +
            ", surrogate " + io::formatted("%.4f", best->surrogate) + unit;
  }
  GenerationCost sum;
  for (int generation = 0; generation <= run.archive->last_generation().value(); ++generation) {
    const GenerationCost cost = generation_cost(run, generation);
    sum.voxel_steps += cost.voxel_steps;
    sum.element_steps += cost.element_steps;
  }
  const double rate = run.plan.judging->voxel_steps_per_element_step;
  const double total = static_cast<double>(sum.voxel_steps) + rate * static_cast<double>(sum.element_steps);
  return text + "\nbudget: " + io::formatted("%.4g", static_cast<double>(sum.voxel_steps)) + " voxel-steps and " +
         io::formatted("%.4g", static_cast<double>(sum.element_steps)) + " element-steps of " + io::number_text(rate) +
         " voxel-steps each, together " + io::formatted("%.4g", total) + " voxel-steps\n";
}

}  // namespace menger::evolution
