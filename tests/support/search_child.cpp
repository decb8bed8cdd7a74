// Runs a search with the fake evaluator in a process that can kill itself: search_child archive threads commit evaluation.
// It kills itself after the commit of that number, or in the evaluation of that number; 0: never. It prints how often the archive
// has grown.
#include <csignal>
#include <iostream>
#include <string>

#include "evolution/archive/run_archive.h"
#include "evolution/search/search.h"
#include "tests/support/fake_evaluator.h"

namespace {

using namespace menger::evolution;
using menger::test_support::FakeEvaluator;

SearchPlan small_plan() {
  SearchPlan plan;
  plan.seed = 7;
  plan.generations = 4;
  plan.survivors = 4;
  plan.mutants = 4;
  plan.offspring.constraints.levels = {1, 2};
  return plan;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const int threads = std::stoi(argv[2]);
  const std::size_t fatal_commit = std::stoul(argv[3]);
  const std::uint64_t fatal_evaluation = std::stoul(argv[4]);
  FakeEvaluator::Options fake;
  fake.before_result = [=](std::uint64_t call) {
    if (call == fatal_evaluation) raise(SIGKILL);
  };
  const FakeEvaluator evaluator(fake);
  const SearchPlan plan = small_plan();
  RunArchive archive = RunArchive::open(argv[1], "a small study", plan.generations);
  std::size_t commits = 0;
  SearchOptions options;
  options.threads = threads;
  options.after_commit = [&](std::size_t count) {
    commits = count;
    if (count == fatal_commit) raise(SIGKILL);
  };
  const auto status = run_search(plan, evaluator, archive, options);
  std::cout << commits << "\n";
  return status == menger::io::RunStatus::completed ? 0 : 1;
}
