#include "evolution/search/steady_search.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "evolution/genome/random_stream.h"
#include "evolution/search/age_fitness_pareto.h"
#include "evolution/search/known_score.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"

namespace menger::evolution {

namespace {

using SteadyClock = std::chrono::steady_clock;

class SteadySearch {
 public:
  SteadySearch(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive, const SearchOptions& options)
      : plan_(plan),
        evaluator_(evaluator),
        archive_(archive),
        options_(options),
        physics_hash_(io::content_hash(evaluator.physics())),
        first_(static_cast<std::size_t>(plan.survivors)),
        later_(static_cast<std::size_t>(plan.mutants) + static_cast<std::size_t>(plan.newcomers)) {
    assert(plan.selection_time == SelectionTime::steady_state && options.stream != nullptr);
    assert(later_ > 0 && plan.scenarios == 1 && !plan.map_elites && !plan.screening && !plan.step_checks);
  }

  io::RunStatus run() {
    restore();
    advance();
    if (is_over_) return io::RunStatus::completed;
    const io::RunStatus status =
        options_.stream->run_stream(evaluator_, std::exchange(wanted_, {}), options_.stop,
                                    [this](std::size_t task, const Evaluation& result) { return take(task, result); });
    return is_over_ ? io::RunStatus::completed : status;
  }

 private:
  /// A robot that is under way, or in the population.
  struct Robot {
    Individual individual;
    Phenotype simulated;
    PoolMember member;           ///< its knowledge is `bounded` until it ends
    std::size_t lineage_at = 0;  ///< number of results at the birth of its first ancestor
    KnownResults results;
  };

  void restore() {
    archived_ = archive_.events();
    const std::vector<SearchEvent>& replayed = options_.replayed;
    const auto shared = static_cast<std::ptrdiff_t>(std::min(archived_.size(), replayed.size()));
    if (!std::equal(replayed.begin(), replayed.begin() + shared, archived_.begin()))
      throw io::InputError(archive_.file().string() + ": has another order of results than the one that is to be replayed");
    // The archive has more if it was replayed before, and went on.
    order_ = archived_.size() < replayed.size() ? replayed : archived_;
    last_generation_ = archive_.last_generation().value_or(-1);
    is_over_ = plan_.generations <= last_generation_;
  }

  [[noreturn]] void refuse_order(const std::string& what) const {
    throw io::InputError(archive_.file().string() +
                         ": the order of its results, or the one that is to be replayed, is not that of " +
                         "this search: " + what);
  }

  [[nodiscard]] EvaluationKey key_of(const Robot& robot, int level) const {
    return {design_hash(robot.simulated, level), level, physics_hash_};
  }

  [[nodiscard]] std::size_t results_of(int generations) const { return first_ + static_cast<std::size_t>(generations) * later_; }

  [[nodiscard]] int age_of(const Robot& robot) const {
    return static_cast<int>((std::max(ended_, first_) - std::max(robot.lineage_at, first_)) / later_);
  }

  [[nodiscard]] bool is_random(std::uint64_t id) const {
    return population_.empty() || id < first_ || (id - first_) % later_ >= static_cast<std::uint64_t>(plan_.mutants);
  }

  /// Takes a result. @return further tasks; nothing at the end of the search
  std::optional<std::vector<EvaluationTask>> take(std::size_t task, const Evaluation& result) {
    const EvaluationKey key = asked_.at(task);
    results_[key] = result;
    --outstanding_;
    const std::vector<std::uint64_t> robots = std::move(waiting_.extract(key).mapped());
    for (const std::uint64_t id : robots) go_on(under_way_.at(id));
    advance();
    if (is_over_) return std::nullopt;
    return std::exchange(wanted_, {});
  }

  /// Lets everything happen that can: what is known of the order first, and then what comes of itself.
  void advance() {
    while (!is_over_) {
      if (happened_ < order_.size()) {
        const auto [id, is_birth] = order_[happened_];
        if (!is_birth && under_way_.contains(id) && !complete_.contains(id) && happened_ >= archived_.size()) break;
        if (is_birth && id != next_id_) refuse_order("robot " + std::to_string(id) + " is born too early or too late");
        if (!is_birth && !complete_.contains(id)) refuse_order("robot " + std::to_string(id) + " ends without a result");
        is_birth ? give_birth() : end(id);
      } else if (!complete_.empty()) {
        end(*complete_.begin());
      } else if (next_id_ < results_of(plan_.generations) &&
                 outstanding_ < static_cast<std::size_t>(options_.stream->threads())) {
        give_birth();
      } else {
        break;
      }
    }
    keep();
  }

