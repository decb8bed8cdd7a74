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

namespace menger::evolution {

struct SearchOptions;

/// One of the best survivors of a generation.
struct Elite {
  std::uint64_t individual = 0;
  double fitness = 0.0;
  Phenotype simulated;  ///< see as_simulated
};

/// A survivor with what it stands for.
struct RankedSurvivor {
  Contender contender;
  const Phenotype* phenotype = nullptr;
};

/// The survivors of largest fitness, of equals the youngest, then the newest; each simulated body once, at most `count`.
std::vector<Elite> elites(const SearchPlan& plan, std::span<const RankedSurvivor> survivors, std::size_t count);

/// A result of the search beside that of the same body with half the time step.
struct CheckedLevel {
  int level = 1;
  Evaluation whole;
  Evaluation half;

  /// Between both displacements, m; exists when both completed.
  [[nodiscard]] std::optional<double> distance_m() const;
};

/// What half the step makes of an elite.
struct CheckedDesign {
  Elite elite;
  std::vector<CheckedLevel> levels;
};

/// The least score over the levels with half the step, to be compared with that of the search before any correction; none if a
/// level did not complete.
std::optional<double> half_step_score(const SearchPlan& plan, const CheckedDesign& design);
std::optional<double> whole_step_score(const SearchPlan& plan, const CheckedDesign& design);

/// The part of a search that evaluates its elites again with half the time step.
class StepChecking {
 public:
  /// @param plan with step_checks @param half like the evaluator of the search but for half its time step; outlives this
  StepChecking(const SearchPlan& plan, const DesignEvaluator& half, RunArchive& archive);

  /// Whether a generation is to be checked.
  [[nodiscard]] bool is_due(int generation) const;

  /// Evaluates the elites of a generation at all levels, those that the archive does not hold yet, and adds them to it.
  /// @param commits counts the additions @return false if it was stopped
  [[nodiscard]] bool check(int generation, std::span<const RankedSurvivor> survivors, const SearchOptions& options,
                           std::size_t* commits);

 private:
  const SearchPlan* plan_;
  const DesignEvaluator* half_;
  RunArchive* archive_;
  std::string physics_hash_;
};

/// The elites of a finished generation with what an archive holds of their checks.
/// @param physics, half_physics DesignEvaluator::physics() of both evaluators
std::vector<CheckedDesign> checked_designs(const SearchPlan& plan, const RunArchive& archive, int generation,
                                           const std::string& physics, const std::string& half_physics);

}  // namespace menger::evolution
