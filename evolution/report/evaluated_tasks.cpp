#include "evolution/report/evaluated_tasks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "evolution/evaluation/task_schedule.h"
#include "evolution/search/lazy_selection.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

/// The questions that a search asked in one generation, from the answers in its archive.
class Replay {
 public:
  Replay(const RunView& run, int generation) : run_(run), generation_(generation), physics_hash_(io::content_hash(run.physics)) {
    for (const Contender& contender : run.archive->contenders(generation)) {
      Candidate candidate;
      candidate.contender = contender;
      candidate.pool = {.id = contender.id, .age = contender.age, .decided = true, .fitness = contender.fitness};
      const Individual individual = run.archive->individual(contender.id);
      const bool is_judged = contender.knowledge != Knowledge::duplicate && contender.knowledge != Knowledge::penalised;
      if (individual.generation == generation && is_judged) {
        candidate.phenotype = as_simulated(run.plan, individual.phenotype);
        candidate.pool.decided = false;
        candidate.pool.fitness.reset();
      }
      candidates_.push_back(std::move(candidate));
    }
  }

  std::vector<EvaluatedTask> tasks() {
    if (generation_ == 0 || !run_.plan.pruning) {
      for (Candidate& candidate : candidates_) {
        while (candidate.phenotype && candidate.levels_known < run_.plan.levels().size()) ask(candidate);
      }
      return std::move(tasks_);
    }
    while (true) {
      const SelectionOutlook view = outlook(pool(), static_cast<std::size_t>(run_.plan.survivors));
      if (view.certain()) return std::move(tasks_);
      for (const std::uint64_t id : view.run_now)
        ask(*std::ranges::find(candidates_, id, [](const Candidate& one) { return one.contender.id; }));
      ++batch_;
    }
  }

 private:
  struct Candidate {
    Contender contender;
    std::optional<Phenotype> phenotype;  ///< of those that are judged in this generation
    PartialContestant pool;
    std::size_t levels_known = 0;
  };

  [[nodiscard]] std::vector<PartialContestant> pool() const {
    std::vector<PartialContestant> all;
    for (const Candidate& candidate : candidates_) all.push_back(candidate.pool);
    return all;
  }

  /// Asks for the next level of a candidate and learns the answer.
  void ask(Candidate& candidate) {
    const int level = run_.plan.levels().at(candidate.levels_known++);
    EvaluationKey key{design_hash(*candidate.phenotype, level), level, physics_hash_};
    const auto found = run_.archive->evaluation(key);
    if (!found) {
      throw io::InputError(run_.archive->file().string() + ": lacks the result of individual " +
                           std::to_string(candidate.contender.id) + " at level " + std::to_string(level));
    }
    learn(candidate, found->result, level);
    if (found->generation != generation_ || !asked_.insert(key).second) return;
    tasks_.push_back({batch_, candidate.contender.id, key.design_hash, level,
                      aggregate_cell_count(*candidate.phenotype, level) * run_.voxels_per_cell, found->result});
  }

  void learn(Candidate& candidate, const Evaluation& result, int level) {
    PartialContestant& pool = candidate.pool;
    if (!result.displacement_m) pool.decided = true;
    if (pool.decided) return;
    pool.bound = std::min(pool.bound, level_score(run_.plan, *result.displacement_m, level));
    if (candidate.levels_known < run_.plan.levels().size()) return;
    // What the archive keeps went through the correction of a judge, if there is one.
    pool.decided = true;
    pool.fitness = candidate.contender.fitness;
  }

  const RunView& run_;
  int generation_;
  std::string physics_hash_;
  std::vector<Candidate> candidates_;
  std::set<EvaluationKey> asked_;
  std::size_t batch_ = 0;
  std::vector<EvaluatedTask> tasks_;
};

/// Seconds and expected costs of tasks, a list per batch. @param as_one all of them in one
std::vector<std::vector<TimedTask>> timed_batches(const std::vector<EvaluatedTask>& tasks, bool as_one) {
  std::map<std::size_t, std::vector<TimedTask>> batches;
  for (const EvaluatedTask& task : tasks)
    batches[as_one ? 0 : task.batch].push_back({task.result.seconds, static_cast<double>(task.voxels)});
  std::vector<std::vector<TimedTask>> all;
  all.reserve(batches.size());
  for (auto& [batch, list] : batches) all.push_back(std::move(list));
  return all;
}

/// Batches one after the other.
Schedule in_sequence(const std::vector<std::vector<TimedTask>>& batches, std::size_t workers, TaskOrder order) {
  Schedule sum;
  for (const std::vector<TimedTask>& batch : batches) {
    const Schedule one = list_schedule(batch, workers, order);
    sum.makespan_s += one.makespan_s;
    sum.busy_s += one.busy_s;
    sum.straggling_s += one.straggling_s;
  }
  return sum;
}

}  // namespace

std::vector<EvaluatedTask> evaluated_tasks(const RunView& run, int generation) { return Replay(run, generation).tasks(); }

io::CsvTable timing_table(const RunView& run) {
  io::CsvTable table({"generation", "batch", "individual", "design", "level", "voxels", "steps", "status", "seconds"});
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    for (const EvaluatedTask& task : evaluated_tasks(run, generation)) {
      table.add_row(generation, std::uint64_t{task.batch}, task.individual, task.design_hash, task.level,
                    std::uint64_t{task.voxels}, task.result.steps, io::to_string(task.result.status), task.result.seconds);
    }
  }
  return table;
}

io::CsvTable schedule_table(const RunView& run, const std::vector<std::size_t>& workers) {
  io::CsvTable table({"generation", "workers", "evaluations", "batches", "busy_seconds", "seconds", "as_asked_seconds",
                      "least_seconds", "in_one_batch_seconds", "straggling_seconds", "took_seconds"});
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    const std::vector<EvaluatedTask> tasks = evaluated_tasks(run, generation);
    const double took_s = run.archive->generation(generation).seconds;
    const auto batches = timed_batches(tasks, false);
    const auto one_batch = timed_batches(tasks, true);
    for (const std::size_t count : workers) {
      const Schedule schedule = in_sequence(batches, count, TaskOrder::costliest_first);
      double least_s = 0.0;
      for (const std::vector<TimedTask>& batch : batches) least_s += least_makespan_s(batch, count);
      table.add_row(generation, std::uint64_t{count}, std::uint64_t{tasks.size()}, std::uint64_t{batches.size()}, schedule.busy_s,
                    schedule.makespan_s, in_sequence(batches, count, TaskOrder::as_asked).makespan_s, least_s,
                    in_sequence(one_batch, count, TaskOrder::costliest_first).makespan_s, schedule.straggling_s, took_s);
    }
  }
  return table;
}

}  // namespace menger::evolution
