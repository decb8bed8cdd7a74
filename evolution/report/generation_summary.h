#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/search/known_score.h"
#include "evolution/search/search_plan.h"
#include "io/text/csv_table.h"

namespace menger::evolution {

/// A design of an archive and its results.
struct DesignSummary {
  Individual individual;
  int age = 0;                                ///< in the generation that the summary is of
  std::optional<double> fitness;              ///< in the unit of the objective
  std::map<int, double> body_lengths;         ///< displacement by level, of the evaluations that completed and decided
  std::size_t cells = 0;                      ///< of the basal body
  std::optional<double> hausdorff_dimension;  ///< of fractals

  /// Where it left the range of validity of the model that evaluated it: "level 1: ..." joined by "; ", empty if nowhere.
  std::string outside_validity;
};

/// The summary of a finished generation.
struct GenerationSummary {
  GenerationRecord record;
  /// The survivor of largest fitness (of equals the youngest, then the newest), if any has a fitness.
  std::optional<DesignSummary> champion;
  std::optional<double> mean_fitness;  ///< of the survivors that have one
  std::uint64_t outside_validity = 0;  ///< number of evaluations made for it that left the range of validity
};

/// Everything that tables are made from: an archive, the plan of its search and the physics of its evaluations.
struct RunView {
  const RunArchive* archive = nullptr;
  SearchPlan plan;
  std::string physics;                          ///< DesignEvaluator::physics()
  std::vector<std::string> scenario_physics{};  ///< DesignEvaluator::scenarios(); empty: one, of `physics`
  std::string screening_physics{};              ///< the same of the surrogate that screens new bodies; empty if none does
  std::string half_step_physics{};              ///< the same of the evaluator with half the time step
  std::size_t voxels_per_cell = 1;              ///< voxels of a whole cell, for costs
  bool has_elements = false;                    ///< whether finite elements evaluate the bodies instead of voxels
  bool is_per_period = false;                   ///< whether a displacement is that in one period of the drive

  /// Returns the hashes of the physics of all scenarios.
  [[nodiscard]] std::vector<std::string> physics_hashes() const;
};

/// Reads the results of a body from an archive. @param simulated see as_simulated
KnownResults archived_results(const RunView& run, const Phenotype& simulated);

/// Reads the results of a body from an archive; of a body whose walk went no further than its first half, which screened it,
/// those of that half.
KnownResults archived_results_or_half(const RunView& run, const Phenotype& simulated);

/// Returns the scenario whose result stands for a body at a level: the only one, or that which decided; none if none has.
std::optional<std::size_t> shown_scenario(const SearchPlan& plan, int level, const KnownResults& results);

/// Collects the results of an individual. @param member its entry in the pool of a generation
DesignSummary summarise_design(const RunView& run, const Individual& individual, const PoolMember& member);

/// Returns how many evaluations made for a generation left the range of validity of the model that decides who survives, in all
/// scenarios. Evaluations that only screened new bodies do not count.
std::uint64_t evaluations_outside_validity(const RunView& run, int generation);

GenerationSummary summarise_generation(const RunView& run, int generation);

/// Returns the individuals from a random one to this one, each the parent of the next.
std::vector<Individual> lineage(const RunArchive& archive, std::uint64_t id);

/// Makes a table with a row per finished generation: its champion, the mean fitness, and the numbers of evaluations that were
/// made and saved. The column `champion_outside_validity` says where the champion left the range of validity of the model that
/// evaluated it, `outside_validity` how many evaluations left it.
io::CsvTable generations_table(const RunView& run);

/// Makes a table with a row per ancestor of an individual, the eldest first. The individual itself comes last.
io::CsvTable lineage_table(const RunView& run, std::uint64_t id);

/// Returns a line for people: generation, fitness, displacements, dimension, costs. @param time e.g. the remaining time; may be
/// empty
std::string summary_line(const RunView& run, const GenerationSummary& summary, std::string_view time);

/// Returns the heading of the lines of summary_line.
std::string summary_header(const RunView& run);

/// Returns a line that says what the columns of these lines mean.
std::string summary_legend(const RunView& run);

}  // namespace menger::evolution
