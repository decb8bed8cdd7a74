#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

#include "fem/locomotion/locomotion_dynamics.h"
#include "fem/locomotion/locomotion_result.h"
#include "fem/locomotion/locomotion_study.h"

namespace menger::fem {

/// How a study is run, never what comes out of it.
struct LocomotionRunOptions {
  bool restart = false;                       ///< begin anew instead of going on where an earlier run was stopped
  const std::atomic<bool>* stop = nullptr;    ///< ends the run with status `stopped`; the same call goes on from there
  double checkpoint_interval_seconds = 20.0;  ///< wall time between two checkpoints
  /// Called once before the first step with its start time: later than 0 where an interrupted run is resumed.
  std::function<void(double time_s)> started{};
  /// Called after every record with the time that it is at.
  std::function<void(double time_s)> progress{};
  LocomotionMaker make = make_explicit_locomotion;  ///< of studies of its method
};

/// Moves the body of a study and writes into `folder`: trajectory.csv, frames.pvd with frames/frame_0000.vtu ..., robot.png,
/// trajectory.png, manifest.json, locomotion.checkpoint, and as the last of them locomotion.toml. Each file is written whole or
/// not at all, and before the first step those of an earlier run are removed. A run that was stopped, or killed after a
/// checkpoint, is taken up where it was, and its files but for `seconds` are those of a run that was not interrupted; one that
/// has ended is not computed again. A run that failed leaves what it did, and its status says so; a picture that cannot be made
/// is a note. At every record it is looked whether the body has gone through itself (see BodyOverlapSearch): that ends the run as
/// `diverged`, with the time of the record.
/// @throws io::InputError if the folder cannot be written, its checkpoint is of another study, or the dynamics refuse the study
/// (schedules that the step cannot resolve), before anything is removed
LocomotionResult run_locomotion(const LocomotionStudy& study, const std::filesystem::path& folder,
                                const LocomotionRunOptions& options = {});

/// What run_locomotion would refuse, found without removing or writing anything. @throws io::InputError as run_locomotion does
void check_locomotion(const LocomotionStudy& study, const std::filesystem::path& folder,
                      const LocomotionRunOptions& options = {});

}  // namespace menger::fem
