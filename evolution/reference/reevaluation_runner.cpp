#include "evolution/reference/reevaluation_runner.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "evolution/reference/reevaluation_surrogate.h"
#include "fem/elements/element_kernel.h"
#include "fem/locomotion/locomotion_result.h"
#include "io/process/file_lock.h"
#include "io/process/side_by_side.h"
#include "io/ranks/roll_call.h"
#include "io/text/content_hash.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "calls.toml";
constexpr const char* result_folder = "result";

/// The state of a run after all calls so far.
struct Calls {
  bool is_finished = false;   ///< the run ended with a result
  double seconds = 0.0;       ///< wall time of all calls together
  double time_limit_s = 0.0;  ///< the limit that the last call exceeded; 0 if it did not
};

Calls read_calls(const fs::path& folder) {
  Calls calls;
  if (!io::is_file(folder / record_name)) return calls;
  try {
    const io::TomlTable table = io::read_toml(folder / record_name);
    calls = {.is_finished = table.boolean("finished"),
             .seconds = table.number("seconds", io::non_negative()),
             .time_limit_s = table.number("time_limit_s", io::non_negative())};
  } catch (const io::InputError&) {  // as if there had been no call: the run can be repeated
  }
  return calls;
}

void write_calls(const fs::path& folder, const Calls& calls) {
  io::write_whole(folder / record_name, std::string("finished = ") + (calls.is_finished ? "true" : "false") +
                                            "\nseconds = " + io::number_text(calls.seconds) +
                                            "\ntime_limit_s = " + io::number_text(calls.time_limit_s) + "\n");
}

void take(const fem::LocomotionResult& result, LocomotionRun& run) {
  run.status = result.status;
  run.reason = result.reason;
  run.time_s = result.time_s;
  run.steps = result.steps;
  run.elements = result.elements;
  run.seconds = result.seconds;
  for (const fem::WalkRecord& record : result.records)
    run.trajectory.push_back({.time_s = record.time_s, .centre_of_mass_m = record.centre_of_mass_m, .energy = {}});
  if (const auto travel = fem::travel_of(result)) run.displacement_m = travel->displacement_m;
}

/// Reads a result. If it cannot be read, only this run fails.
void read_or_fail(LocomotionRun& run) {
  try {
    take(fem::read_locomotion_result(run.folder), run);
  } catch (const io::InputError& error) {
    run.status.reset();
    run.reason = error.what();
  }
}

/// Ends a run that exceeded its time limit.
void mark_limit(LocomotionRun& run, double time_limit_s, double seconds) {
  run.status = io::RunStatus::stopped;
  run.displacement_m.reset();
  run.seconds = seconds;
  run.reason = "time limit of " + io::number_text(time_limit_s) + " s";
}

/// Does the same for a run of an earlier call.
void end_by_limit(LocomotionRun& run, double time_limit_s, double seconds) {
  read_or_fail(run);
  mark_limit(run, time_limit_s, seconds);
}

/// Returns the hash of this program, because another build may give another result.
const std::string& program_hash() {
  static const std::string hash = io::file_hash("/proc/self/exe");
  return hash;
}

/// Returns a text that is the same for equal jobs only.
std::string key_of(const LocomotionJob& job) { return fem::locomotion_text(job.study); }

/// Returns the folder of a job; empty if nothing is kept.
fs::path folder_of(const LocomotionJob& job, const fs::path& runs) {
  constexpr std::size_t digits = 16;
  if (runs.empty()) return {};
  return fs::absolute(runs / io::content_hash(program_hash() + "\n" + key_of(job)).substr(0, digits));
}

/// How a call of a walker ended.
struct Call {
  LocomotionRun run;
  bool is_timed_out = false;
  bool is_stopped = false;  ///< by the user
  double seconds = 0.0;
};

