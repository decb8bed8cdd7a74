#include "evolution/report/walks_again.h"

#include <algorithm>
#include <memory>
#include <set>

#include "evolution/evaluation/scenario_evaluator.h"
#include "evolution/evaluation/worker_pool.h"
#include "evolution/genome/robot_form.h"
#include "evolution/report/study_view.h"

namespace menger::evolution {

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

namespace {

/// The walks that an archive lacks.
struct MissingWalks {
  std::vector<std::unique_ptr<DesignEvaluator>> evaluators;  ///< of all scenarios
  std::vector<EvaluationTask> tasks;
  std::vector<Reevaluation> rows;  ///< of the tasks, without results
};

MissingWalks missing_walks(std::span<const WalksAgain> asked, std::span<const FitDesign> robots, const RunArchive& archive) {
  const MadeWalks made(archive);
  MissingWalks missing;
  auto& [evaluators, tasks, rows] = missing;
  std::set<std::tuple<std::string, int, std::string>> asked_for;  // several robots may have the same body
  for (const WalksAgain& one : asked) {
    for (std::unique_ptr<DesignEvaluator>& scenario : scenario_evaluators_of(one.study)) {
      const std::string protocol = scenario->physics();
      const int level = one.study.search.first_level();
      for (const FitDesign& robot : robots) {
        const Phenotype simulated = as_simulated(one.study.search, robot.phenotype);
        const std::string design = design_hash(simulated, level);
        if (made.in_scenarios({protocol}, design, level) || !asked_for.insert({design, level, protocol}).second) continue;
        tasks.push_back({aggregate(simulated, level), level, evaluators.size()});
        rows.push_back({.design_hash = design,
                        .level = level,
                        .protocol = protocol,
                        .variant = one.variant,
                        .duration_s = one.study.duration_s,
                        .result = {}});
      }
      evaluators.push_back(std::move(scenario));
    }
  }
  return missing;
}

}  // namespace

std::size_t missing_walk_count(const WalksAgain& asked, std::span<const FitDesign> robots, const RunArchive& archive) {
  return missing_walks({&asked, 1}, robots, archive).tasks.size();
}

io::RunStatus walk_again(std::span<const WalksAgain> asked, std::span<const FitDesign> robots, RunArchive& archive,
                         const WalksAgainOptions& options) {
  MissingWalks missing = missing_walks(asked, robots, archive);
  const std::vector<EvaluationTask>& tasks = missing.tasks;
  std::vector<Reevaluation>& rows = missing.rows;
  if (tasks.empty()) return io::RunStatus::completed;
  const ScenarioEvaluator all(std::move(missing.evaluators));
  std::size_t done = 0;
  const WorkerPool own(options.threads);
  const Workers& workers = options.workers != nullptr ? *options.workers : own;
  return workers.run(all, tasks, options.stop, [&](std::size_t task, const Evaluation& result) {
    rows[task].result = result;
    archive.add_reevaluations({&rows[task], 1});
    ++done;
    if (options.progress) options.progress(done, tasks.size());
    if (options.after_commit) options.after_commit(done);
  });
}

MadeWalks::MadeWalks(const RunArchive& archive) {
  for (const Reevaluation& one : archive.reevaluations())
    if (one.has_result && one.result.status != io::RunStatus::stopped)
      walks_[{one.design_hash, one.level, one.protocol}] = one.result;
}

std::optional<KnownResults> MadeWalks::in_scenarios(const std::vector<std::string>& protocols, const std::string& design,
                                                    int level) const {
  KnownResults results;
  for (std::size_t scenario = 0; scenario < protocols.size(); ++scenario) {
    const auto found = walks_.find({design, level, protocols[scenario]});
    if (found == walks_.end()) return std::nullopt;
    results[{level, scenario}] = found->second;
  }
  return results;
}

std::string first_reason(const KnownResults& results) {
  const auto failed = std::ranges::find_if(results, [](const auto& one) { return !one.second.displacement_m; });
  return failed == results.end() ? "" : failed->second.reason;
}

}  // namespace menger::evolution
