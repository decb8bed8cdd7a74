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

/// How a scene is run, never what comes out of it.
struct RunOptions {
  KernelOptions kernel;                                                        ///< its energy_ledger is overruled by the scene's
  std::function<void(const std::vector<std::string>& kernel_report)> started;  ///< called before the first step
  std::function<void(const RunProgress&)> progress;  ///< called after every record and about ten times a second in between
  const std::atomic<bool>* stop = nullptr;           ///< ends the run with status `stopped`
  std::filesystem::path scene_file;                  ///< that the scene came from, for messages; may be empty
};

/// What a run gave.
struct SceneResult {
  io::RunStatus status = io::RunStatus::stopped;
  std::string reason;                                   ///< empty when completed; otherwise what, where and when
  std::optional<std::array<double, 3>> displacement_m;  ///< of the centre of mass; exists exactly when completed
  double body_length_m = 0.0;
  double time_s = 0.0;  ///< reached
  double time_step_s = 0.0;
  std::uint64_t steps = 0;
  std::size_t voxels = 0;
  std::size_t beams = 0;
  std::size_t parts = 0;  ///< pieces of the body that no beam joins; more than one is worth a note
  std::optional<Divergence> divergence;
  std::optional<StrainRange> strain_range;    ///< of a calibrated body
  std::vector<std::string> outside_validity;  ///< what it did beyond what its parameters were fitted on; also notes
  CollisionCounts collisions;
  std::vector<std::string> kernel_report;
  Trajectory trajectory;
  std::vector<Frame>
      recorded_frames;             ///< at the start, and at the end or, of a run cut short, the last that was built for output
  std::vector<std::string> notes;  ///< what the user should know: a body in pieces, pictures that could not be made
  std::optional<StepCheck> step_check;  ///< if it was asked for, see add_step_check
  double seconds = 0.0;                 ///< wall time, without the check
};

/// Runs a scene and writes into `folder`: trajectory.csv, frames.pvd with frames/frame_0000.vtu ..., robot.png and
/// trajectory.png, and as the last of them result.toml (status, reason, displacement, steps, kernels). Each file is written whole
/// or not at all, and before the first step those of an earlier run are removed. A diverged or stopped run leaves what it did,
/// and its status says so; a picture that cannot be made is a note.
/// @throws io::InputError if the folder cannot be written or the engine refuses the scene, before anything is computed
SceneResult run_scene(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options = {});

/// The text of result.toml. Wall times are left out of it.
std::string result_text(const SceneResult& result);

}  // namespace menger::voxel
