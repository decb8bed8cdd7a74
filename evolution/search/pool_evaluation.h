#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/search/known_score.h"
#include "evolution/search/niches.h"
#include "evolution/search/search.h"

namespace menger::evolution {

/// Numbers of evaluations that one generation made and saved; see GenerationRecord.
struct EvaluationCounts {
  std::uint64_t evaluations = 0;
  std::uint64_t cached = 0;
  std::uint64_t pruned = 0;
};

/// Evaluates the new individuals of one generation, as far as selection needs it.
class PoolEvaluation {
 public:
  /// @param commits incremented with every result that is added to the archive
  PoolEvaluation(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive, const SearchOptions& options,
                 int generation, std::size_t* commits);

  /// Adds a survivor of the previous generation at its present age. Its fitness is known.
  void add_survivor(const PoolMember& survivor);

  /// Adds a new individual. @param duplicate whether an earlier individual has the same phenotype
  /// @param is_left_out whether a surrogate ranked it too low to be evaluated
  void add_newcomer(const Individual& individual, bool duplicate, bool is_left_out = false);

  /// Evaluates everything. @return completed or stopped
  [[nodiscard]] io::RunStatus evaluate_in_full();

  /// Evaluates, stage by stage, only what selection depends on (see Selection::outlook). @param selection knows all members
  /// @return completed or stopped
  [[nodiscard]] io::RunStatus evaluate_lazily(const Selection& selection);

  /// Returns the pool in the order in which its members were added. Survivor ranks are not set.
  [[nodiscard]] std::vector<PoolMember> pool() const;

  [[nodiscard]] EvaluationCounts counts() const;

 private:
  struct Entry {
    PoolMember member;                   ///< its knowledge is `bounded` while undecided
    std::optional<Phenotype> phenotype;  ///< of new individuals only: see as_simulated
    KnownResults results;
    [[nodiscard]] bool undecided() const { return member.knowledge == Knowledge::bounded; }
  };
  using Request = std::pair<std::size_t, EvaluationStage>;  ///< position of an entry, stage

  [[nodiscard]] io::RunStatus evaluate(const std::vector<Request>& requests);
  [[nodiscard]] EvaluationKey key_of(const Entry& entry, const EvaluationStage& stage) const;
  void learn(Entry& entry, const EvaluationStage& stage, const Evaluation& result);

  const SearchPlan* plan_;
  const DesignEvaluator* evaluator_;
  RunArchive* archive_;
  const SearchOptions* options_;
  std::vector<std::string> physics_hashes_;  ///< by scenario
  int generation_;
  std::size_t* commits_;
  std::vector<Entry> entries_;
  std::map<EvaluationKey, Evaluation> results_;  ///< of this generation's requests
  std::uint64_t evaluations_ = 0;
  std::uint64_t cached_ = 0;
};

}  // namespace menger::evolution