  void note(const SearchEvent& event) {
    if (happened_++ >= archived_.size()) new_events_.push_back(event);
  }

  void give_birth() {
    const std::uint64_t id = next_id_++;
    note({id, true});
    RandomStream random(plan_.seed, "steady state " + std::to_string(id));
    const Robot* const parent = is_random(id) ? nullptr : &population_[random.below(population_.size())];
    Offspring offspring = parent == nullptr
                              ? random_offspring(plan_.offspring, random)
                              : child_of(parent->individual.genome, parent->individual.phenotype, plan_.offspring, random);
    Robot robot;
    robot.individual.id = robot.member.id = id;
    robot.individual.genome = std::move(offspring.genome);
    robot.individual.phenotype = std::move(offspring.phenotype);
    robot.lineage_at = ended_;
    if (parent != nullptr) {
      robot.individual.parent = parent->individual.id;
      robot.individual.age = age_of(*parent);
      robot.lineage_at = parent->lineage_at;
    }
    robot.simulated = as_simulated(plan_, robot.individual.phenotype);
    const bool is_new = phenotypes_.insert(phenotype_key(robot.simulated)).second;
    robot.member.knowledge = Knowledge::bounded;
    if (!is_new && plan_.duplicates == DuplicatePolicy::culled) robot.member.knowledge = Knowledge::duplicate;
    if (is_penalised(robot.individual.phenotype, plan_.offspring.constraints)) robot.member.knowledge = Knowledge::penalised;
    go_on(under_way_.emplace(id, std::move(robot)).first->second);
  }

  /// Gives a robot the results that are known, and asks for the next one that is not.
  void go_on(Robot& robot) {
    const std::uint64_t id = robot.individual.id;
    while (robot.member.knowledge == Knowledge::bounded) {
      const std::optional<EvaluationStage> stage = next_stage(plan_, robot.results);
      if (!stage) break;
      EvaluationKey key = key_of(robot, stage->level);
      if (std::optional<Evaluation> known = known_result(key)) {
        robot.results[*stage] = std::move(*known);
        continue;
      }
      std::vector<std::uint64_t>& robots = waiting_[key];
      robots.push_back(id);
      if (robots.size() > 1) return;  // a robot of this design has asked for it
      wanted_.push_back({aggregate(robot.simulated, stage->level), stage->level, stage->scenario});
      asked_.push_back(std::move(key));
      ++outstanding_;
      return;
    }
    complete_.insert(id);
  }

  [[nodiscard]] std::optional<Evaluation> known_result(const EvaluationKey& key) const {
    if (const auto found = results_.find(key); found != results_.end()) return found->second;
    if (auto archived = archive_.evaluation(key)) return std::move(archived->result);
    return std::nullopt;
  }

  /// Lets a robot whose results are known join the population.
  void end(std::uint64_t id) {
    const bool is_archived = happened_ < archived_.size();
    note({id, false});
    complete_.erase(id);
    Robot robot = std::move(under_way_.extract(id).mapped());
    ++ended_;
    robot.individual.generation = generation_;
    for (const auto& [stage, result] : robot.results) {
      EvaluationKey key = key_of(robot, stage.level);
      const bool is_first = counted_.insert(key).second;
      ++(is_first ? evaluations_ : cached_);
      if (is_first && !is_archived) new_results_.emplace_back(std::move(key), ArchivedEvaluation{generation_, result});
    }
    if (robot.member.knowledge == Knowledge::bounded) {
      const KnownScore known = known_score(plan_, robot.results);
      robot.member.knowledge = known.is_failed ? Knowledge::failed : Knowledge::evaluated;
      if (!known.is_failed) robot.member.fitness = known.at_most;
    }
    robot.results.clear();
    new_individuals_.push_back(robot.individual);
    population_.insert(std::ranges::upper_bound(population_, id, {}, [](const Robot& one) { return one.individual.id; }),
                       std::move(robot));
    select();
    if (options_.progress && generation_ > last_generation_) {
      const std::size_t before = generation_ == 0 ? 0 : results_of(generation_ - 1);
      options_.progress({generation_, ended_ - before, results_of(generation_) - before});
    }
    if (ended_ == results_of(generation_)) finish_generation();
  }

  /// Returns the population at its present age.
  [[nodiscard]] std::vector<PoolMember> pool() {
    std::vector<PoolMember> all;
    for (Robot& robot : population_) {
      robot.member.age = age_of(robot);
      all.push_back(robot.member);
    }
    return all;
  }

