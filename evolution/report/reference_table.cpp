#include "evolution/report/reference_table.h"

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

/// Returns the word for how a reference evaluation ended.
std::string_view end_of(const ReferenceEvaluation& evaluation) {
  return evaluation.found.has_result ? io::to_string(evaluation.found.result.status) : "failed";
}

std::vector<ReferenceEvaluation> reference_evaluations_until(const RunArchive& archive, int generation) {
  std::vector<ReferenceEvaluation> evaluations = archive.reference_evaluations();
  std::erase_if(evaluations, [&](const ReferenceEvaluation& one) { return one.generation > generation; });
  return evaluations;
}

std::string unit_text(const SearchPlan& plan) { return plan.objective == Objective::body_lengths ? " BL" : " m2"; }

}  // namespace

io::CsvTable reference_table(const RunView& run) {
  const std::string unit(fitness_unit(run.plan.objective));
  io::CsvTable table({"generation", "place", "individual", "design", "form", "surrogate_" + unit, "reference_" + unit, "status",
                      "reason", "reference_dx_m", "reference_dy_m", "reference_dz_m", "reference_left_out_m", "reference_steps",
                      "element_steps", "element_steps_so_far", "reference_seconds"});
  std::uint64_t so_far = 0;
  for (const ReferenceEvaluation& one : run.archive->reference_evaluations()) {
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
  io::CsvTable table({"generation", "evaluated", "correction", "ratio", "length_cells", "noise", "left_out_error_" + unit,
                      "left_out_error_of_ratio_" + unit});
  std::set<int> generations;
  for (const ReferenceEvaluation& one : run.archive->reference_evaluations()) generations.insert(one.generation);
  for (const int generation : generations) {
    const std::vector<ReferenceEvaluation> evaluations = reference_evaluations_until(*run.archive, generation);
    const Discrepancy learnt = CorrectedFitness(run.distinction, evaluations).discrepancy();
    const bool is_process = learnt.kind() == Correction::gaussian_process;
    table.add_row(generation, std::uint64_t{evaluations.size()}, to_string(learnt.kind()), learnt.ratio(),
                  is_process ? std::optional(learnt.length_cells()) : std::nullopt,
                  is_process ? std::optional(learnt.noise()) : std::nullopt, learnt.error(), learnt.error_of_ratio());
  }
  return table;
}

namespace {

/// Returns the voxel-steps of screening the new individuals of a generation.
std::uint64_t screening_voxel_steps(const RunView& run, int generation) {
  if (run.screening_physics.empty()) return 0;
  const std::string physics_hash = io::content_hash(run.screening_physics);
  const int level = run.plan.levels().front();
  std::uint64_t sum = 0;
  std::set<std::string> counted;
  for (const PoolMember& member : run.archive->pool(generation)) {
    const Phenotype phenotype = as_simulated(run.plan, run.archive->individual(member.id).phenotype);
    const std::string design = design_hash(phenotype, level);
    const auto found = run.archive->evaluation({design, level, physics_hash});
    if (!found || found->generation != generation || !counted.insert(design).second) continue;
    sum += found->result.steps * aggregate_cell_count(phenotype, level) * run.voxels_per_cell;
  }
  return sum;
}

}  // namespace

GenerationCost generation_cost(const RunView& run, int generation) {
  GenerationCost cost;
  const std::string physics_hash = io::content_hash(run.physics);
  std::set<EvaluationKey> counted;
  for (const PoolMember& member : run.archive->pool(generation)) {
    const Individual individual = run.archive->individual(member.id);
    if (individual.generation != generation) continue;
    const Phenotype phenotype = as_simulated(run.plan, individual.phenotype);
    for (const int level : run.plan.levels()) {
      const EvaluationKey key{design_hash(phenotype, level), level, physics_hash};
      const auto found = run.archive->evaluation(key);
      if (!found || found->generation != generation || !counted.insert(key).second) continue;
      if (run.has_elements)
        cost.element_steps += found->result.steps * found->result.elements;
      else
        cost.voxel_steps += found->result.steps * aggregate_cell_count(phenotype, level) * run.voxels_per_cell;
    }
  }
  cost.voxel_steps += screening_voxel_steps(run, generation);
  for (const ReferenceEvaluation& one : run.archive->reference_evaluations())
    cost.element_steps += one.generation == generation ? one.element_steps : 0;
  return cost;
}

io::CsvTable cost_table(const RunView& run) {
  io::CsvTable table({"generation", "voxel_steps", "element_steps", "total_voxel_steps_so_far"});
  const double rate = run.plan.reference.value_or(ReferencePlan{}).voxel_steps_per_element_step;
  double total = 0.0;
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const GenerationCost cost = generation_cost(run, generation);
    total += static_cast<double>(cost.voxel_steps) + rate * static_cast<double>(cost.element_steps);
    table.add_row(generation, cost.voxel_steps, cost.element_steps, total);
  }
  return table;
}

