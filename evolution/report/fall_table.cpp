#include "evolution/report/fall_table.h"

#include <array>
#include <set>
#include <string>

namespace menger::evolution {

io::CsvTable fall_table(const RunView& run) {
  io::CsvTable table({"individual", "generation", "scenario", "reason", "dx_m", "dy_m", "dz_m", "body_lengths"});
  std::set<std::string> seen;
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    for (const PoolMember& member : run.archive->pool(generation)) {
      const Individual individual = run.archive->individual(member.id);
      if (individual.generation != generation) continue;
      const Phenotype simulated = as_simulated(run.plan, individual.phenotype);
      if (!seen.insert(phenotype_key(simulated)).second) continue;
      for (const auto& [stage, result] : archived_results_or_half(run, simulated)) {
        if (result.status != io::RunStatus::fell || !result.left_out_m) continue;
        const std::array<double, 3>& moved_m = *result.left_out_m;
        table.add_row(member.id, generation, std::uint64_t{stage.scenario + 1}, result.reason, moved_m[0], moved_m[1], moved_m[2],
                      body_lengths(moved_m, stage.level, run.plan.cell_edge_m));
      }
    }
  }
  return table;
}

}  // namespace menger::evolution
