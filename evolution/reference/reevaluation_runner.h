#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evolution/evaluation/evaluator.h"
#include "evolution/reference/kept_walk.h"
#include "evolution/reference/reevaluation_locomotion.h"
#include "fem/locomotion/locomotion_result.h"
#include "io/ranks/rank_session.h"
#include "io/ranks/rank_team.h"
#include "io/text/run_status.h"
#include "voxel/scene/trajectory.h"

namespace menger::evolution {

/// The result of a job.
struct LocomotionRun {
  std::optional<io::RunStatus> status;  ///< none if the walk gave no result
  std::string reason;
  std::optional<std::array<double, 3>> displacement_m;  ///< exists exactly if completed
  std::optional<std::array<double, 3>> left_out_m{};    ///< displacement that is not in that, see Evaluation
  double time_s = 0.0;                                  ///< simulated time that the run reached
  std::uint64_t steps = 0;
  std::uint64_t elements = 0;
  double seconds = 0.0;            ///< wall time over all calls
  std::filesystem::path folder{};  ///< of the results; empty if nothing is kept
  voxel::Trajectory trajectory;
  bool is_refused = false;   ///< finite elements refused its study
  bool is_repeated = false;  ///< computed in this call, not found from an earlier one
};

/// Returns the word for the status of a run, or "failed" if it has none.
std::string_view status_word(const LocomotionRun& run);

/// Subtracts the displacement before a time from that of a completed run, and keeps it in left_out_m. The position at that time
/// is interpolated linearly between records, so it is exact at a record. Does nothing for time 0.
void leave_out(LocomotionRun& run, double until_s);

/// Makes the displacement of a completed run that which the search measures: that of the last periods, or from a time on.
void measure_as_search(const ReevaluationStudy& study, LocomotionRun& run);

/// Returns a run as the archive keeps it. A run without a result has the status `stopped`, too.
Evaluation evaluation_of(const LocomotionRun& run);

/// Checks that finite elements accepted the study of at least one run.
/// @throws io::InputError if they refused every run: then the study is wrong, not a design
void require_accepted(std::span<const LocomotionRun> runs);

/// Makes the walk of a job. Thread-safe.
/// @param folder of its own, for what it keeps; empty: it keeps nothing
/// @param stop when it becomes true, the walk returns soon as `stopped`
/// @throws io::InputError if finite elements refuse the study
using Walker = std::function<fem::LocomotionResult(const LocomotionJob& job, const std::filesystem::path& folder,
                                                   const std::atomic<bool>& stop)>;

/// Options that decide how runs are made. Apart from the time limit they do not change the results.
struct LocomotionRunOptions {
  Walker walker = kept_walk;
  /// Folder with a folder per job, whose name is the hash of this program and the study. Empty: nothing is kept.
  std::filesystem::path runs{};
  double time_limit_s = 3600.0;  ///< wall time of a run, over all calls
  int jobs = 1;                  ///< number of runs at the same time, of each rank
  const std::atomic<bool>* stop = nullptr;

  /// The ranks that make the runs together, see serve_locomotions; null or one: this process alone. All see the same folder of
  /// runs, which is given.
  io::RankSession* ranks = nullptr;
  double rank_patience_s = io::TeamOptions{}.patience_s;  ///< see io::TeamOptions
  std::function<void(const std::string&)> note{};         ///< see io::TeamOptions

  /// Called after every run and ten times a second in between, never twice at the same time.
  /// @param running name of a run that is being made
  std::function<void(std::size_t done, const std::string& running)> progress{};
};

/// Runs jobs in parallel. Equal jobs are run once. A failure of one does not end the others.
///
/// A run that finished in an earlier call is found again. No two processes make a run in the same folder: where one still does,
/// the next one makes its run in a folder of the same name with a number. A run that was stopped is resumed from its checkpoint.
/// A run that exceeded its time limit is resumed only if the limit is larger now.
/// @return results in the order of the jobs; nothing if the user stopped it, and finished runs are kept
/// @throws io::InputError if the folder cannot be written or another process runs jobs in it
std::optional<std::vector<LocomotionRun>> run_locomotions(std::span<const LocomotionJob> jobs,
                                                          const LocomotionRunOptions& options);

/// Makes runs for the first rank until there are no more. To be called by every other rank while the first one is in
/// run_locomotions, with equal jobs and options.
void serve_locomotions(std::span<const LocomotionJob> jobs, const LocomotionRunOptions& options);

/// Tells the first rank, which is in run_locomotions or on its way there, why this rank can make no runs.
void refuse_locomotions(io::RankSession& ranks, const std::string& reason);

}  // namespace menger::evolution
