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

/// What becomes of a new individual whose phenotype an earlier individual had.
enum class DuplicatePolicy {
  archived_result,  ///< it takes the results that are known, and competes
  culled            ///< it has no fitness
};
std::string_view to_string(DuplicatePolicy policy);  ///< "archived-result" or "culled"

/// How a dearer judge takes part in a search. Budgets are counted in steps: an element-step is one finite element for one time
/// step, a voxel-step one voxel for one time step.
struct JudgingPlan {
  int every = 10;                     ///< generations from one judging to the next, >= 1; the first is before generation `every`
  std::size_t designs = 2;            ///< robots that are judged each time, >= 1
  double budget_element_steps = 0.0;  ///< that judging may take over the whole search, >= 0
  double voxel_steps_per_element_step = 2.6;  ///< what an element-step costs, > 0: joins both costs to one number

  /// Hash of what decides the judge's results beside the body (DesignJudge::protocol): names the judge in the archive.
  std::string protocol;

  bool operator==(const JudgingPlan&) const = default;
};

/// How often a search looks at what its time step does to its best designs. Checks change nothing in the course of a search.
struct StepCheckPlan {
  int every = 25;           ///< generations from one check to the next, >= 1; the first is of generation 0
  std::size_t designs = 1;  ///< the best distinct survivors that are checked each time, >= 1

  bool operator==(const StepCheckPlan&) const = default;
};

/// All that decides the course of a search beside the evaluator.
struct SearchPlan {
  std::uint64_t seed = 1;
  int generations = 325;  ///< after generation 0, >= 0
  int survivors = 15;     ///< N >= 1, also the number of individuals in generation 0
  int mutants = 15;   ///< children per generation, >= 0: the survivors in random order, from the first again if there are more
  int newcomers = 1;  ///< random individuals of age 0 per generation, >= 0
  OffspringOptions offspring;
  double cell_edge_m = 0.01;  ///< > 0
  Objective objective = Objective::body_lengths;
  DuplicatePolicy duplicates = DuplicatePolicy::archived_result;

  /// Whether an evaluation that cannot change who survives is left out. The survivors are the same either way, whatever the other
  /// options are: see outlook(), whose proof needs a fitness that is a minimum, as it is for both objectives.
  bool pruning = true;

  /// Whether bodies stand on the ground from the start, whatever layer they grew in (see standing), so that none gains by a fall
  /// and equal bodies in different layers are one. What has to do with where a cell is, such as the phase of a wave, is that of
  /// the body that stands.
  bool stand = false;

  /// A dearer judge that corrects the fitness on the way; none: the evaluator alone decides.
  std::optional<JudgingPlan> judging{};

  /// Checks of the time step on the best designs; none: no checks.
  std::optional<StepCheckPlan> step_checks{};

  bool operator==(const SearchPlan&) const = default;

  [[nodiscard]] const std::vector<int>& levels() const { return offspring.constraints.levels; }  ///< ascending, none twice
};

/// What of a phenotype is simulated: itself, or where plan.stand says so what stands of it.
Phenotype as_simulated(const SearchPlan& plan, const Phenotype& phenotype);

/// Horizontal displacement in body lengths of the level.
double body_lengths(const std::array<double, 3>& displacement_m, int level, double cell_edge_m);

/// The score of a level.
double level_score(const SearchPlan& plan, const std::array<double, 3>& displacement_m, int level);

/// Unit of the fitness as the end of a key: "body_lengths" or "m2".
std::string_view fitness_unit(Objective objective);

}  // namespace menger::evolution
