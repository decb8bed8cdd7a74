#include "evolution/search/reference_rounds.h"

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

Discrepancy learnt_from(const Distinction& distinction, std::span<const ReferenceEvaluation> evaluations) {
  std::vector<ScorePair> evaluated;
  for (const ReferenceEvaluation& one : evaluations) {
    if (one.score) evaluated.push_back({robot_poses(body_of_form(one.form), distinction), one.surrogate, *one.score});
  }
  return Discrepancy(std::move(evaluated));
}

}  // namespace

CorrectedFitness::CorrectedFitness(const Distinction& distinction, std::span<const ReferenceEvaluation> evaluations)
    : distinction_(distinction), discrepancy_(learnt_from(distinction, evaluations)) {
  for (const ReferenceEvaluation& evaluation : evaluations) by_form_.emplace(evaluation.form, evaluation);
}

const ReferenceEvaluation* CorrectedFitness::reference_evaluation_of(const meshes::Polycube& body) const {
  const auto found = by_form_.find(robot_form(body, distinction_));
  return found == by_form_.end() ? nullptr : &found->second;
}

CorrectedScore CorrectedFitness::score(const meshes::Polycube& body, double surrogate) const {
  if (const ReferenceEvaluation* evaluation = reference_evaluation_of(body))
    return {evaluation->score ? Knowledge::evaluated : Knowledge::failed, evaluation->score};
  return {Knowledge::evaluated, discrepancy_.corrected(robot_poses(body, distinction_), surrogate)};
}

ReferenceRounds::ReferenceRounds(const SearchPlan& plan, ReferenceEvaluator& reference, RunArchive& archive)
    : plan_(&plan),
      reference_(&reference),
      archive_(&archive),
      evaluations_(archive.reference_evaluations()),
      fitness_(reference.distinction(), evaluations_) {}

bool ReferenceRounds::is_due(int generation) const { return generation > 0 && generation % plan_->reference->every == 0; }

std::optional<ReferenceRound> ReferenceRounds::evaluate(int generation, std::span<const Survivor> survivors,
                                                        const std::atomic<bool>* stop) {
  ReferenceRound round{.generation = generation, .evaluated = {}, .element_steps = 0, .is_exhausted = false, .is_made = false};
  // A round is added to the archive as a whole. One that is there already comes from an interrupted run.
  std::ranges::copy_if(evaluations_, std::back_inserter(round.evaluated),
                       [&](const ReferenceEvaluation& one) { return one.generation == generation; });
  const std::size_t count = affordable();
  round.is_exhausted = round.evaluated.empty() && count == 0;
  if (round.evaluated.empty() && count > 0) {
    const std::vector<const Survivor*> line = chosen(survivors, count);
    std::vector<meshes::Polycube> bodies;
    bodies.reserve(line.size());
    for (const Survivor* survivor : line) bodies.push_back(standing(survivor->individual.phenotype.body));
    if (!bodies.empty()) {
      const auto results = reference_->evaluate(bodies, stop);
      if (!results) return std::nullopt;
      for (std::size_t place = 0; place < line.size(); ++place)
        round.evaluated.push_back(evaluation(generation, place, *line[place], results->at(place)));
      archive_->add_reference_evaluations(round.evaluated);
      round.is_made = true;
      evaluations_.insert(evaluations_.end(), round.evaluated.begin(), round.evaluated.end());
      fitness_ = CorrectedFitness(reference_->distinction(), evaluations_);
    }
  }
  round.element_steps = element_steps_of(evaluations_);
  return round;
}

std::vector<const Survivor*> ReferenceRounds::chosen(std::span<const Survivor> survivors, std::size_t count) const {
  std::vector<const Survivor*> line;
  for (const Survivor& one : survivors)
    if (one.surrogate && one.member.fitness) line.push_back(&one);
  std::ranges::sort(line, [](const Survivor* a, const Survivor* b) { return is_fitter(a->member, b->member); });
  std::set<std::string> forms;
  std::erase_if(line, [&](const Survivor* one) {
    const meshes::Polycube body = standing(one->individual.phenotype.body);
    if (forms.size() >= count || fitness_.reference_evaluation_of(body) != nullptr || !reference_->obstacle(body).empty())
      return true;
    return !forms.insert(robot_form(body, reference_->distinction())).second;
  });
  return line;
}

std::size_t ReferenceRounds::affordable() const {
  const double left = plan_->reference->budget_element_steps - static_cast<double>(element_steps_of(evaluations_));
  if (left <= 0.0) return 0;
  std::uint64_t dearest = 0;
  for (const ReferenceEvaluation& one : evaluations_) dearest = std::max(dearest, one.element_steps);
  const auto most = static_cast<double>(plan_->reference->designs);
  if (dearest == 0) return plan_->reference->designs;
  return static_cast<std::size_t>(std::min(most, std::floor(left / static_cast<double>(dearest))));
}

ReferenceEvaluation ReferenceRounds::evaluation(int generation, std::size_t place, const Survivor& survivor,
                                                const ReferenceResult& result) const {
  const int level = plan_->levels().front();
  ReferenceEvaluation made{.generation = generation,
                           .place = place,
                           .individual = survivor.individual.id,
                           .form = robot_form(survivor.individual.phenotype.body, reference_->distinction()),
                           .surrogate = survivor.surrogate.value(),
                           .score = {},
                           .element_steps = result.element_steps,
                           .found = {.design_hash = design_hash(as_simulated(*plan_, survivor.individual.phenotype), level),
                                     .level = level,
                                     .protocol = reference_->protocol(),
                                     .variant = "reference",
                                     .duration_s = reference_->duration_s(),
                                     .result = result.result,
                                     .has_result = result.has_result}};
  if (auto moved_m = result.result.displacement_m) {
    for (double& part : *moved_m) part *= reference_->time_factor();
    made.score = level_score(*plan_, *moved_m, level);
  }
  return made;
}

std::uint64_t element_steps_of(std::span<const ReferenceEvaluation> evaluations) {
  std::uint64_t sum = 0;
  for (const ReferenceEvaluation& one : evaluations) sum += one.element_steps;
  return sum;
}

}  // namespace menger::evolution
