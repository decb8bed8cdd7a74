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
#include "evolution/reference/reevaluation_locomotion.h"
#include "io/text/run_status.h"
#include "voxel/scene/trajectory.h"

namespace menger::evolution {

/// What a run gave.
struct LocomotionRun {
  std::optional<io::RunStatus> status;  ///< nothing where the program gave no result
  std::string reason;
  std::optional<std::array<double, 3>> displacement_m;  ///< exactly if completed
  std::optional<std::array<double, 3>> left_out_m{};    ///< before that, see leave_out
  double time_s = 0.0;                                  ///< reached
  std::uint64_t steps = 0;
  std::uint64_t elements = 0;
  double seconds = 0.0;            ///< wall time over all calls
  std::filesystem::path folder{};  ///< of the results
  voxel::Trajectory trajectory;
  bool is_refused = false;   ///< the program called its input wrong
  bool is_repeated = false;  ///< by this call, not found
};

/// The word for a status, or "failed" where there is none.
std::string_view status_word(const LocomotionRun& run);

/// Takes what came before a time (up to the end of the run) out of the displacement of a run that completed: its position then is
/// that of its records, interpolated linearly, which is exact at a record. Nothing for 0.
void leave_out(LocomotionRun& run, double until_s);

/// A run as the archive keeps it: `stopped` without a result, too.
Evaluation evaluation_of(const LocomotionRun& run);

/// @throws io::InputError if the program refused every run: that is the study's fault, not that of a design
void require_accepted(std::span<const LocomotionRun> runs);

/// How runs are made, never what comes out of them, but for time limits.
struct LocomotionRunOptions {
  std::filesystem::path program;  ///< menger-locomote
  std::filesystem::path runs;     ///< folder with a folder per job, named by the hash of program and input
  double time_limit_s = 3600.0;   ///< of a run, over all calls
  int jobs = 1;                   ///< runs at the same time
  const std::atomic<bool>* stop = nullptr;

  /// Called after every run and ten times a second in between, never twice at the same time.
  /// @param running name of a run that is under way
  std::function<void(std::size_t done, const std::string& running)> progress{};
};

/// Runs jobs side by side; results in the order of the jobs. A finished run is found again, one that was stopped or whose time
/// was up goes on from its checkpoint, the latter if the limit is larger now; with a checkpoint that the program refuses it
/// begins anew. Equal jobs are run once. No failure ends the others.
/// @return nothing if the user stopped it; what is finished is kept
/// @throws io::InputError if the program cannot be started, the folder cannot be written or another process runs jobs in it
std::optional<std::vector<LocomotionRun>> run_locomotions(std::span<const LocomotionJob> jobs,
                                                          const LocomotionRunOptions& options);

}  // namespace menger::evolution
