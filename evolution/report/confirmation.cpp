#include "evolution/report/confirmation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "evolution/report/study_view.h"
#include "io/shown/shown_quantity.h"
#include "io/text/formatted.h"

namespace menger::evolution {

namespace {

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

/// Returns how far a walk goes in the direction of another one, in the unit of the objective; negative if it goes back. A body
/// that stood still has no direction: nothing goes along it.
double along(const SearchPlan& plan, const std::array<double, 3>& direction_m, const std::array<double, 3>& moved_m) {
  const double length_m = std::hypot(direction_m[0], direction_m[1]);
  if (length_m == 0.0) return 0.0;
  const double along_m = (direction_m[0] * moved_m[0] + direction_m[1] * moved_m[1]) / length_m;
  return std::copysign(level_score(plan, {along_m, 0.0, 0.0}, plan.first_level()), along_m);
}

/// Returns the displacement that counts of all scenarios (Confirmation::along). A scenario without a displacement in the search
/// has no direction: there all of the displacement counts.
std::optional<double> along_of_scenarios(const SearchPlan& plan, const KnownResults& search, const KnownResults& finer) {
  constexpr double failed = -std::numeric_limits<double>::infinity();
  std::vector<double> all;
  for (const auto& [stage, result] : finer) {
    const auto before = search.find(stage);
    if (!result.displacement_m) {
      all.push_back(result.status == io::RunStatus::fell ? 0.0 : failed);
    } else if (before == search.end() || !before->second.displacement_m) {
      all.push_back(level_score(plan, *result.displacement_m, plan.first_level()));
    } else {
      all.push_back(along(plan, *before->second.displacement_m, *result.displacement_m));
    }
  }
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(plan.left_out_scenarios());
  std::ranges::nth_element(all, place);
  return *place == failed ? std::nullopt : std::optional(*place);
}

std::string unit_text(const Study& study) {
  const std::string unit = study.search.objective == Objective::body_lengths ? "body lengths" : "m2";
  return unit + (study.measure == Measure::last_periods ? " in a period" : "");
}

/// Returns the walks of a robot that are the first ones of several robots'.
std::span<const Confirmation> first_robot(std::span<const Confirmation> confirmed) {
  std::size_t count = 0;
  while (count < confirmed.size() && confirmed[count].rank == confirmed.front().rank) ++count;
  return confirmed.first(count);
}

std::string walk_text(const Confirmation& walk) {
  const std::string elements = " on " + std::string(to_string(walk.fidelity)) + " elements";
  if (!walk.score) return "no walk" + elements + " (" + walk.reason + ")";
  std::string text = io::formatted("%.4f", walk.along.value_or(*walk.score)) + elements;
  if (walk.angle_deg) text += " (turned by " + io::degrees(*walk.angle_deg) + ")";
  return text;
}

/// Describes the walks of a robot. @param is_named whether it has to be said which individual it is
std::string robot_text(const Study& study, std::span<const Confirmation> walks, bool is_named) {
  const Confirmation& one = walks.front();
  std::string text = "number " + std::to_string(one.rank) + " of the search";
  if (is_named) text += " (individual " + std::to_string(one.design.individual) + ")";
  text += ": " + io::formatted("%.4f", one.design.fitness) + " " + unit_text(study) + " there, along the same direction ";
  for (std::size_t n = 0; n < walks.size(); ++n)
    text += (n == 0 ? "" : n + 1 < walks.size() ? ", " : " and ") + walk_text(walks[n]);
  return text;
}

/// Says why the walks of a robot make it the champion.
std::string choice_text(const Study& study, std::span<const Confirmation> confirmed, std::span<const Confirmation> best) {
  std::string text = robot_text(study, best, false);
  const std::span<const Confirmation> first = first_robot(confirmed);
  if (first.front().rank != best.front().rank) text += "; it comes before " + robot_text(study, first, true);
  if (confirmed_value(best) <= 0.0) text += "; no robot that was confirmed keeps its direction on finer elements";
  return text;
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
    const std::string design = design_hash(simulated, study.search.first_level());
    std::vector<std::pair<fem::Fidelity, KnownResults>> walks;
    for (const auto& [fidelity, texts] : protocols)
      if (auto results = made.in_scenarios(texts, design, study.search.first_level()))
        walks.emplace_back(fidelity, *std::move(results));
    // A robot that has walked on some of the elements only, as another study asked, is not confirmed.
    if (walks.size() < protocols.size()) continue;
    const KnownResults search = archived_results(run, simulated);
    for (const auto& [fidelity, results] : walks) {
      const KnownScore score = known_score(study.search, results);
      Confirmation one{.rank = n + 1, .design = robots[n], .fidelity = fidelity};
      if (!score.is_failed) one.score = score.at_most;
      if (score.is_failed) one.reason = first_reason(results);
      one.along = along_of_scenarios(study.search, search, results);
      one.angle_deg = largest_angle_deg(search, results);
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::optional<double> confirmed_value(std::span<const Confirmation> walks) {
  if (std::ranges::none_of(walks, [](const Confirmation& one) { return one.score.has_value(); })) return std::nullopt;
  std::optional<double> smallest;
  std::size_t count = 0;
  for (const Confirmation& one : walks) {
    if (!one.along) continue;
    smallest = std::min(*one.along, smallest.value_or(*one.along));
    ++count;
  }
  if (smallest && *smallest > 0.0) *smallest *= static_cast<double>(count) / static_cast<double>(walks.size());
  return smallest;
}

std::span<const Confirmation> best_confirmed(std::span<const Confirmation> confirmed) {
  std::span<const Confirmation> best;
  std::optional<double> largest;
  while (!confirmed.empty()) {
    const std::span<const Confirmation> robot = first_robot(confirmed);
    const std::optional<double> value = confirmed_value(robot);
    if (value && (!largest || *value > *largest)) {
      best = robot;
      largest = value;
    }
    confirmed = confirmed.subspan(robot.size());
  }
  return best;
}

std::string champion_text(const Champion& champion) {
  const DesignSummary& design = champion.design;
  std::string text = "Champion: individual " + std::to_string(design.individual.id) + ", " + std::to_string(design.cells) +
                     " cells, " + phenotype_key(design.individual.phenotype);
  if (!champion.note.empty()) text += "; " + champion.note;
  return text;
}

std::optional<Champion> champion_of(const RunView& run, const Study& study, int generation,
                                    const std::vector<Confirmation>& confirmed) {
  std::optional<DesignSummary> fittest = summarise_generation(run, generation).champion;
  if (!fittest) return std::nullopt;
  if (confirmed.empty()) {
    std::string note =
        fittest->fitness ? io::formatted("%.4f", *fittest->fitness) + " " + unit_text(study) + " in the search" : "";
    return Champion{std::move(*fittest), std::move(note)};
  }
  const std::span<const Confirmation> walks = best_confirmed(confirmed);
  if (walks.empty()) {
    return Champion{std::move(*fittest), "the best of the search, as no robot that was confirmed walks on finer elements; " +
                                             robot_text(study, first_robot(confirmed), true)};
  }
  std::string note = choice_text(study, confirmed, walks);
  const Confirmation& best = walks.front();
  if (best.design.phenotype == fittest->individual.phenotype) return Champion{std::move(*fittest), std::move(note)};
  const std::vector<PoolMember> pool = run.archive->pool(generation);
  const auto member = std::ranges::find(pool, best.design.individual, &PoolMember::id);
  const PoolMember gone{.id = best.design.individual, .fitness = best.design.fitness};
  return Champion{summarise_design(run, run.archive->individual(best.design.individual), member == pool.end() ? gone : *member),
                  std::move(note)};
}

io::CsvTable confirmation_table(const Study& study, const std::vector<Confirmation>& confirmed) {
  const std::string unit(fitness_unit(study.search.objective));
  io::CsvTable table({"rank", "individual", "design", "cells", "fitness_" + unit, "fidelity", "score_" + unit, "ratio",
                      "angle_deg", "along_" + unit, "reason"});
  for (const Confirmation& one : confirmed) {
    const Phenotype simulated = as_simulated(study.search, one.design.phenotype);
    std::optional<double> ratio;
    if (one.score && one.design.fitness > 0.0) ratio = *one.score / one.design.fitness;
    table.add_row(std::uint64_t{one.rank}, one.design.individual, design_hash(simulated, study.search.first_level()),
                  std::uint64_t{simulated.body.count()}, one.design.fitness, to_string(one.fidelity), one.score, ratio,
                  one.angle_deg, one.along, one.reason);
  }
  return table;
}

std::string confirmation_text(const Study& study, const std::vector<Confirmation>& confirmed) {
  if (confirmed.empty()) return "";
  std::string text = "The best robots on finer elements [" + unit_text(study) + "]:\n";
  for (const Confirmation& one : confirmed) {
    text += "  " + std::to_string(one.rank) + ". individual " + std::to_string(one.design.individual) + ": " +
            io::formatted("%.4f", one.design.fitness) + " in the search, ";
    text += one.score ? io::formatted("%.4f", *one.score) : std::string("none");
    text += " on " + std::string(to_string(one.fidelity)) + " elements";
    if (one.angle_deg) text += ", turned by " + io::degrees(*one.angle_deg);
    if (!one.reason.empty()) text += " (" + one.reason + ")";
    text += "\n";
  }
  return text;
}

}  // namespace menger::evolution
