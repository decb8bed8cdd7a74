#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/genome/offspring.h"

namespace menger::evolution {

/// How a displacement at one level becomes that level's score. The fitness is the least score over the levels of the study.
enum class Objective {
  body_lengths,             ///< horizontal displacement over 3^level cell edges (the workspace, not the extent of the body in it)
  squared_metres_per_scale  ///< (dx² + dy²) / 3^level, with dx and dy in metres
};
std::string_view to_string(Objective objective);  ///< "body-lengths" or "squared-metres-per-scale"

/// What happens to a new individual that has the phenotype of an earlier one. One that screening left out is no earlier one.
enum class DuplicatePolicy {
  archived_result,  ///< it gets the known results and takes part in selection
  culled,           ///< it has no fitness
  redrawn  ///< it is varied, or drawn, until its phenotype is new; it gets the known results if OffspringOptions::largest_tries
           ///< do not suffice
};
std::string_view to_string(DuplicatePolicy policy);  ///< "archived-result", "culled" or "redrawn"

/// When survivors are selected.
enum class SelectionTime {
  generational,  ///< when all new individuals of a generation are evaluated
  steady_state   ///< whenever one is, see run_steady_search
};
std::string_view to_string(SelectionTime time);  ///< "generational" or "steady_state"

/// What screens new individuals.
enum class Screener {
  surrogate,  ///< a cheaper model
  half_walks  ///< the first half of the evaluation itself: those that pass go on from there
};

/// How a search is screened: which new individuals the evaluator evaluates, or evaluates to the end.
struct ScreeningPlan {
  Screener by = Screener::surrogate;
  double least_share = 0.2;   ///< share of new individuals that passes if both models rank alike, in (0, 1]
  double drawn_share = 0.15;  ///< share of the others that is drawn and evaluated all the same, in (0, 1]

  bool operator==(const ScreeningPlan&) const = default;
};

/// How often a search checks the effect of its time step on its best designs. Checks do not change the course of a search.
struct StepCheckPlan {
  int every = 25;           ///< generations from one check to the next, >= 1; the first is of generation 0
  std::size_t designs = 1;  ///< the best distinct survivors that are checked each time, >= 1

  bool operator==(const StepCheckPlan&) const = default;
};

/// An archive of elites: the fittest body of every niche survives, so that kinds of bodies are kept apart.
struct MapElitesPlan {
  std::size_t cells_per_niche = 3;  ///< how many numbers of cells share a niche, >= 1

  bool operator==(const MapElitesPlan&) const = default;
};

/// Everything that decides the course of a search besides the evaluator.
struct SearchPlan {
  std::uint64_t seed = 1;
  int generations = 325;  ///< after generation 0, >= 0
  int survivors = 15;     ///< N >= 1, also the number of individuals in generation 0
  /// Children per generation, >= 0. Their parents are the survivors in random order, from the first again if there are more
  /// children than survivors.
  int mutants = 15;
  int newcomers = 1;  ///< random individuals of age 0 per generation, >= 0

  /// With SelectionTime::steady_state there is at least one mutant or newcomer, one scenario, and no pruning, map_elites,
  /// screening or step_checks.
  SelectionTime selection_time = SelectionTime::generational;
  OffspringOptions offspring;
  double cell_edge_m = 0.01;  ///< > 0
  Objective objective = Objective::body_lengths;
  DuplicatePolicy duplicates = DuplicatePolicy::archived_result;

  /// Whether evaluations that cannot change the survivors are left out. The survivors are the same either way, whatever the other
  /// options are. See outlook(): its proof needs a bound of the fitness that further evaluations can only lower, which
  /// known_score gives. With several scenarios, walks of a robot so end once it can no longer survive.
  bool pruning = true;

  /// Whether bodies stand on the ground from the start, whatever layer they grew in (see standing). Then none gains displacement
  /// by a fall, and equal bodies in different layers are one body. Everything that depends on the place of a cell, such as the
  /// phase of a wave, refers to the standing body.
  bool stand = false;

  /// Number of scenarios in which each level is evaluated, >= 1, and the share of them, the worst ones, that do not count, in
  /// [0, 1): 0 scores a robot by its worst scenario. See known_score.
  std::size_t scenarios = 1;
  double quantile = 0.0;

  /// Survival by niches. None: by age and fitness.
  std::optional<MapElitesPlan> map_elites{};

  /// Screening of new individuals. None: all are evaluated.
  std::optional<ScreeningPlan> screening{};

  /// Checks of the time step on the best designs. None: no checks.
  std::optional<StepCheckPlan> step_checks{};

  bool operator==(const SearchPlan&) const = default;

  [[nodiscard]] const std::vector<int>& levels() const { return offspring.constraints.levels; }  ///< ascending, none twice

  /// The smallest level; the only one of a search on finite elements. There is at least one.
  [[nodiscard]] int first_level() const { return levels().front(); }

  /// Returns the number of scenarios that do not count: the whole part of quantile times scenarios, but never all.
  [[nodiscard]] std::size_t left_out_scenarios() const;
};

/// Returns the phenotype that is simulated: with plan.stand the standing one (see standing), otherwise `phenotype` itself.
Phenotype as_simulated(const SearchPlan& plan, const Phenotype& phenotype);

/// Returns the horizontal displacement in body lengths of the level.
double body_lengths(const std::array<double, 3>& displacement_m, int level, double cell_edge_m);

/// Returns the score at a level, in the unit of plan.objective.
double level_score(const SearchPlan& plan, const std::array<double, 3>& displacement_m, int level);

/// Returns the unit of the fitness as the ending of a key: "body_lengths" or "m2".
std::string_view fitness_unit(Objective objective);

}  // namespace menger::evolution
