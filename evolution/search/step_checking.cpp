#include "evolution/search/step_checking.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <utility>

#include "evolution/search/search.h"
#include "io/text/content_hash.h"

namespace menger::evolution {
namespace {

std::optional<double> least_score(const SearchPlan& plan, const CheckedDesign& design, Evaluation CheckedLevel::*which) {
  std::optional<double> least;
  for (const CheckedLevel& level : design.levels) {
    const Evaluation& result = level.*which;
    if (!result.displacement_m) return std::nullopt;
    const double score = level_score(plan, *result.displacement_m, level.level);
    least = std::min(score, least.value_or(score));
  }
  return least;
}

}  // namespace

std::vector<Elite> elites(const SearchPlan& plan, std::span<const Survivor> survivors, std::size_t count) {
  std::vector<const Survivor*> line;
  for (const Survivor& one : survivors)
    if (one.member.survivor_rank && one.member.fitness) line.push_back(&one);
  std::ranges::sort(line, [](const Survivor* a, const Survivor* b) { return is_fitter(a->member, b->member); });
  std::vector<Elite> best;
  std::set<std::string> seen;
  for (const Survivor* one : line) {
    if (best.size() == count) break;
    Phenotype simulated = as_simulated(plan, one->individual.phenotype);
    if (!seen.insert(phenotype_key(simulated)).second) continue;
    best.push_back({one->individual.id, one->member.fitness.value(), std::move(simulated)});
  }
  return best;
}

std::optional<double> CheckedLevel::distance_m() const {
  if (!whole.displacement_m || !half.displacement_m) return std::nullopt;
  const auto& a = *whole.displacement_m;
  const auto& b = *half.displacement_m;
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::optional<double> half_step_score(const SearchPlan& plan, const CheckedDesign& design) {
  return least_score(plan, design, &CheckedLevel::half);
}

std::optional<double> whole_step_score(const SearchPlan& plan, const CheckedDesign& design) {
  return least_score(plan, design, &CheckedLevel::whole);
}

StepChecking::StepChecking(const SearchPlan& plan, const DesignEvaluator& half, RunArchive& archive)
    : plan_(&plan), half_(&half), archive_(&archive), physics_hash_(io::content_hash(half.physics())) {}

bool StepChecking::is_due(int generation) const { return generation % plan_->step_checks.value().every == 0; }

bool StepChecking::check(int generation, std::span<const Survivor> survivors, const SearchOptions& options,
                         std::size_t* commits) {
  std::vector<EvaluationKey> missing;
  std::vector<EvaluationTask> tasks;
  for (const Elite& elite : elites(*plan_, survivors, plan_->step_checks->designs)) {
    for (const int level : plan_->levels()) {
      EvaluationKey key{design_hash(elite.simulated, level), level, physics_hash_};
      if (archive_->step_check(key) || std::ranges::find(missing, key) != missing.end()) continue;
      tasks.push_back({aggregate(elite.simulated, level), level});
      missing.push_back(std::move(key));
    }
  }
  if (tasks.empty()) return true;
  std::size_t finished = 0;
  const auto report = [&] {
    if (options.progress) options.progress({generation, finished, tasks.size()});
  };
  report();
  const io::RunStatus status = options.evaluate(*half_, tasks, [&](std::size_t task, const Evaluation& result) {
    archive_->add_step_check(missing[task], {generation, result});
    ++finished;
    ++*commits;
    if (options.after_commit) options.after_commit(*commits);
    report();
  });
  return status == io::RunStatus::completed;
}

std::vector<CheckedDesign> checked_designs(const SearchPlan& plan, const RunArchive& archive, int generation,
                                           const std::string& physics, const std::string& half_physics) {
  std::vector<Survivor> survivors;
  for (const PoolMember& one : archive.survivors(generation)) survivors.push_back({archive.individual(one.id), one});

  const std::string hash = io::content_hash(physics);
  const std::string half_hash = io::content_hash(half_physics);
  std::vector<CheckedDesign> checked;
  for (Elite& elite : elites(plan, survivors, plan.step_checks.value().designs)) {
    CheckedDesign design{std::move(elite), {}};
    for (const int level : plan.levels()) {
      const std::string body = design_hash(design.elite.simulated, level);
      const auto whole = archive.evaluation({body, level, hash});
      const auto half = archive.step_check({body, level, half_hash});
      if (whole && half) design.levels.push_back({level, whole->result, half->result});
    }
    checked.push_back(std::move(design));
  }
  return checked;
}

}  // namespace menger::evolution
