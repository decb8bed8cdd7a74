#include "evolution/report/confirmation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

#include "evolution/evaluation/scenario_evaluator.h"
#include "evolution/evaluation/worker_pool.h"
#include "evolution/genome/robot_form.h"
#include "evolution/report/study_view.h"
#include "io/text/content_hash.h"
#include "io/text/formatted.h"

namespace menger::evolution {

namespace {

constexpr int level = 1;  ///< of all bodies on finite elements

std::unique_ptr<DesignEvaluator> evaluator_on(const Study& study, fem::Fidelity fidelity) {
  Study finer = study;
  finer.silicone.elements.fidelity = fidelity;
  return evaluator_of(finer);
}

/// Returns the best designs that differ by more than their pose, the best first.
std::vector<FitDesign> different_robots(const Study& study, const RunArchive& archive, std::size_t most) {
  const Distinction distinction = distinction_of(study);
  std::vector<FitDesign> robots;
  std::set<std::string> forms;
  for (FitDesign& design : archive.fit_designs()) {
    if (robots.size() == most) break;
    if (forms.insert(robot_form(design.phenotype.body, distinction)).second) robots.push_back(std::move(design));
  }
  return robots;
}

/// A walk that is to be made.
struct Order {
  Reevaluation row;
  std::size_t evaluator = 0;
};

/// The walks that an archive has, by design and protocol.
using MadeWalks = std::map<std::pair<std::string, std::string>, Evaluation>;

MadeWalks walks_in(const RunArchive& archive) {
  MadeWalks made;
  for (const Reevaluation& one : archive.reevaluations())
    if (one.has_result && one.result.status != io::RunStatus::stopped) made[{one.design_hash, one.protocol}] = one.result;
  return made;
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

/// Returns the walks of a robot in all scenarios on one fidelity; nothing if some are not made.
std::optional<KnownResults> results_on(const std::vector<std::string>& protocols, const std::string& design,
                                       const MadeWalks& made) {
  KnownResults results;
  for (std::size_t scenario = 0; scenario < protocols.size(); ++scenario) {
    const auto found = made.find({design, protocols[scenario]});
    if (found == made.end()) return std::nullopt;
    results[{level, scenario}] = found->second;
  }
  return results;
}

std::string first_reason(const KnownResults& results) {
  const auto failed = std::ranges::find_if(results, [](const auto& one) { return !one.second.displacement_m; });
  return failed == results.end() ? "" : failed->second.reason;
}

}  // namespace

io::RunStatus confirm(const Study& study, RunArchive& archive, const ConfirmationOptions& options) {
  const MadeWalks made = walks_in(archive);
  std::vector<std::unique_ptr<DesignEvaluator>> evaluators;
  std::vector<Order> orders;
  std::vector<EvaluationTask> tasks;
  const std::vector<FitDesign> robots = different_robots(study, archive, study.confirm);
  for (const fem::Fidelity fidelity : finer_fidelities(study)) {
    Study finer = study;
    finer.silicone.elements.fidelity = fidelity;
    std::vector<std::unique_ptr<DesignEvaluator>> scenarios = scenario_evaluators_of(finer);
    for (std::unique_ptr<DesignEvaluator>& scenario : scenarios) {
      const std::string protocol = scenario->physics();
      for (const FitDesign& robot : robots) {
        const Phenotype simulated = as_simulated(study.search, robot.phenotype);
        Order order{{.design_hash = design_hash(simulated, level),
                     .level = level,
                     .protocol = protocol,
                     .variant = "confirmed on " + std::string(to_string(fidelity)) + " elements",
                     .duration_s = study.duration_s,
                     .result = {}},
                    evaluators.size()};
        if (made.contains({order.row.design_hash, protocol})) continue;
        tasks.push_back({aggregate(simulated, level), level, evaluators.size()});
        orders.push_back(std::move(order));
      }
      evaluators.push_back(std::move(scenario));
    }
  }
  if (tasks.empty()) return io::RunStatus::completed;
  const ScenarioEvaluator all(std::move(evaluators));
  std::size_t done = 0;
  return WorkerPool(all, options.threads).run(tasks, options.stop, [&](std::size_t task, const Evaluation& result) {
    orders[task].row.result = result;
    archive.add_reevaluations({&orders[task].row, 1});
    ++done;
    if (options.progress) options.progress(done, tasks.size());
    if (options.after_commit) options.after_commit(done);
  });
}

std::vector<Confirmation> confirmations(const Study& study, const RunArchive& archive) {
  const MadeWalks made = walks_in(archive);
  std::vector<Confirmation> all;
  if (made.empty()) return all;
  const RunView run = view_of(archive, study);
  std::vector<std::pair<fem::Fidelity, std::vector<std::string>>> protocols;
  for (const fem::Fidelity fidelity : finer_fidelities(study))
    protocols.emplace_back(fidelity, evaluator_on(study, fidelity)->scenarios());
  const std::vector<FitDesign> robots = different_robots(study, archive, made.size());
  for (std::size_t n = 0; n < robots.size(); ++n) {
    const Phenotype simulated = as_simulated(study.search, robots[n].phenotype);
    for (const auto& [fidelity, texts] : protocols) {
      const std::optional<KnownResults> results = results_on(texts, design_hash(simulated, level), made);
      if (!results) continue;
      const KnownScore score = known_score(study.search, *results);
      Confirmation one{.rank = n + 1, .design = robots[n], .fidelity = fidelity};
      if (!score.is_failed) one.score = score.at_most;
      if (score.is_failed) one.reason = first_reason(*results);
      one.angle_deg = largest_angle_deg(archived_results(run, simulated), *results);
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
    table.add_row(std::uint64_t{one.rank}, one.design.individual, design_hash(simulated, level),
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
