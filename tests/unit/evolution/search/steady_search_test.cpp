#include "evolution/search/steady_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "evolution/ranks/rank_workers.h"
#include "tests/support/archive_content.h"
#include "tests/support/fake_evaluator.h"
#include "tests/support/input_error_message.h"
#include "tests/support/search_fixture.h"
#include "tests/support/wait_until.h"

namespace menger::evolution {
namespace {

using test_support::archive_content;
using test_support::FakeEvaluator;

/// The threads of this process, as a stream of a search on ranks has them.
class Threads {
 public:
  Threads(const DesignEvaluator& evaluator, int count)
      : team_(session_, work(), {io::facts_of(session_, count, {})}, {.threads = count}) {
    shared_.add(evaluator);
  }

  [[nodiscard]] const TaskStream* stream() const { return &workers_; }

 private:
  [[nodiscard]] io::RankWork work() const {
    return [this](const std::string& task, const std::atomic<bool>& stop, const ThreadsNow& threads) {
      return shared_.evaluate(task, stop, threads);
    };
  }

  SharedEvaluators shared_;
  io::RankSession session_;
  io::RankTeam team_;
  RankWorkers workers_{team_, shared_};
};

SearchPlan steady_plan() {
  SearchPlan plan = tests::small_plan();
  plan.selection_time = SelectionTime::steady_state;
  plan.pruning = false;
  plan.newcomers = 2;
  plan.offspring.constraints.levels = {1, 2};
  return plan;
}

class SteadySearches : public tests::SearchFixture {
 protected:
  /// An evaluator whose evaluations take times that differ, so that results come in another order every time.
  static FakeEvaluator::Options uneven() {
    return {.failing = 0.1, .before_result = [](std::uint64_t call) {
              std::this_thread::sleep_for(std::chrono::microseconds(call * 7919 % 13 * 100));
            }};
  }

  io::RunStatus steadily(const std::string& name, const SearchPlan& plan, int threads, SearchOptions options = {}) {
    const FakeEvaluator evaluator(uneven());
    const Threads workers(evaluator, threads);
    options.stream = workers.stream();
    RunArchive archive = open(name);
    return run_search(plan, evaluator, archive, options);
  }

