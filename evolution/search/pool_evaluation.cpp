#include "evolution/search/pool_evaluation.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "io/text/content_hash.h"

namespace menger::evolution {

PoolEvaluation::PoolEvaluation(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                               const SearchOptions& options, int generation, std::size_t* commits)
    : plan_(&plan), evaluator_(&evaluator), archive_(&archive), options_(&options), generation_(generation), commits_(commits) {
  for (const std::string& physics : evaluator.scenarios()) physics_hashes_.push_back(io::content_hash(physics));
  assert(physics_hashes_.size() == plan.scenarios);
}

void PoolEvaluation::add_survivor(const PoolMember& survivor) {
  assert(survivor.knowledge != Knowledge::bounded);
  Entry entry;
  entry.member = survivor;
  entry.member.survivor_rank.reset();
  entries_.push_back(std::move(entry));
}

void PoolEvaluation::add_newcomer(const Individual& individual, bool duplicate, bool is_left_out) {
  Entry entry;
  entry.member.id = individual.id;
  entry.member.age = individual.age;
  entry.member.knowledge = Knowledge::bounded;
  entry.phenotype = as_simulated(*plan_, individual.phenotype);
  if (is_left_out) entry.member.knowledge = Knowledge::screened;
  if (duplicate && plan_->duplicates == DuplicatePolicy::culled) entry.member.knowledge = Knowledge::duplicate;
  if (is_penalised(individual.phenotype, plan_->offspring.constraints)) entry.member.knowledge = Knowledge::penalised;
  entries_.push_back(std::move(entry));
}

EvaluationKey PoolEvaluation::key_of(const Entry& entry, const EvaluationStage& stage) const {
  return {design_hash(*entry.phenotype, stage.level), stage.level, physics_hashes_.at(stage.scenario)};
}

void PoolEvaluation::learn(Entry& entry, const EvaluationStage& stage, const Evaluation& result) {
  entry.results[stage] = result;
  PoolMember& member = entry.member;
  const KnownScore known = known_score(*plan_, entry.results);
  if (known.is_failed) {
    member.knowledge = Knowledge::failed;
    member.fitness_bound.reset();
  }
  if (!entry.undecided()) return;
  member.fitness_bound = known.at_most;
  if (next_stage(*plan_, entry.results)) return;
  member.knowledge = Knowledge::evaluated;
  member.fitness = std::exchange(member.fitness_bound, std::nullopt);
}

io::RunStatus PoolEvaluation::evaluate(const std::vector<Request>& requests) {
  std::vector<EvaluationKey> missing;
  std::vector<EvaluationTask> tasks;
  std::set<EvaluationKey> asked;
  for (const auto& [position, stage] : requests) {
    EvaluationKey key = key_of(entries_[position], stage);
    if (results_.contains(key) || !asked.insert(key).second) {
      ++cached_;
      continue;
    }
    const auto archived = archive_->evaluation(key);
    // A result of this generation that is in the archive already comes from an interrupted run. It counts as made now.
    ++(archived && archived->generation < generation_ ? cached_ : evaluations_);
    if (archived) {
      results_[key] = archived->result;
    } else {
      tasks.push_back({aggregate(*entries_[position].phenotype, stage.level), stage.level, stage.scenario});
      missing.push_back(std::move(key));
    }
  }
  std::size_t finished = evaluations_ - tasks.size();
  const auto report = [&] {
    if (options_->progress) options_->progress({generation_, finished, evaluations_});
  };
  report();
  const auto keep = [&](std::size_t task, const Evaluation& result) {
    archive_->add_evaluation(missing[task], {generation_, result});
    results_[missing[task]] = result;
    ++finished;
    ++*commits_;
    if (options_->after_commit) options_->after_commit(*commits_);
    report();
  };
  const io::RunStatus status = options_->evaluate(*evaluator_, tasks, keep);
  if (status != io::RunStatus::completed) return status;
  for (const auto& [position, stage] : requests) {
    Entry& entry = entries_[position];
    learn(entry, stage, results_.at(key_of(entry, stage)));
  }
  return status;
}

io::RunStatus PoolEvaluation::evaluate_in_full() {
  std::vector<Request> requests;
  for (std::size_t position = 0; position < entries_.size(); ++position) {
    if (!entries_[position].undecided()) continue;
    for (const EvaluationStage& stage : stages(*plan_)) requests.emplace_back(position, stage);
  }
  return evaluate(requests);
}

io::RunStatus PoolEvaluation::evaluate_lazily(const Selection& selection) {
  while (true) {
    const SelectionOutlook view = selection.outlook(pool());
    if (view.certain()) return io::RunStatus::completed;
    std::vector<Request> requests;
    for (const std::uint64_t id : view.run_now) {
      const auto found = std::ranges::find_if(entries_, [id](const Entry& one) { return one.member.id == id; });
      requests.emplace_back(static_cast<std::size_t>(found - entries_.begin()), next_stage(*plan_, found->results).value());
    }
    const io::RunStatus status = evaluate(requests);
    if (status != io::RunStatus::completed) return status;
  }
}

std::vector<PoolMember> PoolEvaluation::pool() const {
  std::vector<PoolMember> all;
  all.reserve(entries_.size());
  for (const Entry& entry : entries_) all.push_back(entry.member);
  return all;
}

EvaluationCounts PoolEvaluation::counts() const {
  EvaluationCounts counts{evaluations_, cached_, 0};
  for (const Entry& entry : entries_) {
    const bool counted = entry.phenotype && entry.member.knowledge != Knowledge::duplicate &&
                         entry.member.knowledge != Knowledge::penalised && entry.member.knowledge != Knowledge::screened;
    if (counted) counts.pruned += plan_->levels().size() * plan_->scenarios - entry.results.size();
  }
  return counts;
}

}  // namespace menger::evolution
