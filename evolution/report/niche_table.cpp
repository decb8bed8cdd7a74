#include "evolution/report/niche_table.h"

#include <string>

#include "evolution/search/niches.h"

namespace menger::evolution {

io::CsvTable niche_table(const RunView& run) {
  io::CsvTable table({"fewest_cells", "feet", "layers", "individual", "cells",
                      "fitness_" + std::string(fitness_unit(run.plan.objective)), "phenotype"});
  for (const PoolMember& member : run.archive->survivors(run.archive->last_generation().value())) {
    const Phenotype phenotype = run.archive->individual(member.id).phenotype;
    const Niche niche = niche_of(run.plan.map_elites.value(), phenotype.body);
    table.add_row(std::uint64_t{niche.fewest_cells}, std::uint64_t{niche.feet}, niche.layers, member.id,
                  std::uint64_t{phenotype.body.count()}, member.fitness, phenotype_key(phenotype));
  }
  return table;
}

}  // namespace menger::evolution
