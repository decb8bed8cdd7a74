#include "evolution/report/generation_summary.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "io/text/content_hash.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "meshes/design/fractal.h"

namespace menger::evolution {

namespace {

std::string level_column(int level) { return "level_" + std::to_string(level) + "_displacement_body_lengths"; }

std::string number_or_dash(const std::optional<double>& value, const char* format) {
  return value ? io::formatted(format, *value) : "-";
}

std::optional<double> displacement(const DesignSummary& design, int level) {
  const auto found = design.body_lengths.find(level);
  return found == design.body_lengths.end() ? std::nullopt : std::optional(found->second);
}

void add_displacements(std::vector<io::CsvCell>& row, const RunView& run, const DesignSummary& design) {
  for (const int level : run.plan.levels()) row.push_back(io::cell(displacement(design, level)));
}

io::CsvCell count_cell(std::uint64_t count) { return io::cell(count); }

}  // namespace

std::vector<std::string> RunView::physics_hashes() const {
  std::vector<std::string> hashes;
  for (const std::string& text : scenario_physics) hashes.push_back(io::content_hash(text));
  if (hashes.empty()) hashes.push_back(io::content_hash(physics));
  return hashes;
}

KnownResults archived_results(const RunView& run, const Phenotype& simulated) {
  KnownResults results;
  const std::vector<std::string> hashes = run.physics_hashes();
  for (const EvaluationStage& stage : stages(run.plan)) {
    const auto found = run.archive->evaluation({design_hash(simulated, stage.level), stage.level, hashes.at(stage.scenario)});
    if (found) results.emplace(stage, found->result);
  }
  return results;
}

KnownResults archived_results_or_half(const RunView& run, const Phenotype& simulated) {
  KnownResults results = archived_results(run, simulated);
  if (!results.empty() || !run.plan.screening || run.plan.screening->by != Screener::half_walks) return results;
  const int level = run.plan.first_level();
  const auto half = run.archive->evaluation({design_hash(simulated, level), level, io::content_hash(run.screening_physics)});
  if (half) results.emplace(EvaluationStage{level, 0}, half->result);
  return results;
}

std::optional<std::size_t> shown_scenario(const SearchPlan& plan, int level, const KnownResults& results) {
  return plan.scenarios == 1 ? std::optional<std::size_t>(0) : deciding_scenario(plan, level, results);
}

DesignSummary summarise_design(const RunView& run, const Individual& individual, const PoolMember& member) {
  DesignSummary summary{.individual = individual,
                        .age = member.age,
                        .fitness = member.fitness,
                        .body_lengths = {},
                        .cells = individual.phenotype.body.count(),
                        .hausdorff_dimension = {},
                        .outside_validity = {}};
  const KnownResults results = archived_results(run, as_simulated(run.plan, individual.phenotype));
  for (const int level : run.plan.levels()) {
    const std::optional<std::size_t> scenario = shown_scenario(run.plan, level, results);
    if (!scenario) continue;
    const auto found = results.find({level, *scenario});
    if (found == results.end()) continue;
    if (const std::string& outside = found->second.outside_validity; !outside.empty()) {
      std::string& all = summary.outside_validity;
      all.append(all.empty() ? "level " : "; level ").append(std::to_string(level)).append(": ").append(outside);
    }
    if (!found->second.displacement_m) continue;
    summary.body_lengths[level] = body_lengths(*found->second.displacement_m, level, run.plan.cell_edge_m);
  }
  if (!individual.phenotype.has_arrangements())
    summary.hausdorff_dimension = meshes::hausdorff_dimension(individual.phenotype.body);
  return summary;
}

std::uint64_t evaluations_outside_validity(const RunView& run, int generation) {
  std::uint64_t outside = 0;
  for (const std::string& physics_hash : run.physics_hashes())
    outside += run.archive->evaluations_outside_validity(generation, physics_hash);
  return outside;
}

GenerationSummary summarise_generation(const RunView& run, int generation) {
  GenerationSummary summary{.record = run.archive->generation(generation),
                            .champion = {},
                            .mean_fitness = {},
                            .outside_validity = evaluations_outside_validity(run, generation)};
  std::optional<PoolMember> best;
  double sum = 0.0;
  std::size_t count = 0;
  for (const PoolMember& member : run.archive->pool(generation)) {
    if (!member.survivor_rank || !member.fitness) continue;
    sum += *member.fitness;
    ++count;
    if (!best || is_fitter(member, *best)) best = member;
  }
  if (!best) return summary;
  summary.champion = summarise_design(run, run.archive->individual(best->id), *best);
  summary.mean_fitness = sum / static_cast<double>(count);
  return summary;
}

std::vector<Individual> lineage(const RunArchive& archive, std::uint64_t id) {
  std::vector<Individual> ancestors{archive.individual(id)};
  while (ancestors.back().parent) ancestors.push_back(archive.individual(*ancestors.back().parent));
  std::ranges::reverse(ancestors);
  return ancestors;
}

io::CsvTable generations_table(const RunView& run) {
  const std::string unit(fitness_unit(run.plan.objective));
  std::vector<std::string> columns{"generation",   "best_fitness_" + unit, "champion",
                                   "champion_age", "champion_cells",       "hausdorff_dimension"};
  for (const int level : run.plan.levels()) columns.push_back(level_column(level));
  for (const std::string& column :
       {"mean_fitness_" + unit, std::string("evaluations"), std::string("cached"), std::string("pruned"),
        std::string("outside_validity"), std::string("champion_outside_validity")}) {
    columns.push_back(column);
  }
  io::CsvTable table(columns);
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const GenerationSummary summary = summarise_generation(run, generation);
    std::vector<io::CsvCell> row{io::cell(generation)};
    if (const auto& champion = summary.champion) {
      row.insert(row.end(), {io::cell(champion->fitness), count_cell(champion->individual.id), io::cell(champion->age),
                             count_cell(champion->cells), io::cell(champion->hausdorff_dimension)});
      add_displacements(row, run, *champion);
    } else {
      row.resize(row.size() + 5 + run.plan.levels().size());
    }
    const GenerationRecord& record = summary.record;
    row.insert(row.end(), {io::cell(summary.mean_fitness), count_cell(record.evaluations), count_cell(record.cached),
                           count_cell(record.pruned), count_cell(summary.outside_validity),
                           summary.champion ? io::cell(summary.champion->outside_validity) : io::CsvCell{}});
    table.add_cells(row);
  }
  return table;
}

