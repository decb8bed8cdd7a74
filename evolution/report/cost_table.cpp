#include "evolution/report/cost_table.h"

#include <set>
#include <string>
#include <vector>

#include "io/text/content_hash.h"

namespace menger::evolution {
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
  cost.voxel_steps += screening_voxel_steps(run, generation);
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
