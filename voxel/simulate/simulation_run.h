#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "voxel/engine/energy_ledger.h"
#include "voxel/engine/frame.h"
#include "voxel/kernels/kernel_choice.h"
#include "voxel/lanes/simulation.h"
#include "voxel/scene/scene.h"
#include "voxel/scene/trajectory.h"
#include "voxel/simulate/sliced_run.h"
#include "voxel/simulate/step_check.h"

namespace menger::voxel {

/// Options of a run. They do not change its results.
struct RunOptions {
  KernelOptions kernel;  ///< its energy_ledger is replaced by that of the scene
  std::function<void(const std::vector<std::string>& kernel_report)> started;  ///< called before the first step
  std::function<void(const RunProgress&)> progress;  ///< called after every record and about ten times a second in between
  const std::atomic<bool>* stop = nullptr;           ///< ends the run with status `stopped`
  std::filesystem::path scene_file;                  ///< the file of the scene, for messages; may be empty
  std::vector<std::string> expected_error{};  ///< what to expect of a calibrated body, see expected_error_text; for result.toml
};

/// The result of a run.
struct SceneResult {
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason;                                   ///< empty if completed; otherwise what happened, where and when
  std::optional<std::array<double, 3>> displacement_m;  ///< of the centre of mass; exists exactly when completed
  double body_length_m = 0.0;
  double time_s = 0.0;  ///< time reached
  double time_step_s = 0.0;
  std::uint64_t steps = 0;
  std::size_t voxels = 0;
  std::size_t beams = 0;
  std::size_t parts = 0;  ///< number of pieces of the body that no beam joins; for more than one there is a note
  std::optional<Divergence> divergence;
  std::optional<StrainRange> strain_range;  ///< of a calibrated body
  /// Sentences on what lies outside the range of validity of its parameters; also in the notes.
  std::vector<std::string> outside_validity;
  std::vector<std::string> expected_error;  ///< that of the options
  CollisionCounts collisions;
  std::vector<std::string> kernel_report;
  Trajectory trajectory;
  /// Frames at the start and at the end. For a run that was cut short, the second is the last one built for output.
  std::vector<Frame> recorded_frames;
  std::vector<std::string> notes;       ///< for the user: a body in pieces, pictures that could not be made
  std::optional<StepCheck> step_check;  ///< if asked for, see add_step_check
  double seconds = 0.0;                 ///< wall time, without the check
};

/// Runs a scene and writes the results into `folder`: trajectory.csv, frames.pvd with frames/frame_0000.vtu ..., robot.png and
/// trajectory.png, and last result.toml (status, reason, displacement, steps, kernels).
///
/// Each file is written whole or not at all. Before the first step, the files of an earlier run are removed. A run that diverged
/// or was stopped leaves its results so far, with its status. A picture that cannot be made gives a note.
/// @throws io::InputError if the folder cannot be written or the engine refuses the scene, before anything is computed
SceneResult run_scene(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options = {});

/// The text of result.toml, without wall times.
std::string result_text(const SceneResult& result);

}  // namespace menger::voxel
