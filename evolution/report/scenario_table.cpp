#include "evolution/report/scenario_table.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evolution/study/scenarios.h"

namespace menger::evolution {

io::CsvTable scenario_table(const RunView& run, const Study& study) {
  const int level = run.plan.first_level();
  io::CsvTable table({"individual", "fitness_" + std::string(fitness_unit(run.plan.objective)), "scenario", "friction",
                      "loss_factor", "decides", "status", "reason", "dx_m", "dy_m", "dz_m", "body_lengths", "steps"});
  std::vector<PoolMember> survivors = run.archive->survivors(run.archive->last_generation().value());
  std::ranges::sort(survivors, is_fitter);
  const std::vector<Scenario> scenarios = scenarios_of(study);
  for (const PoolMember& member : survivors) {
    const KnownResults results = archived_results(run, as_simulated(run.plan, run.archive->individual(member.id).phenotype));
    const std::optional<std::size_t> decides = deciding_scenario(run.plan, level, results);
    for (std::size_t n = 0; n < scenarios.size(); ++n) {
      const auto found = results.find({level, n});
      if (found == results.end()) continue;
      const Evaluation& result = found->second;
      const auto part = [&](std::size_t axis) {
        return result.displacement_m ? std::optional(result.displacement_m->at(axis)) : std::nullopt;
      };
      std::optional<double> lengths;
      if (result.displacement_m) lengths = body_lengths(*result.displacement_m, level, run.plan.cell_edge_m);
      table.add_row(member.id, member.fitness, std::uint64_t{n + 1}, scenarios[n].friction, scenarios[n].loss_factor,
                    decides == n ? 1 : 0, io::to_string(result.status), result.reason, part(0), part(1), part(2), lengths,
                    result.steps);
    }
  }
  return table;
}

}  // namespace menger::evolution