std::string round_text(const SearchPlan& plan, const ReferenceRound& round, const Discrepancy& discrepancy) {
  const std::string unit = unit_text(plan);
  std::string text = "     before generation " + std::to_string(round.generation) + ": ";
  if (round.is_exhausted)
    return text + "the budget of reference evaluations is used up; the search continues with the last correction\n";
  if (round.evaluated.empty()) return text + "all survivors that can be evaluated have a reference evaluation already\n";
  text += "reference evaluations: " + std::to_string(round.evaluated.size()) + "\n";
  for (const ReferenceEvaluation& one : round.evaluated) {
    text += "       individual " + std::to_string(one.individual) + ": ";
    text += one.score ? io::formatted("%.4f", *one.score) + unit : std::string(end_of(one)) + ", no fitness";
    text += ", surrogate " + io::formatted("%.4f", one.surrogate) + unit;
    if (!one.found.result.reason.empty()) text += " (" + one.found.result.reason + ")";
    text += "\n";
  }
  text += "       correction: " + std::string(to_string(discrepancy.kind())) + ", ratio " +
          io::formatted("%.3f", discrepancy.ratio());
  if (discrepancy.error()) text += ", leave-one-out error " + io::formatted("%.4f", *discrepancy.error()) + unit;
  return text + "; " + io::formatted("%.3g", static_cast<double>(round.element_steps)) + " of " +
         io::formatted("%.3g", plan.reference->budget_element_steps) + " element-steps spent\n";
}

std::optional<ReferenceEvaluation> best_by_reference(const RunArchive& archive) {
  const std::vector<ReferenceEvaluation> evaluations = archive.reference_evaluations();
  const auto best = std::ranges::max_element(evaluations, {}, &ReferenceEvaluation::score);
  return best == evaluations.end() || !best->score ? std::nullopt : std::optional(*best);
}

std::string reference_summary(const RunView& run) {
  const std::vector<ReferenceEvaluation> evaluations = run.archive->reference_evaluations();
  const auto failed = std::ranges::count_if(evaluations, [](const ReferenceEvaluation& one) { return !one.score; });
  std::string text =
      std::to_string(evaluations.size()) + " reference evaluations, " + std::to_string(failed) + " without a fitness";
  if (const auto best = best_by_reference(*run.archive)) {
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
  const double rate = run.plan.reference->voxel_steps_per_element_step;
  const double total = static_cast<double>(sum.voxel_steps) + rate * static_cast<double>(sum.element_steps);
  return text + "\ncost: " + io::formatted("%.4g", static_cast<double>(sum.voxel_steps)) + " voxel-steps and " +
         io::formatted("%.4g", static_cast<double>(sum.element_steps)) + " element-steps of " + io::number_text(rate) +
         " voxel-steps each, together " + io::formatted("%.4g", total) + " voxel-steps\n";
}

}  // namespace menger::evolution
