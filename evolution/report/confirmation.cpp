#include "evolution/report/confirmation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "evolution/report/study_view.h"
#include "io/text/formatted.h"

namespace menger::evolution {

namespace {

constexpr int level_on_elements = 1;  ///< of all bodies on finite elements

std::unique_ptr<DesignEvaluator> evaluator_on(const Study& study, fem::Fidelity fidelity) {
  Study finer = study;
  finer.silicone.elements.fidelity = fidelity;
  return evaluator_of(finer);
}

std::optional<double> largest_angle_deg(const KnownResults& search, const KnownResults& finer) {
  std::optional<double> largest;
  for (const auto& [stage, result] : finer) {
    const auto before = search.find(stage);
    if (before == search.end() || !before->second.displacement_m || !result.displacement_m) continue;
    const auto& a = *before->second.displacement_m;
    const auto& b = *result.displacement_m;
    const double angle = std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
    largest = std::max(largest.value_or(0.0), 180.0 / std::numbers::pi * angle);
  }
  return largest;
}

}  // namespace

io::RunStatus confirm(const Study& study, RunArchive& archive, const WalksAgainOptions& options) {
  std::vector<WalksAgain> asked;
  for (const fem::Fidelity fidelity : finer_fidelities(study)) {
    asked.push_back({.study = study, .variant = "confirmed on " + std::string(to_string(fidelity)) + " elements"});
    asked.back().study.silicone.elements.fidelity = fidelity;
  }
  return walk_again(asked, different_robots(study, archive, study.confirm), archive, options);
}

std::vector<std::unique_ptr<DesignEvaluator>> confirmation_evaluators_of(const Study& study) {
  std::vector<std::unique_ptr<DesignEvaluator>> all;
  if (study.confirm == 0) return all;
  for (const fem::Fidelity fidelity : finer_fidelities(study)) {
    Study finer = study;
    finer.silicone.elements.fidelity = fidelity;
    for (std::unique_ptr<DesignEvaluator>& scenario : scenario_evaluators_of(finer)) all.push_back(std::move(scenario));
  }
  return all;
}

std::vector<Confirmation> confirmations(const Study& study, const RunArchive& archive) {
  const MadeWalks made(archive);
  std::vector<Confirmation> all;
  if (made.count() == 0) return all;
  const RunView run = view_of(archive, study);
  std::vector<std::pair<fem::Fidelity, std::vector<std::string>>> protocols;
  for (const fem::Fidelity fidelity : finer_fidelities(study))
    protocols.emplace_back(fidelity, evaluator_on(study, fidelity)->scenarios());
  const std::vector<FitDesign> robots = different_robots(study, archive, made.count());
  for (std::size_t n = 0; n < robots.size(); ++n) {
    const Phenotype simulated = as_simulated(study.search, robots[n].phenotype);
    const std::string design = design_hash(simulated, level_on_elements);
    std::vector<std::pair<fem::Fidelity, KnownResults>> walks;
    for (const auto& [fidelity, texts] : protocols)
      if (auto results = made.in_scenarios(texts, design)) walks.emplace_back(fidelity, *std::move(results));
    // A robot that has walked on some of the elements only, as another study asked, is not confirmed.
    if (walks.size() < protocols.size()) continue;
    const KnownResults search = archived_results(run, simulated);
    for (const auto& [fidelity, results] : walks) {
      const KnownScore score = known_score(study.search, results);
      Confirmation one{.rank = n + 1, .design = robots[n], .fidelity = fidelity};
      if (!score.is_failed) one.score = score.at_most;
      if (score.is_failed) one.reason = first_reason(results);
      one.angle_deg = largest_angle_deg(search, results);
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::optional<Confirmation> best_confirmed(const Study& study, const std::vector<Confirmation>& confirmed) {
  const std::vector<fem::Fidelity> fidelities = finer_fidelities(study);
  std::optional<Confirmation> best;
  std::size_t robot = 0;
  std::size_t walked = 0;  // of the fidelities of this robot
  for (const Confirmation& one : confirmed) {
    if (one.rank != robot) walked = 0;
    robot = one.rank;
    if (one.score) ++walked;
    if (one.fidelity == fidelities.back() && walked == fidelities.size() && (!best || *one.score > *best->score)) best = one;
  }
  return best;
}

std::optional<Champion> champion_of(const RunView& run, const Study& study, int generation,
                                    const std::vector<Confirmation>& confirmed) {
  std::optional<DesignSummary> fittest = summarise_generation(run, generation).champion;
  if (!fittest) return std::nullopt;
  if (confirmed.empty()) return Champion{std::move(*fittest)};
  const std::optional<Confirmation> best = best_confirmed(study, confirmed);
  if (!best) {
    return Champion{std::move(*fittest),
                    "no robot that was confirmed walks on all finer elements: the champion is the best of the search"};
  }
  if (best->design.phenotype == fittest->individual.phenotype) return Champion{std::move(*fittest)};
  const std::vector<PoolMember> pool = run.archive->pool(generation);
  const auto member = std::ranges::find(pool, best->design.individual, &PoolMember::id);
  const PoolMember gone{.id = best->design.individual, .fitness = best->design.fitness};
  return Champion{
      summarise_design(run, run.archive->individual(best->design.individual), member == pool.end() ? gone : *member),
      "the champion is the best robot on the finest elements, number " + std::to_string(best->rank) + " of the search"};
}

io::CsvTable confirmation_table(const Study& study, const std::vector<Confirmation>& confirmed) {
  const std::string unit(fitness_unit(study.search.objective));
  io::CsvTable table(
      {"rank", "individual", "design", "cells", "fitness_" + unit, "fidelity", "score_" + unit, "ratio", "angle_deg", "reason"});
  for (const Confirmation& one : confirmed) {
    const Phenotype simulated = as_simulated(study.search, one.design.phenotype);
    std::optional<double> ratio;
    if (one.score && one.design.fitness > 0.0) ratio = *one.score / one.design.fitness;
    table.add_row(std::uint64_t{one.rank}, one.design.individual, design_hash(simulated, level_on_elements),
                  std::uint64_t{simulated.body.count()}, one.design.fitness, to_string(one.fidelity), one.score, ratio,
                  one.angle_deg, one.reason);
  }
  return table;
}

std::string confirmation_text(const Study& study, const std::vector<Confirmation>& confirmed) {
  if (confirmed.empty()) return "";
  const std::string unit = study.search.objective == Objective::body_lengths ? "BL" : "m2";
  std::string text = "The best robots on finer elements [" + unit + "]:\n";
  for (const Confirmation& one : confirmed) {
    text += "  " + std::to_string(one.rank) + ". individual " + std::to_string(one.design.individual) + ": " +
            io::formatted("%.4f", one.design.fitness) + " in the search, ";
    text += one.score ? io::formatted("%.4f", *one.score) : std::string("none");
    text += " on " + std::string(to_string(one.fidelity)) + " elements";
    if (one.angle_deg) text += ", turned by " + io::formatted("%.0f", *one.angle_deg) + " degrees";
    if (!one.reason.empty()) text += " (" + one.reason + ")";
    text += "\n";
  }
  return text;
}

}  // namespace menger::evolution
