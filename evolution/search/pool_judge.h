#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/worker_pool.h"
#include "evolution/search/lazy_selection.h"
#include "evolution/search/search.h"
#include "evolution/search/search_judging.h"

namespace menger::evolution {

/// What evaluating costs and saves in one generation.
struct JudgeCounts {
  std::uint64_t evaluations = 0;
  std::uint64_t cached = 0;
  std::uint64_t pruned = 0;
};

/// Finds out about the fitness of the new individuals of one generation, as much as selection needs.
class PoolJudge {
 public:
  /// @param correction what turns scores into fitness; null: they are the fitness
  PoolJudge(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive, const SearchOptions& options,
            int generation, std::size_t* commits, const CorrectedFitness* correction = nullptr);

  /// Adds a survivor of the generation before, whose fitness is known, at its present age.
  void add_survivor(const Contender& survivor);

  /// Adds a new individual. @param duplicate whether an earlier individual has its phenotype
  void add_newcomer(const Individual& individual, bool duplicate);

  /// Evaluates everything. @return completed or stopped
  [[nodiscard]] io::RunStatus judge_in_full();

  /// Evaluates, level by level, what selection depends on. @return completed or stopped
  [[nodiscard]] io::RunStatus judge_lazily();

  /// The pool as selection takes it.
  [[nodiscard]] std::vector<Contestant> contestants() const;

  /// The pool as it is archived, in the order in which it was added; survivor ranks are left open.
  [[nodiscard]] std::vector<Contender> contenders() const;

  [[nodiscard]] JudgeCounts counts() const;

 private:
  struct Candidate {
    Contender contender;                 ///< knowledge `bounded` while undecided
    std::optional<Phenotype> phenotype;  ///< of new individuals, as it is simulated
    std::map<int, Evaluation> results;   ///< by level, as far as known
    [[nodiscard]] bool undecided() const { return contender.knowledge == Knowledge::bounded; }
  };
  using Request = std::pair<std::size_t, int>;  ///< position of a candidate, level

  [[nodiscard]] io::RunStatus evaluate(const std::vector<Request>& requests);
  [[nodiscard]] EvaluationKey key_of(const Candidate& candidate, int level) const;
  [[nodiscard]] std::optional<int> next_level(const Candidate& candidate) const;
  [[nodiscard]] std::vector<PartialContestant> partial_pool() const;
  void learn(Candidate& candidate, int level, const Evaluation& result);

  const SearchPlan* plan_;
  RunArchive* archive_;
  const SearchOptions* options_;
  std::string physics_hash_;
  int generation_;
  std::size_t* commits_;
  const CorrectedFitness* correction_;
  WorkerPool workers_;
  std::vector<Candidate> candidates_;
  std::map<EvaluationKey, Evaluation> results_;  ///< of this generation's requests
  std::uint64_t evaluations_ = 0;
  std::uint64_t cached_ = 0;
};

}  // namespace menger::evolution
