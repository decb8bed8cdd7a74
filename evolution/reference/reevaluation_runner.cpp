#include "evolution/reference/reevaluation_runner.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

#include "fem/locomotion/locomotion_result.h"
#include "io/process/exit_code.h"
#include "io/process/file_lock.h"
#include "io/process/program_job.h"
#include "io/process/side_by_side.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "calls.toml";
constexpr const char* result_folder = "result";
constexpr const char* checkpoint_name = "locomotion.checkpoint";

/// The state of a run after all calls so far.
struct Calls {
  bool is_finished = false;   ///< the run ended with a result
  double seconds = 0.0;       ///< wall time of all calls together
  double time_limit_s = 0.0;  ///< the limit that the last call exceeded; 0 if it did not
};

Calls read_calls(const fs::path& folder) {
  std::error_code ignored;
  Calls calls;
  if (!fs::is_regular_file(folder / record_name, ignored)) return calls;
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

/// Ends a run that exceeded its time limit. Its result counts if it ended by itself just then.
void end_by_limit(LocomotionRun& run, double time_limit_s, double seconds) {
  read_or_fail(run);
  if (run.status && *run.status != io::RunStatus::stopped) return;
  run.status = io::RunStatus::stopped;
  run.displacement_m.reset();
  run.seconds = seconds;
  run.reason = "time limit of " + io::number_text(time_limit_s) + " s";
}

io::ProgramJob child_of(const LocomotionJob& job, const LocomotionRunOptions& options) {
  io::ProgramJob child;
  child.name = job.name;
  child.program = options.program;
  child.arguments = {"study.toml", "-o", result_folder, "--quiet", "--no-pictures"};
  child.inputs = {{"study.toml", job.study}};
  child.kept_folder = fs::absolute(options.runs / io::job_hash(child));
  return child;
}

/// Runs one job, or finds its result from an earlier call. @return nothing if the user stopped it
std::optional<LocomotionRun> run_locomotion(const LocomotionJob& job, const LocomotionRunOptions& options,
                                            const std::function<void()>& waiting) {
  io::ProgramJob child = child_of(job, options);
  LocomotionRun run;
  run.folder = child.kept_folder / result_folder;
  Calls calls = read_calls(child.kept_folder);
  if (calls.is_finished) {
    read_or_fail(run);
    if (run.status) return run;
    calls = {};  // its files are damaged or missing
  }
  if (calls.time_limit_s >= options.time_limit_s) {
    end_by_limit(run, calls.time_limit_s, calls.seconds);
    return run;
  }
  child.time_limit_s = std::max(1e-3, options.time_limit_s - calls.seconds);
  const io::ProgramJobOptions job_options{.runs = options.runs, .stop = options.stop, .waiting = [&](double) { waiting(); }};
  io::ProgramJobResult result = io::run_job(child, job_options);
  std::error_code ignored;
  if (result.is_refused() && fs::exists(run.folder / checkpoint_name, ignored)) {
    // A checkpoint that is damaged, or was made by another program or instruction set, must not prevent the run.
    child.arguments.emplace_back("--restart");
    result = io::run_job(child, job_options);
  }
  calls.seconds += result.outcome.wall_s;
  calls.is_finished = result.has_result();
  const bool is_timed_out = result.outcome.end == io::ChildEnd::timed_out;
  calls.time_limit_s = is_timed_out ? options.time_limit_s : 0.0;  // a run that the user stopped may be resumed under any limit
  write_calls(child.kept_folder, calls);
  if (result.is_stopped()) return std::nullopt;
  run.is_repeated = true;
  run.is_refused = result.is_refused();
  run.seconds = calls.seconds;
  if (result.has_result()) {
    read_or_fail(run);
  } else if (is_timed_out) {
    end_by_limit(run, options.time_limit_s, calls.seconds);
  } else {
    run.reason = result.failure();
  }
  return run;
}

}  // namespace

std::string_view status_word(const LocomotionRun& run) { return run.status ? io::to_string(*run.status) : "failed"; }

void leave_out(LocomotionRun& run, double until_s) {
  if (until_s <= 0.0 || !run.displacement_m || until_s <= run.trajectory.front().time_s) return;
  run.left_out_m = voxel::displacement_m(run.trajectory, voxel::point_at(run.trajectory, until_s));
  for (std::size_t axis = 0; axis < 3; ++axis) run.displacement_m->at(axis) -= run.left_out_m->at(axis);
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

std::optional<std::vector<LocomotionRun>> run_locomotions(std::span<const LocomotionJob> jobs,
                                                          const LocomotionRunOptions& options) {
  io::require_writable_folder(options.runs);
  const io::FileLock lock(options.runs);
  // Equal jobs share a folder: the first of them is run.
  std::map<fs::path, std::size_t> place_of;
  std::vector<std::size_t> first;
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    if (place_of.emplace(child_of(jobs[n], options).kept_folder, first.size()).second) first.push_back(n);
  }
  std::vector<LocomotionRun> made(first.size());
  std::mutex mutex;
  std::size_t done = jobs.size() - first.size();
  const auto tell = [&](std::size_t finished, const std::string& name) {
    const std::scoped_lock guard(mutex);
    done += finished;
    if (options.progress) options.progress(done, name);
  };
  const bool is_whole = io::side_by_side(first.size(), options.jobs, options.stop, [&](std::size_t n) {
    const LocomotionJob& job = jobs[first[n]];
    auto run = run_locomotion(job, options, [&] { tell(0, job.name); });
    if (!run) return false;
    made[n] = std::move(*run);
    tell(1, job.name);
    return true;
  });
  if (!is_whole) return std::nullopt;
  std::vector<LocomotionRun> runs;
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    const std::size_t place = place_of.at(child_of(jobs[n], options).kept_folder);
    runs.push_back(made[place]);
    if (first[place] != n) runs.back().is_repeated = false;
  }
  return runs;
}

}  // namespace menger::evolution
