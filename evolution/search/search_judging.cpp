#include "evolution/search/search_judging.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace menger::evolution {
namespace {

meshes::Polycube body_of_form(const std::string& form) {
  const int side = static_cast<int>(std::lround(std::cbrt(static_cast<double>(form.size()))));
  return meshes::Polycube::from_digits(side, side, side, form);
}

Discrepancy learnt_from(const Distinction& distinction, std::span<const Judgement> judgements) {
  std::vector<JudgedScore> judged;
  for (const Judgement& one : judgements) {
    if (one.score) judged.push_back({robot_poses(body_of_form(one.form), distinction), one.surrogate, *one.score});
  }
  return Discrepancy(std::move(judged));
}

/// Whether a is to be judged before b.
bool is_before(const Nominee& a, const Nominee& b) {
  if (a.fitness != b.fitness) return a.fitness > b.fitness;
  return a.age != b.age ? a.age < b.age : a.individual > b.individual;
}

}  // namespace

CorrectedFitness::CorrectedFitness(const Distinction& distinction, std::span<const Judgement> judgements)
    : distinction_(distinction), discrepancy_(learnt_from(distinction, judgements)) {
  for (const Judgement& judgement : judgements) by_form_.emplace(judgement.form, judgement);
}

const Judgement* CorrectedFitness::judgement_of(const meshes::Polycube& body) const {
  const auto found = by_form_.find(robot_form(body, distinction_));
  return found == by_form_.end() ? nullptr : &found->second;
}

CorrectedScore CorrectedFitness::score(const meshes::Polycube& body, double surrogate) const {
  if (const Judgement* judgement = judgement_of(body))
    return {judgement->score ? Knowledge::evaluated : Knowledge::failed, judgement->score};
  return {Knowledge::evaluated, discrepancy_.corrected(robot_poses(body, distinction_), surrogate)};
}

SearchJudging::SearchJudging(const SearchPlan& plan, DesignJudge& judge, RunArchive& archive)
    : plan_(&plan),
      judge_(&judge),
      archive_(&archive),
      judgements_(archive.judgements()),
      fitness_(judge.distinction(), judgements_) {}

bool SearchJudging::is_due(int generation) const { return generation > 0 && generation % plan_->judging->every == 0; }

std::optional<JudgingRound> SearchJudging::judge(int generation, std::span<const Nominee> nominees,
                                                 const std::atomic<bool>* stop) {
  JudgingRound round{.generation = generation, .judged = {}, .element_steps = 0, .is_exhausted = false, .is_made = false};
  // A round is added whole: one that is there is left from an interrupted run.
  std::ranges::copy_if(judgements_, std::back_inserter(round.judged),
                       [&](const Judgement& one) { return one.generation == generation; });
  const std::size_t count = affordable();
  round.is_exhausted = round.judged.empty() && count == 0;
  if (round.judged.empty() && count > 0) {
    const std::vector<Nominee> line = chosen(nominees, count);
    std::vector<meshes::Polycube> bodies;
    bodies.reserve(line.size());
    for (const Nominee& nominee : line) bodies.push_back(standing(nominee.phenotype->body));
    if (!bodies.empty()) {
      const auto results = judge_->judge(bodies, stop);
      if (!results) return std::nullopt;
      for (std::size_t place = 0; place < line.size(); ++place)
        round.judged.push_back(judgement(generation, place, line[place], results->at(place)));
      archive_->add_judgements(round.judged);
      round.is_made = true;
      judgements_.insert(judgements_.end(), round.judged.begin(), round.judged.end());
      fitness_ = CorrectedFitness(judge_->distinction(), judgements_);
    }
  }
  round.element_steps = element_steps_of(judgements_);
  return round;
}

std::vector<Nominee> SearchJudging::chosen(std::span<const Nominee> nominees, std::size_t count) const {
  std::vector<Nominee> line;
  std::ranges::copy_if(nominees, std::back_inserter(line), [](const Nominee& one) { return one.surrogate && one.fitness; });
  std::ranges::sort(line, is_before);
  std::set<std::string> forms;
  std::erase_if(line, [&](const Nominee& one) {
    const meshes::Polycube body = standing(one.phenotype->body);
    if (forms.size() >= count || fitness_.judgement_of(body) != nullptr || !judge_->obstacle(body).empty()) return true;
    return !forms.insert(robot_form(body, judge_->distinction())).second;
  });
  return line;
}

std::size_t SearchJudging::affordable() const {
  const double left = plan_->judging->budget_element_steps - static_cast<double>(element_steps_of(judgements_));
  if (left <= 0.0) return 0;
  std::uint64_t dearest = 0;
  for (const Judgement& one : judgements_) dearest = std::max(dearest, one.element_steps);
  const auto most = static_cast<double>(plan_->judging->designs);
  if (dearest == 0) return plan_->judging->designs;
  return static_cast<std::size_t>(std::min(most, std::floor(left / static_cast<double>(dearest))));
}

Judgement SearchJudging::judgement(int generation, std::size_t place, const Nominee& nominee, const JudgeResult& result) const {
  const int level = plan_->levels().front();
  Judgement made{.generation = generation,
                 .place = place,
                 .individual = nominee.individual,
                 .form = robot_form(nominee.phenotype->body, judge_->distinction()),
                 .surrogate = nominee.surrogate.value(),
                 .score = {},
                 .element_steps = result.element_steps,
                 .found = {.design_hash = design_hash(as_simulated(*plan_, *nominee.phenotype), level),
                           .level = level,
                           .protocol = judge_->protocol(),
                           .variant = "judge",
                           .duration_s = judge_->duration_s(),
                           .result = result.result,
                           .has_result = result.has_result}};
  if (auto moved_m = result.result.displacement_m) {
    for (double& part : *moved_m) part *= judge_->time_factor();
    made.score = level_score(*plan_, *moved_m, level);
  }
  return made;
}

std::uint64_t element_steps_of(std::span<const Judgement> judgements) {
  std::uint64_t sum = 0;
  for (const Judgement& one : judgements) sum += one.element_steps;
  return sum;
}

}  // namespace menger::evolution
