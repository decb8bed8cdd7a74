#include "evolution/report/individual_table.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evolution/genome/decoder.h"

namespace menger::evolution {

namespace {

/// Returns the latest fitness of all individuals that have one, by id.
std::map<std::uint64_t, double> latest_fitness(const RunArchive& archive, int last_generation) {
  std::map<std::uint64_t, double> latest;
  for (int generation = 0; generation <= last_generation; ++generation)
    for (const PoolMember& member : archive.pool(generation))
      if (member.fitness) latest[member.id] = *member.fitness;
  return latest;
}

std::vector<std::string> columns(const SearchPlan& plan) {
  std::vector<std::string> names{
      "individual", "generation", "parent", "age", "cells", "phenotype", "fitness_" + std::string(fitness_unit(plan.objective))};
  for (const int level : plan.levels())
    for (const char* what : {"status", "dx_m", "dy_m", "dz_m"}) names.push_back("level_" + std::to_string(level) + "_" + what);
  return names;
}

}  // namespace

io::CsvTable individual_table(const RunView& run) {
  io::CsvTable table(columns(run.plan));
  const int last_generation = run.archive->last_generation().value_or(-1);
  const std::map<std::uint64_t, double> fitness = latest_fitness(*run.archive, last_generation);
  for (std::uint64_t id = 0; id < run.archive->next_id(); ++id) {
    const Individual individual = run.archive->individual(id);
    if (individual.generation > last_generation) break;
    const auto fit = fitness.find(id);
    std::vector<io::CsvCell> row{io::cell(id),
                                 io::cell(individual.generation),
                                 individual.parent ? io::cell(*individual.parent) : io::CsvCell{},
                                 io::cell(individual.age),
                                 io::cell(std::uint64_t{individual.phenotype.body.count()}),
                                 io::cell(phenotype_key(individual.phenotype)),
                                 fit == fitness.end() ? io::CsvCell{} : io::cell(fit->second)};
    const KnownResults results = archived_results(run, as_simulated(run.plan, individual.phenotype));
    for (const int level : run.plan.levels()) {
      const std::optional<std::size_t> scenario = shown_scenario(run.plan, level, results);
      const auto found = scenario ? results.find({level, *scenario}) : results.end();
      if (found == results.end()) {
        row.resize(row.size() + 4);
        continue;
      }
      row.push_back(io::cell(io::to_string(found->second.status)));
      const auto& moved_m = found->second.displacement_m;
      for (std::size_t axis = 0; axis < 3; ++axis) row.push_back(moved_m ? io::cell(moved_m->at(axis)) : io::CsvCell{});
    }
    table.add_cells(row);
  }
  return table;
}

}  // namespace menger::evolution
