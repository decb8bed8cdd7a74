#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/search/search_plan.h"
#include "evolution/search/survivor.h"

namespace menger::evolution {

struct SearchOptions;

/// One of the fittest survivors of a generation.
struct Elite {
  std::uint64_t individual = 0;
  double fitness = 0.0;
  Phenotype simulated;  ///< see as_simulated
};

/// Returns the at most `count` survivors of largest fitness; of equals the youngest, then the newest. Each simulated body is
/// there once.
std::vector<Elite> elites(const SearchPlan& plan, std::span<const Survivor> survivors, std::size_t count);

/// Two results of the same body: with the time step of the search, and with half of it.
struct CheckedLevel {
  int level = 1;
  Evaluation whole;
  Evaluation half;

  /// Returns the distance between the two displacements, in m. It exists if both evaluations completed.
  [[nodiscard]] std::optional<double> distance_m() const;
};

/// An elite and the checks of its time step, by level.
struct CheckedDesign {
  Elite elite;
  std::vector<CheckedLevel> levels;
};

/// Returns the least score over the levels with half the time step; none if a level did not complete. Compare it with
/// whole_step_score.
std::optional<double> half_step_score(const SearchPlan& plan, const CheckedDesign& design);

/// Returns the least score over the levels with the time step of the search; none if a level did not complete.
std::optional<double> whole_step_score(const SearchPlan& plan, const CheckedDesign& design);

/// Evaluates the elites of a search again with half the time step.
class StepChecking {
 public:
  /// @param plan has step_checks
  /// @param half the evaluator of the search with half its time step; outlives this object
  StepChecking(const SearchPlan& plan, const DesignEvaluator& half, RunArchive& archive);

  /// Returns whether a generation is to be checked.
  [[nodiscard]] bool is_due(int generation) const;

  /// Evaluates the elites of a generation at all levels with half the time step, and adds the results to the archive. Results
  /// that the archive already has are not made again.
  /// @param commits incremented with every result that is added
  /// @return false if it was stopped
  [[nodiscard]] bool check(int generation, std::span<const Survivor> survivors, const SearchOptions& options,
                           std::size_t* commits);

 private:
  const SearchPlan* plan_;
  const DesignEvaluator* half_;
  RunArchive* archive_;
  std::string physics_hash_;
};

/// Reads from an archive the elites of a finished generation with their checks, as far as they were made.
/// @param physics, half_physics DesignEvaluator::physics() of the evaluator of the search and of that with half its time step
std::vector<CheckedDesign> checked_designs(const SearchPlan& plan, const RunArchive& archive, int generation,
                                           const std::string& physics, const std::string& half_physics);

}  // namespace menger::evolution
