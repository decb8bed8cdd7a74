#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/genome/robot_form.h"
#include "evolution/search/search_plan.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A design of an archive with what is known of it.
struct DesignSummary {
  Individual individual;
  int age = 0;                                ///< in the generation that the summary is of
  std::optional<double> fitness;              ///< in the unit of the objective
  std::optional<double> surrogate_fitness;    ///< with a judge: by the evaluator alone
  std::optional<double> judged_fitness;       ///< by the judge, if it judged this robot
  std::map<int, double> body_lengths;         ///< displacement by level, of the evaluations that completed
  std::size_t cells = 0;                      ///< of the basal body
  std::optional<double> hausdorff_dimension;  ///< of fractals

  /// Where it left the range of validity of the model that judged it, "level 1: ..." joined by "; "; empty: nowhere.
  std::string outside_validity;
};

/// A finished generation at a glance.
struct GenerationSummary {
  GenerationRecord record;
  std::optional<DesignSummary>
      champion;  ///< the survivor of largest fitness (of equals the youngest, then the newest), if any has one
  std::optional<double> mean_fitness;  ///< of the survivors that have one
  std::uint64_t outside_validity = 0;  ///< evaluations made for it that left the range of validity
};

/// An archive, the plan of its search and the physics of its evaluations: what tables are made of.
struct RunView {
  const RunArchive* archive = nullptr;
  SearchPlan plan;
  std::string physics;              ///< DesignEvaluator::physics()
  std::string half_step_physics{};  ///< the same of the evaluator with half the time step
  Distinction distinction{};        ///< between robots, where a judge took part
  std::size_t voxels_per_cell = 1;  ///< in a whole cell, for costs
};

DesignSummary summarise_design(const RunView& run, const Individual& individual, const Contender& contender);
GenerationSummary summarise_generation(const RunView& run, int generation);

/// The individuals from a random one to this one, each the parent of the next.
std::vector<Individual> lineage(const RunArchive& archive, std::uint64_t id);

/// A row per finished generation: its champion (where a judge took part by the corrected fitness, with its score by the evaluator
/// and, if it was judged, by the judge), the mean fitness, what evaluating cost and saved, and
/// where the champion (champion_outside_validity) and how many evaluations (outside_validity) left the range of validity of the
/// model that judged them.
io::CsvTable generations_table(const RunView& run);

/// A row per ancestor of an individual, the eldest first, the individual itself last.
io::CsvTable lineage_table(const RunView& run, std::uint64_t id);

/// A line for people: generation, fitness, displacements, dimension, costs. @param time e.g. what remains; may be empty
std::string summary_line(const RunView& run, const GenerationSummary& summary, std::string_view time);

/// The line above such lines.
std::string summary_header(const RunView& run);

}  // namespace menger::evolution
