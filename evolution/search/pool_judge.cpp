#include "evolution/search/pool_judge.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "io/text/content_hash.h"

namespace menger::evolution {

namespace {

const std::atomic<bool> never{false};

}  // namespace

PoolJudge::PoolJudge(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive, const SearchOptions& options,
                     int generation, std::size_t* commits, const CorrectedFitness* correction)
    : plan_(&plan),
      archive_(&archive),
      options_(&options),
      physics_hash_(io::content_hash(evaluator.physics())),
      generation_(generation),
      commits_(commits),
      correction_(correction),
      workers_(evaluator, options.threads) {}

void PoolJudge::add_survivor(const Contender& survivor) {
  assert(survivor.knowledge != Knowledge::bounded);
  Candidate candidate;
  candidate.contender = survivor;
  candidate.contender.survivor_rank.reset();
  candidates_.push_back(std::move(candidate));
}

void PoolJudge::add_newcomer(const Individual& individual, bool duplicate) {
  Candidate candidate;
  candidate.contender.id = individual.id;
  candidate.contender.age = individual.age;
  candidate.contender.knowledge = Knowledge::bounded;
  candidate.phenotype = as_simulated(*plan_, individual.phenotype);
  if (duplicate && plan_->duplicates == DuplicatePolicy::culled) candidate.contender.knowledge = Knowledge::duplicate;
  if (is_penalised(individual.phenotype, plan_->offspring.constraints)) candidate.contender.knowledge = Knowledge::penalised;
  candidates_.push_back(std::move(candidate));
}

EvaluationKey PoolJudge::key_of(const Candidate& candidate, int level) const {
  return {design_hash(*candidate.phenotype, level), level, physics_hash_};
}

std::optional<int> PoolJudge::next_level(const Candidate& candidate) const {
  for (const int level : plan_->levels()) {
    if (!candidate.results.contains(level)) return level;
  }
  return std::nullopt;
}

void PoolJudge::learn(Candidate& candidate, int level, const Evaluation& result) {
  candidate.results[level] = result;
  Contender& contender = candidate.contender;
  if (!result.displacement_m) {
    contender.knowledge = Knowledge::failed;
    contender.fitness_bound.reset();
  }
  if (!candidate.undecided()) return;
  const double score = level_score(*plan_, *result.displacement_m, level);
  contender.fitness_bound = std::min(score, contender.fitness_bound.value_or(score));
  if (next_level(candidate)) return;
  contender.knowledge = Knowledge::evaluated;
  contender.fitness = std::exchange(contender.fitness_bound, std::nullopt);
  if (correction_ == nullptr) return;
  const CorrectedScore corrected = correction_->score(candidate.phenotype->body, *contender.fitness);
  contender.knowledge = corrected.knowledge;
  contender.fitness = corrected.fitness;
}

io::RunStatus PoolJudge::evaluate(const std::vector<Request>& requests) {
  std::vector<EvaluationKey> missing;
  std::vector<EvaluationTask> tasks;
  std::set<EvaluationKey> asked;
  for (const auto& [position, level] : requests) {
    EvaluationKey key = key_of(candidates_[position], level);
    if (results_.contains(key) || !asked.insert(key).second) {
      ++cached_;
      continue;
    }
    const auto archived = archive_->evaluation(key);
    // A result of this generation that is there already is left from an interrupted run: it counts as made now.
    ++(archived && archived->generation < generation_ ? cached_ : evaluations_);
    if (archived) {
      results_[key] = archived->result;
    } else {
      tasks.push_back({aggregate(*candidates_[position].phenotype, level), level});
      missing.push_back(std::move(key));
    }
  }
  std::size_t finished = evaluations_ - tasks.size();
  const auto report = [&] {
    if (options_->progress) options_->progress({generation_, finished, evaluations_});
  };
  report();
  const io::RunStatus status =
      workers_.run(tasks, options_->stop != nullptr ? *options_->stop : never, [&](std::size_t task, const Evaluation& result) {
        archive_->add_evaluation(missing[task], {generation_, result});
        results_[missing[task]] = result;
        ++finished;
        ++*commits_;
        if (options_->after_commit) options_->after_commit(*commits_);
        report();
      });
  if (status != io::RunStatus::completed) return status;
  for (const auto& [position, level] : requests) {
    Candidate& candidate = candidates_[position];
    learn(candidate, level, results_.at(key_of(candidate, level)));
  }
  return status;
}

io::RunStatus PoolJudge::judge_in_full() {
  std::vector<Request> requests;
  for (std::size_t position = 0; position < candidates_.size(); ++position) {
    if (!candidates_[position].undecided()) continue;
    for (const int level : plan_->levels()) requests.emplace_back(position, level);
  }
  return evaluate(requests);
}

io::RunStatus PoolJudge::judge_lazily() {
  while (true) {
    const SelectionOutlook view = outlook(partial_pool(), static_cast<std::size_t>(plan_->survivors));
    if (view.certain()) return io::RunStatus::completed;
    std::vector<Request> requests;
    for (const std::uint64_t id : view.run_now) {
      const auto found = std::ranges::find_if(candidates_, [id](const Candidate& one) { return one.contender.id == id; });
      requests.emplace_back(static_cast<std::size_t>(found - candidates_.begin()), *next_level(*found));
    }
    const io::RunStatus status = evaluate(requests);
    if (status != io::RunStatus::completed) return status;
  }
}

std::vector<PartialContestant> PoolJudge::partial_pool() const {
  std::vector<PartialContestant> pool;
  for (const Candidate& candidate : candidates_) {
    const Contender& contender = candidate.contender;
    PartialContestant partial{
        .id = contender.id, .age = contender.age, .decided = !candidate.undecided(), .fitness = contender.fitness};
    if (contender.fitness_bound) partial.bound = *contender.fitness_bound;
    pool.push_back(partial);
  }
  return pool;
}

std::vector<Contestant> PoolJudge::contestants() const { return settled(partial_pool()); }

std::vector<Contender> PoolJudge::contenders() const {
  std::vector<Contender> all;
  for (const Candidate& candidate : candidates_) all.push_back(candidate.contender);
  return all;
}

JudgeCounts PoolJudge::counts() const {
  JudgeCounts counts{evaluations_, cached_, 0};
  for (const Candidate& candidate : candidates_) {
    const bool counted = candidate.phenotype && candidate.contender.knowledge != Knowledge::duplicate &&
                         candidate.contender.knowledge != Knowledge::penalised;
    if (counted) counts.pruned += plan_->levels().size() - candidate.results.size();
  }
  return counts;
}

}  // namespace menger::evolution
