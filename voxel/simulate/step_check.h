#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/text/csv_table.h"
#include "io/text/run_status.h"
#include "voxel/scene/scene.h"
#include "voxel/scene/trajectory.h"

namespace menger::voxel {

struct RunOptions;
struct SceneResult;

/// The result of a run repeated with half the time step.
///
/// The scheme is of first order. Where it converges, the run with the whole step has an error of twice the difference, the run
/// with half the step of once the difference. Gaits that stick and slip converge unevenly: their differences show the size of the
/// error, not its sign.
struct StepCheck {
  io::RunStatus status = io::RunStatus::stopped;        ///< of the run with half the step
  std::string reason;                                   ///< empty when completed
  std::optional<std::array<double, 3>> displacement_m;  ///< of the centre of mass with half the step; exists when completed

  /// Horizontal displacement with half the step minus that of the run, m; exists if both completed.
  std::optional<double> horizontal_change_m;

  double time_s = 0.0;  ///< time reached
  double time_step_s = 0.0;
  std::uint64_t steps = 0;
  Trajectory trajectory;                 ///< at the times of the run's records, as far as it went
  double largest_distance_m = 0.0;       ///< between the centres of mass of both runs at the same time
  double largest_distance_time_s = 0.0;  ///< first time of that distance
  double seconds = 0.0;                  ///< wall time
};

/// Checks whether the time step of a run was small enough: repeats the run of its scene with half the step and compares every
/// record.
///
/// The second run takes each record after twice as many steps, so the times are equal to the last bit. If the first run diverged,
/// its records up to then are compared. The second run still continues to the end of the scene, to show whether the step was the
/// cause.
/// @param result of the scene, with at least one record
StepCheck check_time_step(const Scene& scene, const SceneResult& result, const RunOptions& options);

/// The check as a table: time_s, centre of mass with half the step, and its distance from that of the run.
io::CsvTable step_check_table(const StepCheck& check, const Trajectory& whole);

/// Checks the time step of a run whose results are in `folder`. Writes check_dt.csv there, and result.toml again with a table
/// [check_dt]. A run that was stopped is not checked.
/// @param result of the scene; the check is added to it
void add_step_check(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options, SceneResult& result);

/// The text of the table [check_dt] of result.toml, without wall times.
std::string step_check_text(const StepCheck& check, double body_length_m);

}  // namespace menger::voxel
