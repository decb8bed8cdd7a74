#include "evolution/report/evaluated_tasks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "evolution/evaluation/task_schedule.h"
#include "evolution/search/niches.h"
#include "io/text/input_error.h"

namespace menger::evolution {
namespace {

/// Repeats the decisions of a search in one generation from the results in its archive, to find which evaluations it asked for.
class Replay {
 public:
  Replay(const RunView& run, int generation)
      : run_(run), generation_(generation), selection_(run.plan), physics_hashes_(run.physics_hashes()) {
    for (const PoolMember& member : run.archive->pool(generation)) {
      Entry entry;
      entry.archived = member;
      entry.known = {.id = member.id, .age = member.age, .fitness = member.fitness};
      const Individual individual = run.archive->individual(member.id);
      selection_.add(member.id, individual.phenotype);
      const bool is_evaluated = member.knowledge != Knowledge::duplicate && member.knowledge != Knowledge::penalised &&
                                member.knowledge != Knowledge::screened;
      if (individual.generation == generation && is_evaluated) {
        entry.phenotype = as_simulated(run.plan, individual.phenotype);
        entry.known.knowledge = Knowledge::bounded;
        entry.known.fitness.reset();
      }
      entries_.push_back(std::move(entry));
    }
  }

  std::vector<EvaluatedTask> tasks() {
    if (generation_ == 0 || !run_.plan.pruning) {
      for (Entry& entry : entries_) {
        while (entry.phenotype && next_stage(run_.plan, entry.results)) ask(entry);
      }
      return std::move(tasks_);
    }
    while (true) {
      const SelectionOutlook view = selection_.outlook(pool());
      if (view.certain()) return std::move(tasks_);
      for (const std::uint64_t id : view.run_now)
        ask(*std::ranges::find(entries_, id, [](const Entry& one) { return one.archived.id; }));
      ++batch_;
    }
  }

 private:
  struct Entry {
    PoolMember archived;
    std::optional<Phenotype> phenotype;  ///< only of those that are evaluated in this generation
    PoolMember known;                    ///< from the results that were asked for so far
    KnownResults results;                ///< which are these
  };

  [[nodiscard]] std::vector<PoolMember> pool() const {
    std::vector<PoolMember> all;
    for (const Entry& entry : entries_) all.push_back(entry.known);
    return all;
  }

  /// Reads the result of the next stage of an entry and updates what is known of it.
  void ask(Entry& entry) {
    const EvaluationStage stage = next_stage(run_.plan, entry.results).value();
    const int level = stage.level;
    EvaluationKey key{design_hash(*entry.phenotype, level), level, physics_hashes_.at(stage.scenario)};
    const auto found = run_.archive->evaluation(key);
    if (!found) {
      throw io::InputError(run_.archive->file().string() + ": lacks the result of individual " +
                           std::to_string(entry.archived.id) + " at level " + std::to_string(level));
    }
    entry.results[stage] = found->result;
    learn(entry);
    if (found->generation != generation_ || !asked_.insert(key).second) return;
    tasks_.push_back({batch_, entry.archived.id, key.design_hash, level, stage.scenario,
                      aggregate_cell_count(*entry.phenotype, level) * run_.voxels_per_cell, found->result});
  }

  void learn(Entry& entry) {
    PoolMember& known = entry.known;
    const KnownScore score = known_score(run_.plan, entry.results);
    if (score.is_failed) known.knowledge = Knowledge::failed;
    if (known.is_decided()) return;
    known.fitness_bound = score.at_most;
    if (next_stage(run_.plan, entry.results)) return;
    // The archive of an earlier version may have a corrected fitness.
    known.knowledge = entry.archived.knowledge;
    known.fitness = entry.archived.fitness;
  }

  const RunView& run_;
  int generation_;
  Selection selection_;
  std::vector<std::string> physics_hashes_;
  std::vector<Entry> entries_;
  std::set<EvaluationKey> asked_;
  std::size_t batch_ = 0;
  std::vector<EvaluatedTask> tasks_;
};

/// Returns seconds and expected costs of tasks, a list per batch. @param as_one whether all tasks form one batch
std::vector<std::vector<TimedTask>> timed_batches(const std::vector<EvaluatedTask>& tasks, bool as_one) {
  std::map<std::size_t, std::vector<TimedTask>> batches;
  for (const EvaluatedTask& task : tasks)
    batches[as_one ? 0 : task.batch].push_back({task.result.seconds, static_cast<double>(task.voxels)});
  std::vector<std::vector<TimedTask>> all;
  all.reserve(batches.size());
  for (auto& [batch, list] : batches) all.push_back(std::move(list));
  return all;
}

/// Returns the times of batches that run one after the other.
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
  io::CsvTable table(
      {"generation", "batch", "individual", "design", "level", "scenario", "voxels", "steps", "status", "seconds"});
  const int last = run.archive->last_generation().value_or(-1);
  for (int generation = 0; generation <= last; ++generation) {
    for (const EvaluatedTask& task : evaluated_tasks(run, generation)) {
      table.add_row(generation, std::uint64_t{task.batch}, task.individual, task.design_hash, task.level,
                    std::uint64_t{task.scenario + 1}, std::uint64_t{task.voxels}, task.result.steps,
                    io::to_string(task.result.status), task.result.seconds);
    }
  }
  return table;
}

io::CsvTable schedule_table(const RunView& run, const std::vector<std::size_t>& workers) {
  io::CsvTable table({"generation", "workers", "evaluations", "batches", "busy_seconds", "seconds", "as_asked_seconds",
                      "least_seconds", "in_one_batch_seconds", "idle_tail_seconds", "wall_seconds"});
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