/// Lets a walker walk in a thread of its own, and watches the time meanwhile.
Call call_walker(const LocomotionJob& job, const fs::path& folder, double time_limit_s, const LocomotionRunOptions& options,
                 const std::function<void()>& waiting) {
  const auto start = std::chrono::steady_clock::now();
  Call call;
  std::atomic<bool> ends{false};
  auto walked = std::async(std::launch::async, [&] { return options.walker(job, folder, ends); });
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const std::chrono::duration<double> pause(std::min(0.1, 0.5 * time_limit_s));
  while (walked.wait_for(pause) != std::future_status::ready) {
    waiting();
    call.is_stopped = options.stop != nullptr && *options.stop;
    call.is_timed_out = !call.is_stopped && seconds() >= time_limit_s;
    if (call.is_stopped || call.is_timed_out) ends = true;
  }
  try {
    const fem::LocomotionResult result = walked.get();
    take(result, call.run);
    if (!folder.empty()) {
      fem::trajectory_table(result).write(folder / result_folder / "trajectory.csv");
      io::write_whole(folder / result_folder / "locomotion.toml", fem::result_text(result));
    }
  } catch (const io::InputError& error) {
    call.run.is_refused = true;
    call.run.reason = error.what();
  } catch (const std::exception& error) {  // such as lack of memory, which need not end the others
    call.run.reason = error.what();
  }
  // A walk that ended by itself just then counts.
  if (call.run.status != io::RunStatus::stopped) call.is_stopped = call.is_timed_out = false;
  call.seconds = seconds();
  return call;
}

/// Returns a run of a folder that need not be made, if there is one: it has a result, or exceeded such a time limit.
std::optional<LocomotionRun> ended_run(const fs::path& folder, double time_limit_s) {
  LocomotionRun found;
  found.folder = folder / result_folder;
  const Calls calls = read_calls(folder);
  if (calls.is_finished) {
    read_or_fail(found);
    if (!found.status) return std::nullopt;  // its files are damaged or missing
    return found;
  }
  if (calls.time_limit_s < time_limit_s) return std::nullopt;
  end_by_limit(found, calls.time_limit_s, calls.seconds);
  return found;
}

/// The folders of a job, of which all but the first are needed only while other processes walk in those before: a rank that was
/// thought to be lost may still do so.
fs::path numbered(const fs::path& first, int number) {
  return number == 1 ? first : fs::path(first.string() + "_" + std::to_string(number));
}

/// Makes a run in a folder that no other process uses; empty: it keeps nothing. @return nothing if the user stopped it
std::optional<LocomotionRun> make_run(const LocomotionJob& job, const fs::path& folder, const LocomotionRunOptions& options,
                                      const std::function<void()>& waiting) {
  Calls calls = folder.empty() ? Calls{} : read_calls(folder);
  if (calls.is_finished) calls = {};  // but it cannot be read
  Call call = call_walker(job, folder, std::max(1e-3, options.time_limit_s - calls.seconds), options, waiting);
  calls.seconds += call.seconds;
  calls.is_finished = call.run.status && *call.run.status != io::RunStatus::stopped;
  calls.time_limit_s =
      call.is_timed_out ? options.time_limit_s : 0.0;  // a run that the user stopped may be resumed under any limit
  if (!folder.empty()) write_calls(folder, calls);
  if (call.is_stopped) return std::nullopt;
  if (!folder.empty()) call.run.folder = folder / result_folder;
  call.run.is_repeated = true;
  if (call.is_timed_out) mark_limit(call.run, options.time_limit_s, calls.seconds);
  if (!call.run.status) call.run.seconds = calls.seconds;
  return call.run;
}

/// Runs one job, or finds its result from an earlier call or another rank. @return nothing if the user stopped it
std::optional<LocomotionRun> run_locomotion(const LocomotionJob& job, const LocomotionRunOptions& options,
                                            const std::function<void()>& waiting) {
  const fs::path first = folder_of(job, options.runs);
  if (first.empty()) return make_run(job, first, options, waiting);
  for (int number = 1; fs::exists(numbered(first, number)); ++number)
    if (auto found = ended_run(numbered(first, number), options.time_limit_s)) return found;
  for (int number = 1;; ++number) {
    const fs::path folder = numbered(first, number);
    const std::optional<io::FileLock> lock = io::FileLock::if_free(folder);
    if (!lock) continue;
    if (auto found = ended_run(folder, options.time_limit_s)) return found;  // of a process that had the lock until now
    return make_run(job, folder, options, waiting);
  }
}

}  // namespace