  [[nodiscard]] std::vector<SearchEvent> events(const std::string& name) const {
    return RunArchive::open_to_read(file(name)).events();
  }
};

TEST_F(SteadySearches, HaveAsManyResultsInAGenerationAsOthers) {
  const SearchPlan plan = steady_plan();
  ASSERT_EQ(steadily("run", plan, 4), io::RunStatus::completed);
  const RunArchive archive = RunArchive::open_to_read(file("run"));
  ASSERT_EQ(archive.last_generation(), 6);
  std::set<std::uint64_t> seen;
  for (int generation = 0; generation <= 6; ++generation) {
    const std::vector<PoolMember> pool = archive.pool(generation);
    EXPECT_EQ(archive.survivors(generation).size(), 6U);
    std::size_t ended = 0;
    for (const PoolMember& member : pool) {
      const Individual individual = archive.individual(member.id);
      if (individual.generation != generation) continue;
      ++ended;
      EXPECT_TRUE(seen.insert(member.id).second);
      if (!individual.parent) {
        EXPECT_EQ(individual.age, 0);
      }
      EXPECT_NE(member.knowledge, Knowledge::bounded);
    }
    EXPECT_EQ(ended, generation == 0 ? 6U : 8U);
    EXPECT_EQ(pool.size(), generation == 0 ? 6U : 14U) << "with the survivors before";
    const GenerationRecord record = archive.generation(generation);
    EXPECT_EQ(record.evaluations + record.cached, 2 * ended) << "two levels each";
    EXPECT_EQ(record.pruned, 0U);
  }
  EXPECT_EQ(seen.size(), 6U + 6U * 8U);
  EXPECT_EQ(*seen.rbegin(), 53U) << "no robot is born that does not end";
}

TEST_F(SteadySearches, AgeByOneInAGeneration) {
  ASSERT_EQ(steadily("run", steady_plan(), 1), io::RunStatus::completed);
  const RunArchive archive = RunArchive::open_to_read(file("run"));
  std::map<std::uint64_t, int> ages;
  for (int generation = 0; generation <= 6; ++generation) {
    for (const PoolMember& member : archive.survivors(generation)) {
      const auto before = ages.find(member.id);
      if (before != ages.end()) {
        EXPECT_EQ(member.age, before->second + 1);
      } else if (generation == 0) {
        EXPECT_EQ(member.age, 0);
      }
    }
    ages.clear();
    for (const PoolMember& member : archive.survivors(generation)) ages[member.id] = member.age;
  }
}

TEST_F(SteadySearches, HaveParentsThatHaveEndedAndRandomRobotsAtTheRateOfOthers) {
  ASSERT_EQ(steadily("run", steady_plan(), 3), io::RunStatus::completed);
  const RunArchive archive = RunArchive::open_to_read(file("run"));
  std::set<std::uint64_t> ended;
  std::size_t random = 0;
  for (const SearchEvent& event : events("run")) {
    if (!event.is_birth) {
      ended.insert(event.individual);
      continue;
    }
    const Individual individual = archive.individual(event.individual);
    EXPECT_TRUE(!individual.parent || ended.contains(*individual.parent));
    const bool is_random = event.individual < 6 || (event.individual - 6) % 8 >= 6;
    EXPECT_EQ(!individual.parent, is_random) << event.individual;
    if (is_random) ++random;
  }
  EXPECT_EQ(random, 6U + 6U * 2U);
}

TEST_F(SteadySearches, FollowFromTheOrderOfResultsAlone) {
  const SearchPlan plan = steady_plan();
  for (int times = 0; times < 3; ++times) {
    const std::string name = "run_" + std::to_string(times);
    ASSERT_EQ(steadily(name, plan, 4), io::RunStatus::completed);
    for (const int threads : {1, 3}) {
      const std::string again = name + "_again_" + std::to_string(threads);
      SearchOptions options;
      options.replayed = events(name);
      ASSERT_EQ(steadily(again, plan, threads, options), io::RunStatus::completed);
      EXPECT_EQ(archive_content(file(again)), archive_content(file(name))) << threads << " threads";
    }
  }
}

TEST_F(SteadySearches, DifferIfTheOrderOfResultsDoes) {
  ASSERT_EQ(steadily("one", steady_plan(), 1), io::RunStatus::completed);
  ASSERT_EQ(steadily("four", steady_plan(), 4), io::RunStatus::completed);
  EXPECT_NE(events("one"), events("four"));
  EXPECT_NE(archive_content(file("one")), archive_content(file("four")));
}

TEST_F(SteadySearches, OfOneThreadGoOnAfterStopsAsIfThereHadBeenNone) {
  SearchPlan plan = steady_plan();
  plan.generations = 3;
  std::size_t commits = 0;
  SearchOptions counting;
  counting.after_commit = [&](std::size_t count) { commits = count; };
  ASSERT_EQ(steadily("whole", plan, 1, counting), io::RunStatus::completed);
  const std::string expected = archive_content(file("whole"));
  for (std::size_t last = 1; last + 1 < commits; last += 4) {
    const std::string name = "stopped_" + std::to_string(last);
    std::atomic<bool> stop{false};
    SearchOptions options;
    options.stop = &stop;
    options.after_commit = [&](std::size_t count) { stop = count >= last; };
    ASSERT_EQ(steadily(name, plan, 1, options), io::RunStatus::stopped) << last;
    ASSERT_EQ(steadily(name, plan, 1), io::RunStatus::completed);
    EXPECT_EQ(archive_content(file(name)), expected) << "stopped after commit " << last;
  }
}

TEST_F(SteadySearches, OfManyThreadsGoOnAfterStopsAndCanBeReplayed) {
  const SearchPlan plan = steady_plan();
  for (const std::size_t stride : {4U, 19U}) {
    const std::string name = "stopped_" + std::to_string(stride);
    int calls = 0;
    io::RunStatus status = io::RunStatus::stopped;
    while (status == io::RunStatus::stopped && ++calls < 200) {
      std::atomic<bool> stop{false};
      SearchOptions options;
      options.stop = &stop;
      options.after_commit = [&](std::size_t count) { stop = count >= stride; };
      const std::vector<SearchEvent> before = RunArchive::open(file(name), "a study", 1).events();
      status = steadily(name, plan, 1 + calls % 4, options);
      const std::vector<SearchEvent> after = events(name);
      ASSERT_GE(after.size(), before.size());
      EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << "what has happened stays";
    }
    ASSERT_EQ(status, io::RunStatus::completed);
    SearchOptions replaying;
    replaying.replayed = events(name);
    ASSERT_EQ(steadily(name + "_again", plan, 2, replaying), io::RunStatus::completed);
    EXPECT_EQ(archive_content(file(name + "_again")), archive_content(file(name)));
  }
}

TEST_F(SteadySearches, GoOnWithWhatTheyHaveIfItIsMoreThanTheReplayedOrder) {
  const SearchPlan plan = steady_plan();
  const auto stopped_after = [&](const std::string& name, std::size_t last, SearchOptions options) {
    std::atomic<bool> stop{false};
    options.stop = &stop;
    options.after_commit = [&](std::size_t count) { stop = count >= last; };
    EXPECT_EQ(steadily(name, plan, 4, options), io::RunStatus::stopped);
  };
  stopped_after("part", 10, {});
  SearchOptions replaying;
  replaying.replayed = events("part");
  stopped_after("again", 30, replaying);
  const std::vector<SearchEvent> before = events("again");
  ASSERT_GT(before.size(), replaying.replayed.size());
  ASSERT_EQ(steadily("again", plan, 4, replaying), io::RunStatus::completed);
  const std::vector<SearchEvent> after = events("again");
  EXPECT_EQ(std::vector<SearchEvent>(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(before.size())), before);
  SearchOptions whole;
  whole.replayed = after;
  ASSERT_EQ(steadily("third", plan, 2, whole), io::RunStatus::completed);
  EXPECT_EQ(archive_content(file("third")), archive_content(file("again")));
}

TEST_F(SteadySearches, GoOnWithMoreGenerations) {
  SearchPlan plan = steady_plan();
  plan.generations = 2;
  ASSERT_EQ(steadily("run", plan, 3), io::RunStatus::completed);
  plan.generations = 6;
  ASSERT_EQ(steadily("run", plan, 3), io::RunStatus::completed);
  EXPECT_EQ(RunArchive::open_to_read(file("run")).last_generation(), 6);
  SearchOptions replaying;
  replaying.replayed = events("run");
  ASSERT_EQ(steadily("again", plan, 2, replaying), io::RunStatus::completed);
  EXPECT_EQ(archive_content(file("again")), archive_content(file("run")));
}

TEST_F(SteadySearches, TellTheProgressOfGenerationsThatAreNotFinished) {
  SearchPlan plan = steady_plan();
  plan.generations = 2;
  ASSERT_EQ(steadily("run", plan, 2), io::RunStatus::completed);
  plan.generations = 4;
  std::set<int> told;
  SearchOptions options;
  options.progress = [&](const SearchProgress& progress) { told.insert(progress.generation); };
  ASSERT_EQ(steadily("run", plan, 2, options), io::RunStatus::completed);
  EXPECT_EQ(told, (std::set<int>{3, 4})) << "not of those that are made again";
}

TEST_F(SteadySearches, EndWhereTheyAreToldToAndGoOnFromThere) {
  const SearchPlan plan = steady_plan();
  SearchOptions options;
  options.ends_with = [](int generation) { return generation == 2; };
  ASSERT_EQ(steadily("run", plan, 3, options), io::RunStatus::completed);
  EXPECT_EQ(RunArchive::open_to_read(file("run")).last_generation(), 2);
  ASSERT_EQ(steadily("run", plan, 3), io::RunStatus::completed);
  EXPECT_EQ(RunArchive::open_to_read(file("run")).last_generation(), 6);
}

TEST_F(SteadySearches, WaitForNoSlowRobot) {
  std::atomic<bool> is_last{false};
  std::atomic<bool> was_last{true};
  // The first evaluation ends only when the last generation has begun.
  const FakeEvaluator evaluator({.failing = 0.1, .before_result = [&](std::uint64_t call) {
                                   if (call == 1) was_last = test_support::wait_until([&] { return is_last.load(); });
                                 }});
  const Threads workers(evaluator, 2);
  SearchOptions options;
  options.stream = workers.stream();
  options.generation_done = [&](const GenerationRecord& record) { is_last = record.number == 5; };
  RunArchive archive = open("run");
  ASSERT_EQ(run_search(steady_plan(), evaluator, archive, options), io::RunStatus::completed);
  EXPECT_TRUE(was_last);
  EXPECT_EQ(std::max(archive.individual(0).generation, archive.individual(1).generation), 6) << "in which it ended";
}

TEST_F(SteadySearches, CullDuplicatesIfAsked) {
  SearchPlan plan = steady_plan();
  plan.duplicates = DuplicatePolicy::culled;
  plan.offspring.constraints.levels = {1};
  plan.generations = 40;
  ASSERT_EQ(steadily("run", plan, 4), io::RunStatus::completed);
  const RunArchive archive = RunArchive::open_to_read(file("run"));
  std::map<std::string, std::uint64_t> first;
  for (std::uint64_t id = 0; id < archive.next_id(); ++id) first.try_emplace(phenotype_key(archive.individual(id).phenotype), id);
  std::size_t culled = 0;
  for (int generation = 0; generation <= 40; ++generation) {
    for (const PoolMember& member : archive.pool(generation)) {
      const bool is_first = first.at(phenotype_key(archive.individual(member.id).phenotype)) == member.id;
      EXPECT_EQ(member.knowledge == Knowledge::duplicate, !is_first) << member.id;
      if (!is_first) ++culled;
    }
  }
  EXPECT_GT(culled, 0U);
}

TEST_F(SteadySearches, RefuseAnOrderThatIsNotTheirs) {
  const SearchPlan plan = steady_plan();
  ASSERT_EQ(steadily("run", plan, 2), io::RunStatus::completed);
  std::vector<SearchEvent> order = events("run");
  const auto replay = [&](const std::string& name) {
    SearchOptions options;
    options.replayed = order;
    return tests::message_of([&] { (void)steadily(name, plan, 2, options); });
  };
  std::swap(order[0], order[1]);
  EXPECT_NE(replay("births").find("robot 1 is born too early or too late"), std::string::npos) << replay("births");
  std::swap(order[0], order[1]);
  const auto end = std::ranges::find(order, false, &SearchEvent::is_birth);
  end->individual = 50;
  EXPECT_NE(replay("ends").find("robot 50 ends without a result"), std::string::npos) << replay("ends");
  order = events("run");
  order.pop_back();
  ASSERT_EQ(steadily("other", plan, 1), io::RunStatus::completed);
  EXPECT_NE(replay("other").find("has another order of results"), std::string::npos) << replay("other");
}

}  // namespace
}  // namespace menger::evolution
