#include "fem/load_cases/load_cases_on_ranks.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <numeric>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "io/process/child_program.h"
#include "io/process/exit_code.h"
#include "io/process/file_lock.h"
#include "io/ranks/roll_call.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::fem {

namespace {

namespace fs = std::filesystem;

/// What the program printed.
struct Printed {
  io::ChildOutcome outcome;
  std::string out;
  std::string err;
};

constexpr auto pause = std::chrono::milliseconds(20);

/// Returns how a rank is named in files. A case may be computed by two at once, if one was thought to be lost.
std::string name_in_files(const io::RankSession& ranks) {
  return "rank_" + std::to_string(ranks.rank()) + "_of_" + io::RankSession::machine();
}

/// Waits until no other rank keeps fields of a case. @return nothing if it was stopped
std::optional<io::FileLock> lock_of_fields(const RankedLoadCases& set, const std::string& name, const std::atomic<bool>& stop) {
  io::require_writable_folder(set.folder / "cache");
  while (!stop) {
    if (auto lock = io::FileLock::if_free(set.folder / "cache" / name)) return lock;
    std::this_thread::sleep_for(pause);
  }
  return std::nullopt;
}

/// Runs the program. @param name of two files in the folder of the cache, which are removed
Printed run_program_in(const RankedLoadCases& set, const std::string& name, std::vector<std::string> more,
                       const std::atomic<bool>* stop) {
  const fs::path out = fs::absolute(set.folder / "cache" / (name + ".out"));
  const fs::path err = fs::absolute(set.folder / "cache" / (name + ".err"));
  io::require_writable_folder(set.folder / "cache");
  std::vector<std::string> arguments{set.set.string(), "-o", set.folder.string()};
  arguments.insert(arguments.end(), set.options.begin(), set.options.end());
  arguments.insert(arguments.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  Printed printed;
  printed.outcome = io::run_child({.program = set.program,
                                   .arguments = std::move(arguments),
                                   .folder = fs::current_path(),
                                   .out = out,
                                   .err = err,
                                   .stop = stop});
  printed.out = io::read_whole(out);
  printed.err = io::read_whole(err);
  std::error_code ignored;
  fs::remove(out, ignored);
  fs::remove(err, ignored);
  return printed;
}

/// Returns whether the program had a result; a case that ended early is one.
bool has_result(const io::ChildOutcome& outcome) {
  return outcome.end == io::ChildEnd::exited &&
         (outcome.exit_code == io::exit_code::done || outcome.exit_code == io::exit_code::numerical);
}

constexpr const char* is_done = "done";

/// Computes a case on any rank. Cases are told by their place in the set.
io::RankWork case_of(const RankedLoadCases& set, const io::RankSession& ranks) {
  return [&set, files = name_in_files(ranks)](const std::string& task, const std::atomic<bool>& stop,
                                              const std::function<int()>&) -> std::string {
    const std::string& name = set.cases.at(std::stoul(task)).load_case.name;
    const std::optional<io::FileLock> lock = set.has_fields() ? lock_of_fields(set, name, stop) : std::nullopt;
    if (set.has_fields() && !lock) return "";
    const Printed printed = run_program_in(set, name + "." + files, {"--no-pictures", "--only", name}, &stop);
    if (printed.outcome.end == io::ChildEnd::stopped) return "";
    if (has_result(printed.outcome)) return is_done;
    throw io::InputError(name + ": " + (printed.err.empty() ? "its program ended without a result" : printed.err));
  };
}

io::RankFacts facts_of_set(const RankedLoadCases& set, const io::RankSession& ranks) {
  std::string texts;
  for (const CaseRequest& request : set.cases) texts += request.load_case.name + "\n" + case_text(request, set.material);
  return io::facts_of(ranks, 1, {{"set", texts}});
}

}  // namespace

double expected_cost(const CaseRequest& request) {
  const auto cells =
      static_cast<double>(std::ranges::count_if(request.load_case.digits, [](char digit) { return digit != '0'; }));
  const auto pressures =
      static_cast<double>(std::max({request.load_case.pressures_Pa.size(), request.pressure_fractions.size(), std::size_t{1}}));
  const auto imposed = static_cast<double>(request.load_case.imposed.size() + 1);
  return cells * pressures * imposed;
}

io::RunStatus compute_on_ranks(const RankedLoadCases& set, io::RankSession& ranks, const io::TeamOptions& options,
                               const std::atomic<bool>* stop, const std::function<void(std::size_t done)>& finished) {
  std::vector<io::RankFacts> facts = io::call_roll(ranks, facts_of_set(set, ranks), options.patience_s);
  if (facts.empty()) return io::RunStatus::stopped;
  std::vector<std::size_t> order(set.cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t n) { return expected_cost(set.cases[n]); });
  std::vector<std::string> tasks;
  tasks.reserve(order.size());
  for (const std::size_t n : order) tasks.push_back(std::to_string(n));
  bool is_whole = true;
  std::size_t done = 0;
  const auto take = [&](std::size_t, const std::string& result) {
    is_whole = is_whole && result == is_done;
    finished(++done);
    return std::vector<std::string>();
  };
  io::RankTeam team(ranks, case_of(set, ranks), std::move(facts), options);
  const io::RunStatus status = team.run(std::move(tasks), stop, take);
  if (options.note) options.note(team.shares());
  return is_whole ? status : io::RunStatus::stopped;
}

void compute_for_first_rank(const RankedLoadCases& set, io::RankSession& ranks, const io::TeamOptions& options) {
  io::answer_roll(ranks, facts_of_set(set, ranks));
  io::serve_first_rank(ranks, case_of(set, ranks), options);
}

int finish_set(const RankedLoadCases& set, const std::atomic<bool>* stop) {
  const Printed printed = run_program_in(set, "all", {}, stop);
  std::cout << printed.out;
  std::cerr << printed.err;
  if (printed.outcome.end == io::ChildEnd::stopped) return io::exit_code::interrupted;
  return printed.outcome.end == io::ChildEnd::exited ? printed.outcome.exit_code : 1;
}

}  // namespace menger::fem