std::string_view status_word(const LocomotionRun& run) { return run.status ? io::to_string(*run.status) : "failed"; }

void leave_out(LocomotionRun& run, double until_s) {
  if (until_s <= 0.0 || !run.displacement_m || until_s <= run.trajectory.front().time_s) return;
  run.left_out_m = voxel::displacement_m(run.trajectory, voxel::point_at(run.trajectory, until_s));
  for (std::size_t axis = 0; axis < 3; ++axis) run.displacement_m->at(axis) -= run.left_out_m->at(axis);
}

void measure_as_search(const ReevaluationStudy& study, LocomotionRun& run) {
  const auto last = measured_periods(study.search);
  if (!last) return leave_out(run, study.measure_from_s);
  if (!run.displacement_m) return;
  // read_reevaluation_study refuses a time with fewer periods than are measured
  const auto steady_m = steady_displacement_m(period_displacements_m(run.trajectory, last->period_s, study.duration_s), *last);
  run.left_out_m = run.displacement_m;
  run.displacement_m = steady_m.value();
  for (std::size_t axis = 0; axis < 3; ++axis) run.left_out_m->at(axis) -= run.displacement_m->at(axis);
}

Evaluation evaluation_of(const LocomotionRun& run) {
  Evaluation result;
  result.status = run.status.value_or(io::RunStatus::stopped);
  result.displacement_m = run.displacement_m;
  result.left_out_m = run.left_out_m;
  result.reason = run.reason;
  result.steps = run.steps;
  result.seconds = run.seconds;
  return result;
}

void require_accepted(std::span<const LocomotionRun> runs) {
  if (std::ranges::all_of(runs, &LocomotionRun::is_refused))
    throw io::InputError("finite elements refused every design, the first: " + runs.front().reason);
}

namespace {

/// The runs of jobs, of which equal ones are made once.
struct DifferentJobs {
  explicit DifferentJobs(std::span<const LocomotionJob> jobs) {
    for (std::size_t n = 0; n < jobs.size(); ++n) {
      if (place_of.emplace(key_of(jobs[n]), first.size()).second) first.push_back(n);
    }
  }

