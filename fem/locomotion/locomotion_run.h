#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "fem/locomotion/locomotion_result.h"
#include "fem/locomotion/locomotion_study.h"
#include "fem/walk/walk_dynamics.h"

namespace menger::fem {

/// Makes the dynamics of a study, with the body at rest.
/// @param stop as in ExplicitOptions
/// @throws io::InputError if the dynamics reject the study
using LocomotionMaker = std::function<std::unique_ptr<WalkDynamics>(const LocomotionStudy& study, const std::atomic<bool>* stop)>;

/// Options of a run that do not change its results.
struct LocomotionRunOptions {
  bool restart = false;                       ///< start again instead of resuming an earlier run that was stopped
  const std::atomic<bool>* stop = nullptr;    ///< ends the run with status `stopped`; the same call resumes it
  double checkpoint_interval_seconds = 20.0;  ///< wall time between two checkpoints
  /// Called once before the first step with its start time, which is later than 0 if an interrupted run is resumed.
  std::function<void(double time_s)> started{};
  /// Called after every record with its time.
  std::function<void(double time_s)> progress{};
  LocomotionMaker make = explicit_walk_dynamics;  ///< makes the dynamics of the study
};

/// The tables and pictures that a walk or a sweep leaves in a folder. A run begins by removing them, so that those of a sweep do
/// not lie beside those of a walk. Checkpoints, frames and the folders of cases stay: the earlier study goes on from them.
inline constexpr std::array<std::string_view, 6> locomotion_files{"locomotion.toml", "trajectory.csv", "robot.png",
                                                                  "trajectory.png",  "sweep.csv",      "sweep.png"};

/// Runs a study and writes its results into `folder`: trajectory.csv, frames.pvd with frames/frame_0000.vtu ..., robot.png,
/// trajectory.png, manifest.json, locomotion.checkpoint, and as the last of them locomotion.toml.
///
/// Each file is written whole or not at all, and those of an earlier run are removed before the first step. A run that was
/// stopped, or killed after a checkpoint, is resumed. Its files are then those of an uninterrupted run, except for `seconds`. A
/// run that has ended is not computed again. A run that failed keeps its results up to then, and its status says so. If a picture
/// cannot be made, a note says so.
///
/// At every record the body is checked for passing through itself (see BodyOverlapSearch). That ends the run as `diverged`, with
/// the time of the record.
/// @throws io::InputError if the folder cannot be written, its checkpoint is of another study, or the dynamics reject the study
/// (schedules that the step cannot resolve), before anything is removed
LocomotionResult run_locomotion(const LocomotionStudy& study, const std::filesystem::path& folder,
                                const LocomotionRunOptions& options = {});

/// Checks for everything that run_locomotion would reject, without removing or writing anything.
/// @throws io::InputError as run_locomotion does
void check_locomotion(const LocomotionStudy& study, const std::filesystem::path& folder,
                      const LocomotionRunOptions& options = {});

}  // namespace menger::fem
