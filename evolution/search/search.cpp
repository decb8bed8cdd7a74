#include "evolution/search/search.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "evolution/evaluation/worker_pool.h"
#include "evolution/genome/random_stream.h"
#include "evolution/search/niches.h"
#include "evolution/search/pool_evaluation.h"
#include "evolution/search/steady_search.h"
#include "evolution/search/step_checking.h"
#include "evolution/search/survivor.h"
#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

using Clock = std::chrono::steady_clock;

class Search {
 public:
  Search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive, const SearchOptions& options,
         const DesignEvaluator* half_step, const DesignEvaluator* surrogate)
      : plan_(plan),
        evaluator_(evaluator),
        archive_(archive),
        options_(options),
        variation_(plan.seed, "variation"),
        selection_(plan.seed, "selection") {
    assert(plan.step_checks.has_value() == (half_step != nullptr));
    assert(plan.screening.has_value() == (surrogate != nullptr));
    if (half_step != nullptr) checking_.emplace(plan, *half_step, archive);
    if (surrogate != nullptr) screening_.emplace(plan, *surrogate, evaluator.physics(), archive);
  }

  io::RunStatus run() {
    restore();
    for (; next_generation_ <= plan_.generations; ++next_generation_) {
      const io::RunStatus status = do_generation();
      if (status != io::RunStatus::completed) return status;
      if (options_.ends_with && options_.ends_with(next_generation_)) break;
    }
    return io::RunStatus::completed;
  }

 private:
  void restore() {
    try {
      restore_last_generation();
    } catch (const io::InputError& error) {
      const std::string file = archive_.file().string();
      if (std::string_view(error.what()).starts_with(file)) throw;
      throw io::InputError(file + ": is damaged: " + error.what());  // of a text in it, which does not know its archive
    }
  }

  void restore_last_generation() {
    const auto last = archive_.last_generation();
    if (!last) return;
    next_generation_ = *last + 1;
    next_id_ = archive_.next_id();
    const GenerationRecord record = archive_.generation(*last);
    variation_ = RandomStream::from_text(record.variation_generator);
    selection_ = RandomStream::from_text(record.selection_generator);
    for (const PoolMember& member : archive_.survivors(*last)) survivors_.push_back({archive_.individual(member.id), member});
    if (survivors_.empty()) {
      throw io::InputError(archive_.file().string() + ": is damaged: generation " + std::to_string(*last) + " has no survivors");
    }
    for (const std::string& key : archive_.tried_phenotype_keys()) phenotypes_.insert(simulated_key(phenotype_from_key(key)));
  }

  [[nodiscard]] std::string simulated_key(const Phenotype& phenotype) const {
    return phenotype_key(as_simulated(plan_, phenotype));
  }

  io::RunStatus do_generation() {
    const auto start = Clock::now();
    born_.clear();
    const std::vector<Individual> born = next_generation_ == 0 ? first_generation() : children_and_newcomers();
    ScreeningRound screened;
    if (screening_) {
      auto round = screening_->screen(next_generation_, candidates(born), options_, &commits_);
      if (!round) return io::RunStatus::stopped;
      screened = std::move(*round);
      if (options_.screened) options_.screened(screened);
    }
    PoolEvaluation pool(plan_, evaluator_, archive_, options_, next_generation_, &commits_);
    Selection selection(plan_);
    for (const Survivor& survivor : survivors_) {
      pool.add_survivor(survivor.member);
      selection.add(survivor.individual.id, survivor.individual.phenotype);
    }
    for (const Individual& individual : born) {
      selection.add(individual.id, individual.phenotype);
      const auto found = std::ranges::find(screened.individuals, individual.id, &ScreenedIndividual::id);
      const bool is_left_out = found != screened.individuals.end() && found->outcome == Screened::left_out;
      // One that is left out is no earlier one to its copies: they may pass.
      const bool is_new = is_left_out || phenotypes_.insert(simulated_key(individual.phenotype)).second;
      pool.add_newcomer(individual, !is_new, is_left_out);
    }
    const bool lazily = plan_.pruning && next_generation_ > 0;
    const io::RunStatus status = lazily ? pool.evaluate_lazily(selection) : pool.evaluate_in_full();
    if (status != io::RunStatus::completed) return status;
    return commit(pool, selection, born, screened, start);
  }

  /// Returns the new individuals that are to be evaluated: those that are neither penalised nor culled as duplicates of earlier
  /// generations.
  [[nodiscard]] std::vector<const Individual*> candidates(const std::vector<Individual>& born) const {
    std::vector<const Individual*> all;
    for (const Individual& individual : born) {
      if (is_penalised(individual.phenotype, plan_.offspring.constraints)) continue;
      if (plan_.duplicates == DuplicatePolicy::culled && phenotypes_.contains(simulated_key(individual.phenotype))) continue;
      all.push_back(&individual);
    }
    return all;
  }

  std::vector<Individual> first_generation() {
    std::vector<Individual> born;
    born.reserve(static_cast<std::size_t>(plan_.survivors));
    for (int i = 0; i < plan_.survivors; ++i) born.push_back(random_individual());
    return born;
  }

  std::vector<Individual> children_and_newcomers() {
    for (Survivor& survivor : survivors_) ++survivor.member.age;
    std::vector<const Survivor*> parents;
    parents.reserve(survivors_.size());
    for (const Survivor& survivor : survivors_) parents.push_back(&survivor);
    if (!plan_.map_elites) variation_.shuffle(parents);
    std::vector<Individual> born;
    for (std::size_t i = 0; i < static_cast<std::size_t>(plan_.mutants); ++i)
      born.push_back(child(*parents[plan_.map_elites ? variation_.below(parents.size()) : i % parents.size()]));
    for (int i = 0; i < plan_.newcomers; ++i) born.push_back(random_individual());
    return born;
  }

  Individual child(const Survivor& parent) {
    Offspring offspring = child_of(parent.individual.genome, parent.individual.phenotype, plan_.offspring, variation_,
                                   [this](const Phenotype& phenotype) { return is_redrawn(phenotype); });
    return individual_from(std::move(offspring), parent.member.id, parent.member.age);
  }

  Individual random_individual() {
    Offspring offspring = random_offspring(plan_.offspring, variation_);
    for (std::size_t tries = 1; tries < plan_.offspring.largest_tries && is_redrawn(offspring.phenotype); ++tries)
      offspring = random_offspring(plan_.offspring, variation_);
    return individual_from(std::move(offspring), std::nullopt, 0);
  }

  Individual individual_from(Offspring offspring, std::optional<std::uint64_t> parent, int age) {
    if (plan_.duplicates == DuplicatePolicy::redrawn) born_.insert(simulated_key(offspring.phenotype));
    return {next_id_++, next_generation_, parent, age, std::move(offspring.genome), std::move(offspring.phenotype)};
  }

  /// Returns whether a new individual with this phenotype is to be another one, as an earlier one has the same.
  [[nodiscard]] bool is_redrawn(const Phenotype& phenotype) const {
    if (plan_.duplicates != DuplicatePolicy::redrawn) return false;
    const std::string key = simulated_key(phenotype);
    return phenotypes_.contains(key) || born_.contains(key);
  }

  /// Returns the ids of the survivors, in order. Without niches all survive in generation 0.
  std::vector<std::uint64_t> select(const std::vector<PoolMember>& pool, const Selection& selection) {
    if (next_generation_ > 0 || plan_.map_elites) return selection.select(pool, selection_);
    std::vector<std::uint64_t> all;
    all.reserve(pool.size());
    for (const PoolMember& member : pool) all.push_back(member.id);
    return all;
  }

  /// Checks the time step on the elites if this generation is due. @return false if it was stopped
  bool check_steps(const std::vector<Survivor>& survivors) {
    if (!checking_ || !checking_->is_due(next_generation_)) return true;
    return checking_->check(next_generation_, survivors, options_, &commits_);
  }

  io::RunStatus commit(const PoolEvaluation& pool, const Selection& selection, const std::vector<Individual>& born,
                       const ScreeningRound& screened, Clock::time_point start) {
    std::vector<PoolMember> members = pool.pool();
    const std::vector<std::uint64_t> selected = select(members, selection);
    std::vector<Survivor> survivors;
    for (std::size_t rank = 0; rank < selected.size(); ++rank) {
      const auto found = std::ranges::find(members, selected[rank], &PoolMember::id);
      found->survivor_rank = rank;
      survivors.push_back({individual_of(selected[rank], born), *found});
    }
    // This comes before the generation counts as finished: if it is stopped here, a resumed search does the rest.
    if (!check_steps(survivors)) return io::RunStatus::stopped;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const EvaluationCounts counts = pool.counts();
    const GenerationRecord record{next_generation_, counts.evaluations,   counts.cached,       counts.pruned,
                                  seconds,          variation_.to_text(), selection_.to_text()};
    archive_.add_generation(record, born, members, screened.individuals);
    survivors_ = std::move(survivors);
    ++commits_;
    if (options_.generation_done) options_.generation_done(record);
    if (options_.after_commit) options_.after_commit(commits_);
    return io::RunStatus::completed;
  }

  [[nodiscard]] const Individual& individual_of(std::uint64_t id, const std::vector<Individual>& born) const {
    const auto found = std::ranges::find(born, id, &Individual::id);
    if (found != born.end()) return *found;
    return std::ranges::find(survivors_, id, [](const Survivor& survivor) { return survivor.individual.id; })->individual;
  }

  const SearchPlan& plan_;
  const DesignEvaluator& evaluator_;
  RunArchive& archive_;
  const SearchOptions& options_;
  std::optional<StepChecking> checking_;
  std::optional<Screening> screening_;
  RandomStream variation_;
  RandomStream selection_;
  std::vector<Survivor> survivors_;             ///< by rank
  std::unordered_set<std::string> phenotypes_;  ///< of generations that have begun to be evaluated
  std::unordered_set<std::string> born_;        ///< of the one that is being made; only where duplicates are redrawn
  int next_generation_ = 0;
  std::uint64_t next_id_ = 0;
  std::size_t commits_ = 0;
};

}  // namespace

io::RunStatus SearchOptions::evaluate(const DesignEvaluator& evaluator, std::span<const EvaluationTask> tasks,
                                      const Workers::Finished& finished) const {
  if (workers != nullptr) return workers->run(evaluator, tasks, stop, finished);
  return WorkerPool(threads).run(evaluator, tasks, stop, finished);
}

io::RunStatus run_search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                         const SearchOptions& options, const DesignEvaluator* half_step, const DesignEvaluator* surrogate) {
  if (plan.selection_time == SelectionTime::steady_state) return run_steady_search(plan, evaluator, archive, options);
  return Search(plan, evaluator, archive, options, half_step, surrogate).run();
}

}  // namespace menger::evolution
