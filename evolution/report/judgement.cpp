#include "evolution/report/judgement.h"

#include <algorithm>

#include "evolution/report/study_view.h"
#include "evolution/study/scenarios.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"

namespace menger::evolution {

std::vector<FitDesign> champions(const RunView& run) {
  std::vector<FitDesign> all;
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const auto champion = summarise_generation(run, generation).champion;
    if (!champion || !champion->fitness) continue;
    const Individual& individual = champion->individual;
    // A former champion may come back.
    if (std::ranges::find(all, individual.id, &FitDesign::individual) == all.end())
      all.push_back({.individual = individual.id, .phenotype = individual.phenotype, .fitness = *champion->fitness});
  }
  return all;
}

std::string unusable_judge(const Study& search, const Study& judge) {
  if (!uses_elements(judge)) return "evaluation.model: must be \"finite_elements\"";
  if (judge.search.levels() != search.search.levels()) {
    std::vector<std::string> levels;
    for (const int level : search.search.levels()) levels.push_back(std::to_string(level));
    return "body.levels: must be those of the archive, [" + io::joined(levels, ", ") + "]";
  }
  if (search.search.cell_edge_m != judge.search.cell_edge_m) {
    return "body.cell_edge_m = " + io::number_text(judge.search.cell_edge_m) + ": the cells of the archive have " +
           io::number_text(search.search.cell_edge_m);
  }
  return "";
}

io::CsvTable judgement_table(const Study& judge, std::span<const FitDesign> robots, const RunArchive& archive) {
  const int level = judge.search.first_level();
  const std::string unit(fitness_unit(judge.search.objective));
  io::CsvTable table({"rank", "individual", "generation", "design", "cells", "phenotype", "fitness_" + unit, "score_" + unit,
                      "scenario", "friction", "loss_factor", "status", "reason", "dx_m", "dy_m", "dz_m", "body_lengths"});
  const MadeWalks made(archive);
  const std::vector<std::string> protocols = evaluator_of(judge)->scenarios();
  std::vector<Scenario> scenarios = scenarios_of(judge);
  if (scenarios.empty())
    scenarios.push_back({judge.physics.materials[0].kinetic_friction, fem::stated_loss_factor(judge.silicone.silicone)});
  for (std::size_t n = 0; n < robots.size(); ++n) {
    const Phenotype simulated = as_simulated(judge.search, robots[n].phenotype);
    const std::string design = design_hash(simulated, level);
    const std::optional<KnownResults> results = made.in_scenarios(protocols, design, level);
    if (!results) continue;
    const KnownScore known = known_score(judge.search, *results);
    for (const auto& [stage, result] : *results) {
      const Scenario& scenario = scenarios.at(stage.scenario);
      const auto part = [&moved_m = result.displacement_m](std::size_t axis) {
        return moved_m ? std::optional(moved_m->at(axis)) : std::nullopt;
      };
      std::optional<double> lengths;
      if (result.displacement_m) lengths = body_lengths(*result.displacement_m, level, judge.search.cell_edge_m);
      table.add_row(std::uint64_t{n + 1}, robots[n].individual, archive.individual(robots[n].individual).generation, design,
                    std::uint64_t{simulated.body.count()}, phenotype_key(simulated), robots[n].fitness,
                    known.is_failed ? std::nullopt : known.at_most, std::uint64_t{stage.scenario + 1}, scenario.friction,
                    scenario.loss_factor, io::to_string(result.status), result.reason, part(0), part(1), part(2), lengths);
    }
  }
  return table;
}

}  // namespace menger::evolution
