#include "evolution/report/cost_table.h"

#include <set>
#include <string>
#include <vector>

#include "io/text/content_hash.h"

namespace menger::evolution {
namespace {

/// Adds the steps of screening the new individuals of a generation. A walk that went on in the same generation has its first half
/// among its own steps. One that went on in a later generation is counted whole there, although its first half was counted
/// before: whether that half had to be made anew depends on interruptions, and the count must not.
void add_screening(const RunView& run, int generation, GenerationCost& cost) {
  if (run.screening_physics.empty()) return;
  const bool by_halves = run.plan.screening->by == Screener::half_walks;
  const std::string whole_hash = run.physics_hashes().front();
  const std::string physics_hash = io::content_hash(run.screening_physics);
  const int level = run.plan.first_level();
  std::set<std::string> counted;
  for (const PoolMember& member : run.archive->pool(generation)) {
    const Phenotype phenotype = as_simulated(run.plan, run.archive->individual(member.id).phenotype);
    const std::string design = design_hash(phenotype, level);
    const auto found = run.archive->evaluation({design, level, physics_hash});
    if (!found || found->generation != generation || !counted.insert(design).second) continue;
    if (!by_halves) {
      cost.voxel_steps += found->result.steps * aggregate_cell_count(phenotype, level) * run.voxels_per_cell;
      continue;
    }
    const auto whole = run.archive->evaluation({design, level, whole_hash});
    if (!whole || whole->generation != generation) cost.element_steps += found->result.steps * found->result.elements;
  }
}

}  // namespace

double counted_cost(const GenerationCost& cost, const Budget& budget) {
  return static_cast<double>(cost.element_steps) + static_cast<double>(cost.voxel_steps) / budget.voxel_steps_per_element_step;
}

GenerationCost generation_cost(const RunView& run, int generation) {
  GenerationCost cost;
  const std::vector<std::string> hashes = run.physics_hashes();
  std::set<EvaluationKey> counted;
  for (const PoolMember& member : run.archive->pool(generation)) {
    const Individual individual = run.archive->individual(member.id);
    if (individual.generation != generation) continue;
    const Phenotype phenotype = as_simulated(run.plan, individual.phenotype);
    for (const auto& [level, scenario] : stages(run.plan)) {
      const EvaluationKey key{design_hash(phenotype, level), level, hashes.at(scenario)};
      const auto found = run.archive->evaluation(key);
      if (!found || found->generation != generation || !counted.insert(key).second) continue;
      if (run.has_elements)
        cost.element_steps += found->result.steps * found->result.elements;
      else
        cost.voxel_steps += found->result.steps * aggregate_cell_count(phenotype, level) * run.voxels_per_cell;
    }
  }
  add_screening(run, generation, cost);
  return cost;
}

io::CsvTable cost_table(const RunView& run) {
  io::CsvTable table({"generation", "voxel_steps", "element_steps"});
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const GenerationCost cost = generation_cost(run, generation);
    table.add_row(generation, cost.voxel_steps, cost.element_steps);
  }
  return table;
}

}  // namespace menger::evolution