io::CsvTable lineage_table(const RunView& run, std::uint64_t id) {
  std::vector<std::string> columns{
      "generation", "individual",         "parent", "age_at_birth", "fitness_" + std::string(fitness_unit(run.plan.objective)),
      "cells",      "hausdorff_dimension"};
  for (const int level : run.plan.levels()) columns.push_back(level_column(level));
  columns.emplace_back("outside_validity");
  columns.emplace_back("phenotype");
  io::CsvTable table(columns);
  for (const Individual& individual : lineage(*run.archive, id)) {
    const std::vector<PoolMember> pool = run.archive->pool(individual.generation);
    const auto member = std::ranges::find(pool, individual.id, &PoolMember::id);
    if (member == pool.end()) {
      throw io::InputError(run.archive->file().string() + ": is damaged: individual " + std::to_string(individual.id) +
                           " took no part in generation " + std::to_string(individual.generation));
    }
    const DesignSummary design = summarise_design(run, individual, *member);
    std::vector<io::CsvCell> row{io::cell(individual.generation), count_cell(individual.id)};
    row.push_back(individual.parent ? count_cell(*individual.parent) : io::CsvCell{});
    row.insert(row.end(), {io::cell(individual.age), io::cell(design.fitness), count_cell(design.cells),
                           io::cell(design.hausdorff_dimension)});
    add_displacements(row, run, design);
    row.push_back(io::cell(design.outside_validity));
    row.push_back(io::cell(phenotype_key(individual.phenotype)));
    table.add_cells(row);
  }
  return table;
}

std::string summary_legend(const RunView& run) {
  const std::vector<int> levels = run.plan.levels();
  const bool has_one = levels.size() == 1;
  std::string displacements;
  for (const int level : levels) displacements.append(displacements.empty() ? "d" : ", d").append(std::to_string(level));
  std::string units = "BL body lengths";
  if (run.plan.objective != Objective::body_lengths) units += ", m2 squared displacement over the cells per side";
  if (run.is_per_period) units += ", T a period of the drive";
  return "gen: generation; F: fitness of the fittest survivor; " + displacements + ": its displacement at " +
         (has_one ? "this level" : "these levels") + " (" + units +
         "); H: its Hausdorff dimension; age: generations since its first ancestor was drawn at random; mean F: of all "
         "survivors; evals, cached, pruned: evaluations made, known before, not needed; time: of the generation, and what is "
         "left";
}

std::string summary_header(const RunView& run) {
  const std::string per_period = run.is_per_period ? "/T]" : "]";
  std::ostringstream line;
  line << std::setw(4) << "gen" << std::setw(12)
       << (run.plan.objective == Objective::body_lengths ? "F [BL" : "F [m2") + per_period;
  for (const int level : run.plan.levels()) line << std::setw(12) << "d" + std::to_string(level) + " [BL" + per_period;
  line << std::setw(7) << "H" << std::setw(5) << "age" << std::setw(11) << "mean F";
  for (const char* count : {"evals", "cached", "pruned"}) line << std::setw(7) << count;
  line << "  time";
  return line.str();
}

std::string summary_line(const RunView& run, const GenerationSummary& summary, std::string_view time) {
  const GenerationRecord& record = summary.record;
  const auto& champion = summary.champion;
  std::ostringstream line;
  line << std::setw(4) << record.number << std::setw(12) << number_or_dash(champion ? champion->fitness : std::nullopt, "%.5g");
  for (const int level : run.plan.levels()) {
    line << std::setw(12) << number_or_dash(champion ? displacement(*champion, level) : std::nullopt, "%.4f");
  }
  line << std::setw(7) << number_or_dash(champion ? champion->hausdorff_dimension : std::nullopt, "%.3f");
  line << std::setw(5) << (champion ? std::to_string(champion->age) : "-");
  line << std::setw(11) << number_or_dash(summary.mean_fitness, "%.4g");
  for (const std::uint64_t count : {record.evaluations, record.cached, record.pruned}) line << std::setw(7) << count;
  line << "  " << time;
  return line.str();
}

}  // namespace menger::evolution
