#include "evolution/search/known_score.h"

#include <algorithm>
#include <limits>

namespace menger::evolution {
namespace {

constexpr double score_of_failure = -std::numeric_limits<double>::infinity();

/// Returns the scores of a level in the scenarios that are known, by scenario.
std::vector<double> scores_of(const SearchPlan& plan, int level, const KnownResults& results) {
  std::vector<double> scores;
  for (std::size_t scenario = 0; scenario < plan.scenarios; ++scenario) {
    const auto found = results.find({level, scenario});
    if (found == results.end()) continue;
    const auto& moved_m = found->second.displacement_m;
    scores.push_back(moved_m ? level_score(plan, *moved_m, level) : score_of_failure);
  }
  return scores;
}

/// Returns the score that counts; nothing if any number of others may be smaller.
std::optional<double> counting_score(const SearchPlan& plan, std::vector<double> scores) {
  const std::size_t left_out = plan.left_out_scenarios();
  if (scores.size() <= left_out) return std::nullopt;
  const auto place = scores.begin() + static_cast<std::ptrdiff_t>(left_out);
  std::ranges::nth_element(scores, place);
  return *place;
}

}  // namespace

std::vector<EvaluationStage> stages(const SearchPlan& plan) {
  std::vector<EvaluationStage> all;
  for (const int level : plan.levels())
    for (std::size_t scenario = 0; scenario < plan.scenarios; ++scenario) all.push_back({level, scenario});
  return all;
}

std::optional<EvaluationStage> next_stage(const SearchPlan& plan, const KnownResults& results) {
  for (const EvaluationStage& stage : stages(plan)) {
    if (!results.contains(stage)) return stage;
  }
  return std::nullopt;
}

KnownScore known_score(const SearchPlan& plan, const KnownResults& results) {
  KnownScore known;
  for (const int level : plan.levels()) {
    const auto score = counting_score(plan, scores_of(plan, level, results));
    if (!score) continue;
    if (*score == score_of_failure) return {.is_failed = true};
    known.at_most = std::min(*score, known.at_most.value_or(*score));
  }
  return known;
}

std::optional<std::size_t> deciding_scenario(const SearchPlan& plan, int level, const KnownResults& results) {
  const std::vector<double> scores = scores_of(plan, level, results);
  if (scores.size() < plan.scenarios) return std::nullopt;
  const auto score = counting_score(plan, scores);
  if (!score || *score == score_of_failure) return std::nullopt;
  return static_cast<std::size_t>(std::ranges::find(scores, *score) - scores.begin());
}

}  // namespace menger::evolution
