#include "evolution/ranks/rank_workers.h"

#include <optional>
#include <utility>

#include "evolution/evaluation/worker_pool.h"
#include "evolution/ranks/evaluation_message.h"

namespace menger::evolution {

void SharedEvaluators::add(const DesignEvaluator& evaluator) {
  const std::vector<std::string> scenarios = evaluator.scenarios();
  for (std::size_t scenario = 0; scenario < scenarios.size(); ++scenario) {
    physics_ += scenarios[scenario] + "\n";
    places_.try_emplace(scenarios[scenario], evaluators_.size(), scenario);
  }
  evaluators_.push_back(&evaluator);
}

std::pair<std::size_t, std::size_t> SharedEvaluators::place_of(const std::string& physics) const { return places_.at(physics); }

std::string SharedEvaluators::evaluate(const std::string& task, const std::atomic<bool>& stop, const ThreadsNow& threads) const {
  const TaskMessage message = task_message_from(task);
  std::vector<const EvaluationTask*> together;
  together.reserve(message.tasks.size());
  for (const EvaluationTask& one : message.tasks) together.push_back(&one);
  return bytes_of(evaluators_.at(message.evaluator)->evaluate_together(together, stop, threads));
}

std::vector<std::pair<std::size_t, std::size_t>> RankWorkers::places_of(const DesignEvaluator& evaluator) const {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (const std::string& physics : evaluator.scenarios()) places.push_back(shared_.place_of(physics));
  return places;
}

io::RunStatus RankWorkers::run_stream(const DesignEvaluator& evaluator, std::vector<EvaluationTask> tasks,
                                      const std::atomic<bool>* stop, const TaskStream::Finished& finished) const {
  const std::vector<std::pair<std::size_t, std::size_t>> places = places_of(evaluator);
  const auto messages_of = [&](std::vector<EvaluationTask> all) {
    std::vector<std::string> messages;
    messages.reserve(all.size());
    for (EvaluationTask& task : all) {
      const auto [place, scenario] = places.at(task.scenario);
      task.scenario = scenario;
      messages.push_back(bytes_of(TaskMessage{.evaluator = place, .tasks = {std::move(task)}}));
    }
    return messages;
  };
  bool is_whole = true;
  const io::RunStatus status =
      team_.run(messages_of(std::move(tasks)), stop,
                [&](std::size_t task, const std::string& bytes) -> std::optional<std::vector<std::string>> {
                  const std::vector<Evaluation> results = results_from(bytes);
                  if (results.at(0).status == io::RunStatus::stopped) {
                    is_whole = false;
                    return std::vector<std::string>();
                  }
                  std::optional<std::vector<EvaluationTask>> more = finished(task, results[0]);
                  if (!more) return std::nullopt;
                  return messages_of(std::move(*more));
                });
  return is_whole ? status : io::RunStatus::stopped;
}

io::RunStatus RankWorkers::run(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                               const std::atomic<bool>* stop, const Workers::Finished& finished) const {
  if (tasks.empty()) return io::RunStatus::completed;
  const std::vector<std::pair<std::size_t, std::size_t>> places = places_of(evaluator);
  const std::vector<TaskGroup> groups = costliest_groups_first(tasks, evaluator, team_.threads());
  std::vector<std::string> messages;
  messages.reserve(groups.size());
  for (const TaskGroup& group : groups) {
    TaskMessage message{.evaluator = places.at(tasks[group.front()].scenario).first, .tasks = {}};
    for (const std::size_t task : group) {
      message.tasks.push_back(tasks[task]);
      message.tasks.back().scenario = places.at(tasks[task].scenario).second;
    }
    messages.push_back(bytes_of(message));
  }
  std::size_t done = 0;
  const io::RunStatus status = team_.run(std::move(messages), stop, [&](std::size_t group, const std::string& bytes) {
    const std::vector<Evaluation> results = results_from(bytes);
    for (std::size_t n = 0; n < results.size(); ++n) {
      if (results[n].status == io::RunStatus::stopped) continue;
      finished(groups[group].at(n), results[n]);
      ++done;
    }
    return std::vector<std::string>();
  });
  return status == io::RunStatus::completed && done < tasks.size() ? io::RunStatus::stopped : status;
}

}  // namespace menger::evolution