  std::map<std::string, std::size_t> place_of;
  std::vector<std::size_t> first;  ///< of equal jobs
};

/// Returns a run as another rank tells it to the first one, which finds the rest in the folder of the run.
std::string bytes_of(const LocomotionRun& run) {
  std::string bytes;
  nlohmann::json::to_cbor({run.status.has_value(), run.is_refused, run.is_repeated, run.seconds, run.reason}, bytes);
  return bytes;
}

/// Makes a run on any rank. Jobs are told by their place among different ones. @return empty if it was stopped
io::RankWork run_of(std::span<const LocomotionJob> jobs, const DifferentJobs& different, const LocomotionRunOptions& options) {
  return [jobs, &different, &options](const std::string& task, const std::atomic<bool>& stop, const std::function<int()>&) {
    LocomotionRunOptions here = options;
    here.stop = &stop;
    const auto run = run_locomotion(jobs[different.first.at(std::stoul(task))], here, [] {});
    return run ? bytes_of(*run) : std::string();
  };
}

/// Returns what must be the same on all ranks.
io::RankFacts facts_of(const DifferentJobs& different, const LocomotionRunOptions& options) {
  std::string texts;
  for (const auto& [text, place] : different.place_of) texts += std::to_string(place) + "\n" + text;
  return io::facts_of(*options.ranks, options.jobs,
                      {{"re-evaluation", texts}, {"instruction set", std::string(fem::best_element_kernels().instruction_set)}});
}

/// Lets all ranks make the runs. @return whether all were made
bool share_runs(std::span<const LocomotionJob> jobs, const DifferentJobs& different, const LocomotionRunOptions& options,
                std::vector<LocomotionRun>& made, const std::function<void(std::size_t, const std::string&)>& tell) {
  std::vector<io::RankFacts> facts = io::call_roll(*options.ranks, facts_of(different, options), options.rank_patience_s);
  if (facts.empty()) return false;
  io::RankTeam team(*options.ranks, run_of(jobs, different, options), std::move(facts),
                    {.threads = options.jobs, .patience_s = options.rank_patience_s, .note = options.note});
  std::vector<std::string> tasks;
  for (std::size_t n = 0; n < different.first.size(); ++n) tasks.push_back(std::to_string(n));
  bool is_whole = true;
  const io::RunStatus status = team.run(std::move(tasks), options.stop, [&](std::size_t n, const std::string& bytes) {
    if (bytes.empty()) {  // stopped
      is_whole = false;
      return std::vector<std::string>();
    }
    const nlohmann::json told = nlohmann::json::from_cbor(bytes);
    const LocomotionJob& job = jobs[different.first[n]];
    const bool has_status = told.at(0);
    if (has_status) {
      // Its files are there, so that it is read and not made.
      auto run = run_locomotion(job, options, [] {});
      if (!run) {
        is_whole = false;
        return std::vector<std::string>();
      }
      made[n] = std::move(*run);
    } else {
      made[n].folder = folder_of(job, options.runs) / result_folder;
      made[n].is_refused = told.at(1);
      made[n].seconds = told.at(3);
      made[n].reason = told.at(4);
    }
    made[n].is_repeated = told.at(2);
    tell(1, job.name);
    return std::vector<std::string>();
  });
  if (options.note) options.note(team.shares());
  return is_whole && status == io::RunStatus::completed;
}

}  // namespace

std::optional<std::vector<LocomotionRun>> run_locomotions(std::span<const LocomotionJob> jobs,
                                                          const LocomotionRunOptions& options) {
  std::optional<io::FileLock> lock;
  if (!options.runs.empty()) {
    io::require_writable_folder(options.runs);
    lock.emplace(options.runs);
  }
  const DifferentJobs different(jobs);
  const std::vector<std::size_t>& first = different.first;
  std::vector<LocomotionRun> made(first.size());
  std::mutex mutex;
  std::size_t done = jobs.size() - first.size();
  const auto tell = [&](std::size_t finished, const std::string& name) {
    const std::scoped_lock guard(mutex);
    done += finished;
    if (options.progress) options.progress(done, name);
  };
  const auto make = [&](std::size_t n) {
    const LocomotionJob& job = jobs[first[n]];
    auto run = run_locomotion(job, options, [&] { tell(0, job.name); });
    if (!run) return false;
    made[n] = std::move(*run);
    tell(1, job.name);
    return true;
  };
  const bool is_shared = options.ranks != nullptr && options.ranks->count() > 1;
  const bool is_whole = is_shared ? share_runs(jobs, different, options, made, tell)
                                  : io::side_by_side(first.size(), options.jobs, options.stop, make);
  if (!is_whole) return std::nullopt;
  std::vector<LocomotionRun> runs;
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    const std::size_t place = different.place_of.at(key_of(jobs[n]));
    runs.push_back(made[place]);
    if (first[place] != n) runs.back().is_repeated = false;
  }
  return runs;
}

void serve_locomotions(std::span<const LocomotionJob> jobs, const LocomotionRunOptions& options) {
  const DifferentJobs different(jobs);
  io::answer_roll(*options.ranks, facts_of(different, options));
  io::serve_first_rank(*options.ranks, run_of(jobs, different, options),
                       {.threads = options.jobs, .patience_s = options.rank_patience_s});
}

void refuse_locomotions(io::RankSession& ranks, const std::string& reason) {
  io::answer_roll(ranks, {.threads = 1, .machine = io::RankSession::machine(), .error = reason});
}

}  // namespace menger::evolution
