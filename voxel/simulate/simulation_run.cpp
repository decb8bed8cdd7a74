#include "voxel/simulate/simulation_run.h"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/design_file.h"
#include "meshes/design/fractal.h"
#include "meshes/load_cases/walk_agreement.h"
#include "voxel/picture/preview.h"
#include "voxel/picture/vtk_output.h"
#include "voxel/scene/body_pieces.h"

namespace menger::voxel {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// A run of one scene through all its records.
class SceneRun {
 public:
  SceneRun(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options)
      : scene_(scene),
        folder_(folder),
        options_(options),
        body_(meshes::fractal(scene.design.body, scene.level, machine_memory_bytes())),
        simulation_(body_, scene.design.cell_edge_m, physics_of(scene), {}, kernel_options(scene, options)),
        steps_(simulation_, scene.duration_s, options.stop, options.progress),
        frames_(folder) {
    result_.body_length_m = meshes::body_length_m(scene.design, scene.level);
    result_.time_step_s = simulation_.time_step_s();
    result_.voxels = simulation_.voxel_count();
    result_.beams = simulation_.beam_count();
    result_.kernel_report = simulation_.kernel_report();
    const BodyPieces pieces = body_pieces(body_, physics_of(scene));
    if (pieces.is_refused) throw std::invalid_argument(pieces.text);
    result_.parts = pieces.count;
    if (!pieces.text.empty()) result_.notes.push_back(pieces.text);
  }

  SceneResult run() {
    if (options_.started) options_.started(result_.kernel_report);
    record(false);
    // The last record is at the end of the duration, which may not be a multiple of the interval.
    const auto intervals = static_cast<std::uint64_t>(std::ceil(scene_.duration_s / scene_.record_interval_s * (1.0 - 1e-12)));
    result_.status = io::RunStatus::completed;
    for (std::uint64_t i = 1; i <= intervals && result_.status == io::RunStatus::completed; ++i) {
      const double until_s = i == intervals ? scene_.duration_s : static_cast<double>(i) * scene_.record_interval_s;
      result_.status = steps_.advance_to(until_s);
      if (result_.status == io::RunStatus::completed) record(i == intervals);
      steps_.report();
    }
    finish();
    return std::move(result_);
  }

 private:
  static KernelOptions kernel_options(const Scene& scene, const RunOptions& options) {
    KernelOptions kernel = options.kernel;
    kernel.energy_ledger = scene.energy_ledger;
    return kernel;
  }

  /// The physics of a scene with the level of its body, which the scene sets.
  static Physics physics_of(const Scene& scene) {
    Physics physics = scene.physics;
    if (physics.surrogate) physics.surrogate->level = scene.level;
    return physics;
  }

  void record(bool is_last) {
    const double time_s = simulation_.time_s();
    const std::size_t index = result_.trajectory.size();
    // With an interval shorter than a time step the same state would be recorded again.
    const bool is_new = index == 0 || result_.trajectory.back().time_s != time_s;
    if (is_new) result_.trajectory.push_back({time_s, simulation_.centre_of_mass_m(), simulation_.energy()});
    const SceneOutput& output = scene_.output;
    const bool is_due = is_new && index % static_cast<std::size_t>(output.records_per_frame) == 0;
    // Pictures of a run that was cut short show the last frame.
    const bool is_shown = is_due && (output.frames || output.pictures);
    if (index == 0 || is_shown || (is_last && last_frame_.time_s != time_s)) last_frame_ = simulation_.frame();
    if (is_due && output.frames) frames_.add(last_frame_);
    if (index == 0) result_.recorded_frames.push_back(last_frame_);
  }

  void explain_status() {
    result_.divergence = simulation_.divergence();
    if (result_.status == io::RunStatus::stopped) result_.reason = "stopped at " + io::number_text(simulation_.time_s()) + " s";
    if (result_.status == io::RunStatus::diverged && result_.divergence) result_.reason = divergence_text(*result_.divergence);
  }

  /// Notes in the result where a calibrated body left the range of validity of its parameters.
  void note_validity() {
    if (!scene_.physics.surrogate) return;
    result_.strain_range = simulation_.strain_range();
    result_.outside_validity = simulation_.outside_validity();
    result_.expected_error = options_.expected_error;
    for (const std::string& fault : result_.outside_validity) result_.notes.push_back("outside the range of validity: " + fault);
  }

  void finish() {
    explain_status();
    note_validity();
    result_.time_s = simulation_.time_s();
    result_.steps = simulation_.steps();
    result_.collisions = simulation_.collision_counts();
    if (result_.status == io::RunStatus::completed) {
      result_.displacement_m = voxel::displacement_m(result_.trajectory, result_.trajectory.back());
    }
    result_.recorded_frames.push_back(last_frame_);
    trajectory_table(result_.trajectory, result_.body_length_m).write(folder_ / "trajectory.csv");
    if (scene_.output.frames) frames_.finish();
    if (scene_.output.pictures) draw();
    result_.seconds = seconds_since(start_);
    io::write_whole(folder_ / "result.toml", result_text(result_));
  }

  void draw() {
    std::vector<std::array<double, 3>> trail;
    for (const TrajectoryPoint& point : result_.trajectory) trail.push_back(point.centre_of_mass_m);
    // A run that was cut short shows its last frame.
    const TrajectoryPoint shown = point_at(result_.trajectory, last_frame_.time_s);
    const std::array<double, 3> moved_m = displacement_m(result_.trajectory, shown);
    const io::PictureOutcome robot = render_robot(
        folder_ / "robot.png", last_frame_, trail,
        {.floor = scene_.physics.floor, .title = meshes::moved_text(scene_.design.name, shown.time_s, moved_m[0], moved_m[1])});
    if (!robot.written) {
      result_.notes.push_back("no pictures: " + robot.missing);
      return;
    }
    if (const auto plot =
            plot_trajectory(folder_ / "trajectory.png", result_.trajectory, result_.body_length_m, scene_.design.name);
        !plot.written) {
      result_.notes.push_back("no plot of the trajectory: " + plot.missing);
    }
  }

  const Scene& scene_;
  const std::filesystem::path& folder_;
  const RunOptions& options_;
  Clock::time_point start_ = Clock::now();
  meshes::Polycube body_;
  Simulation simulation_;
  SlicedRun steps_;
  FrameSeries frames_;
  Frame last_frame_;
  SceneResult result_;
};

}  // namespace

SceneResult run_scene(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options) {
  io::require_writable_folder(folder);
  std::optional<SceneRun> run;
  try {
    run.emplace(scene, folder, options);
  } catch (const std::invalid_argument& fault) {
    // Faults that only the engine can detect, such as kernels that this machine cannot run.
    const std::string scene_name = options.scene_file.empty() ? "the scene" : options.scene_file.string();
    throw io::InputError(scene_name + ": cannot be simulated: " + fault.what());
  }
  // From here on no file of an earlier run may pass for one of this run, also if this one is killed.
  io::remove_files(folder, {"result.toml", "trajectory.csv", "check_dt.csv", "robot.png", "trajectory.png", "manifest.json"});
  FrameSeries(folder).remove_earlier();
  return run->run();
}

}  // namespace menger::voxel