  void select() {
    const std::vector<PoolMember> members = pool();
    for (const PoolMember& member : members) contenders_[member.id] = member;
    if (members.size() <= first_) return;
    RandomStream random(plan_.seed, "steady selection " + std::to_string(ended_));
    const std::vector<std::uint64_t> taken = select_survivors(members, first_, random);
    std::erase_if(population_, [&](const Robot& robot) { return std::ranges::find(taken, robot.individual.id) == taken.end(); });
  }

  void finish_generation() {
    keep();
    const std::vector<PoolMember> members = pool();
    const std::vector<std::size_t> order = selection_order(members, first_);
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      PoolMember& survivor = contenders_[members[order[rank]].id];
      survivor = members[order[rank]];
      survivor.survivor_rank = rank;
    }
    if (generation_ > last_generation_)
      add_generation();
    else
      check_generation();
    contenders_.clear();
    for (const PoolMember& member : members) contenders_[member.id] = member;
    new_individuals_.clear();
    evaluations_ = cached_ = 0;
    is_over_ = is_over_ || generation_ == plan_.generations;
    ++generation_;
  }

  void add_generation() {
    const double seconds = std::chrono::duration<double>(SteadyClock::now() - std::exchange(begun_, SteadyClock::now())).count();
    const GenerationRecord record{generation_, evaluations_, cached_, 0, seconds, "", ""};
    std::vector<PoolMember> members;
    for (const auto& [id, member] : contenders_) members.push_back(member);
    archive_.add_generation(record, new_individuals_, members);
    committed();
    if (options_.generation_done) options_.generation_done(record);
    is_over_ = options_.ends_with && options_.ends_with(generation_);
  }

  /// Checks a generation that is made again against the archive, which another program may have made.
  void check_generation() const {
    for (const Individual& individual : new_individuals_)
      if (archive_.individual(individual.id) != individual)
        refuse_order("robot " + std::to_string(individual.id) + " is another one than that of the archive");
  }

  /// Adds what has happened to the archive.
  void keep() {
    if (new_events_.empty()) return;
    archive_.add_events(new_events_, new_results_);
    for (const auto& [key, result] : new_results_) results_.erase(key);
    new_events_.clear();
    new_results_.clear();
    committed();
  }

  void committed() {
    ++commits_;
    if (options_.after_commit) options_.after_commit(commits_);
  }

  const SearchPlan& plan_;
  const DesignEvaluator& evaluator_;
  RunArchive& archive_;
  const SearchOptions& options_;
  std::string physics_hash_;
  std::size_t first_;  ///< results of generation 0
  std::size_t later_;  ///< results of every other one

  std::vector<SearchEvent> archived_;  ///< of the archive, at the start
  std::vector<SearchEvent> order_;     ///< that is followed, before anything comes of itself
  std::size_t happened_ = 0;           ///< events so far
  int last_generation_ = -1;           ///< of the archive, at the start

  std::uint64_t next_id_ = 0;
  std::size_t ended_ = 0;
  int generation_ = 0;
  bool is_over_ = false;
  std::map<std::uint64_t, Robot> under_way_;
  std::set<std::uint64_t> complete_;  ///< those under way whose results are known
  std::vector<Robot> population_;     ///< by id
  std::unordered_set<std::string> phenotypes_;

  std::vector<EvaluationTask> wanted_;                           ///< that nobody has been told of
  std::vector<EvaluationKey> asked_;                             ///< by task
  std::map<EvaluationKey, std::vector<std::uint64_t>> waiting_;  ///< robots, for results that were asked for
  std::map<EvaluationKey, Evaluation> results_;                  ///< that are not in the archive yet
  std::size_t outstanding_ = 0;                                  ///< tasks without a result

  // Of this generation.
  std::vector<Individual> new_individuals_;
  std::map<std::uint64_t, PoolMember> contenders_;
  std::uint64_t evaluations_ = 0;
  std::uint64_t cached_ = 0;
  SteadyClock::time_point begun_ = SteadyClock::now();

  std::set<EvaluationKey> counted_;
  std::vector<SearchEvent> new_events_;  ///< that are not in the archive yet
  std::vector<std::pair<EvaluationKey, ArchivedEvaluation>> new_results_;
  std::size_t commits_ = 0;
};

}  // namespace

io::RunStatus run_steady_search(const SearchPlan& plan, const DesignEvaluator& evaluator, RunArchive& archive,
                                const SearchOptions& options) {
  return SteadySearch(plan, evaluator, archive, options).run();
}

}  // namespace menger::evolution
