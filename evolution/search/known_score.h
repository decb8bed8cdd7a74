#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/search/search_plan.h"

namespace menger::evolution {

/// One of the evaluations that make the score of a robot.
struct EvaluationStage {
  int level = 1;
  std::size_t scenario = 0;

  auto operator<=>(const EvaluationStage&) const = default;  // NOLINT(modernize-use-nullptr): taken for a comparison with 0
};

/// The results of a robot that are known.
using KnownResults = std::map<EvaluationStage, Evaluation>;

/// Returns all stages of a search, in the order in which they are evaluated: level by level, and in the scenarios of each.
std::vector<EvaluationStage> stages(const SearchPlan& plan);

/// Returns the first stage without a result; nothing if all have one.
std::optional<EvaluationStage> next_stage(const SearchPlan& plan, const KnownResults& results);

/// What is known of the score of a robot.
struct KnownScore {
  bool is_failed = false;           ///< it has no fitness, whatever the other results are
  std::optional<double> at_most{};  ///< further results can only lower it; with all results, the score; none: not known
};

/// Returns what results tell of a score. The score of a level is the k + 1-th smallest of its scenarios, where k is the number of
/// scenarios that do not count (SearchPlan::left_out_scenarios). That of a robot is the smallest of its levels. An evaluation
/// without a displacement is smaller than any; if it decides, the robot has failed.
KnownScore known_score(const SearchPlan& plan, const KnownResults& results);

/// Returns the scenario whose score is that of a level, the first of equals; nothing unless all scenarios are known and the one
/// that decides has a displacement.
std::optional<std::size_t> deciding_scenario(const SearchPlan& plan, int level, const KnownResults& results);

}  // namespace menger::evolution
