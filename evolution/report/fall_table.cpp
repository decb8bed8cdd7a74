#include "evolution/report/fall_table.h"

#include <array>
#include <set>
#include <string>

#include "io/text/content_hash.h"

namespace menger::evolution {
namespace {

/// Returns the result of the first half of a walk that went no further.
KnownResults first_half(const RunView& run, const Phenotype& simulated) {
  if (!run.plan.screening || run.plan.screening->by != Screener::half_walks) return {};
  const int level = run.plan.levels().front();
  const auto half = run.archive->evaluation({design_hash(simulated, level), level, io::content_hash(run.screening_physics)});
  if (!half) return {};
  return {{EvaluationStage{level, 0}, half->result}};
}

}  // namespace

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
      KnownResults results = archived_results(run, simulated);
      if (results.empty()) results = first_half(run, simulated);
      for (const auto& [stage, result] : results) {
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
