#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "evolution/archive/run_archive.h"
#include "evolution/evaluation/evaluator.h"
#include "evolution/search/search_plan.h"

namespace menger::evolution {

struct SearchOptions;

/// The scores of one robot by the surrogate and by the evaluator of the search.
struct ScoredTwice {
  double surrogate = 0.0;
  double score = 0.0;
  /// 1 / the probability with which the robot came to have both scores: 1 - (1 - p1) (1 - p2) ... of those of its screenings
  double weight = 1.0;
};

/// Returns Spearman's rank correlation of weighted robots: that of a population in which every robot is there as often as its
/// weight says. Equal scores have the mean of their ranks. Nothing for fewer than two robots, or if one side is all equal.
std::optional<double> rank_correlation(std::span<const ScoredTwice> robots);

/// Returns the share of new individuals that passes a screening, in [least_share, 1]: 1 - (1 - least_share) r. Here r is the rank
/// correlation so far less its standard error (by Fisher's z, with (sum w)^2 / sum w^2 robots), or 0 if that is negative. So with
/// few robots or without correlation everything passes.
double passing_share(std::span<const ScoredTwice> robots, const ScreeningPlan& plan);

/// The screening of the new individuals of one generation.
struct ScreeningRound {
  int generation = 0;
  std::vector<ScreenedIndividual> individuals;  ///< by id
  std::optional<double> correlation{};          ///< rank correlation from which the share follows
  double share = 1.0;                           ///< of new individuals that pass

  [[nodiscard]] std::size_t count(Screened outcome) const;
};

/// Screens the new individuals of a search by a surrogate: those that it ranks best are evaluated, and a few drawn ones of the
/// others.
///
/// The surrogate may be the first half of the evaluation itself (Screener::half_walks). Its scores are of another time, so they
/// are compared with each other only, as those of any surrogate; survival compares scores of whole evaluations alone.
///
/// All decisions follow from the seed, the generation and the archive of earlier generations, and none from the order or time of
/// evaluations. The surrogate's results are evaluations of the archive with a physics of their own.
class Screening {
 public:
  /// @param plan has a screening and one level
  /// @param physics DesignEvaluator::physics() of the evaluator of the search: in its first scenario, in which all walk that pass
  Screening(const SearchPlan& plan, const DesignEvaluator& surrogate, const std::string& physics, RunArchive& archive);

  /// Evaluates new individuals by the surrogate and decides which pass. One whose result the archive has already passes, and so
  /// does one that a surrogate cannot evaluate; one without a score of half a walk does not. Equal designs have one place, and
  /// one outcome.
  /// @param born those that the search would evaluate without a screening
  /// @param commits incremented with every result that is added to the archive
  /// @return nothing if it was stopped
  [[nodiscard]] std::optional<ScreeningRound> screen(int generation, std::span<const Individual* const> born,
                                                     const SearchOptions& options, std::size_t* commits);

 private:
  [[nodiscard]] bool evaluate(int generation, std::span<const Individual* const> born, const SearchOptions& options,
                              std::size_t* commits);
  void learn(int generation);

  const SearchPlan* plan_;
  const DesignEvaluator* surrogate_;
  RunArchive* archive_;
  std::string surrogate_hash_;
  std::string physics_hash_;
  int learnt_ = 0;                   ///< generations whose screenings are in the following
  std::vector<ScoredTwice> robots_;  ///< distinct designs
  std::set<std::string> known_;      ///< their hashes
  /// For each design that was only left out: the probability of that.
  std::map<std::string, double> left_out_;
};

/// Returns a round as a line for people.
std::string screening_text(const ScreeningRound& round, const ScreeningPlan& plan);

}  // namespace menger::evolution
