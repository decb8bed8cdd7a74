#include "voxel/simulate/step_check.h"

#include <cmath>
#include <utility>

#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/design/fractal.h"
#include "meshes/load_cases/observables.h"
#include "voxel/simulate/simulation_run.h"

namespace menger::voxel {
namespace {

double distance_m(const TrajectoryPoint& a, const TrajectoryPoint& b) {
  const auto& p = a.centre_of_mass_m;
  const auto& q = b.centre_of_mass_m;
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

Simulation with_half_the_step(const Scene& scene, const RunOptions& options) {
  Physics physics = scene.physics;
  physics.integration.time_step_fraction *= 0.5;
  if (physics.surrogate) physics.surrogate->level = scene.level;
  KernelOptions kernel = options.kernel;
  kernel.energy_ledger = false;
  return {meshes::fractal(scene.design.body, scene.level, machine_memory_bytes()), scene.design.cell_edge_m, physics, {}, kernel};
}

void explain_status(const Simulation& simulation, StepCheck& check) {
  if (check.status == io::RunStatus::stopped) check.reason = "stopped at " + io::number_text(check.time_s) + " s";
  if (const auto& divergence = simulation.divergence()) check.reason = divergence_text(*divergence);
}

/// Compares the displacements of both runs, and finds where they were farthest apart.
void compare(const SceneResult& result, StepCheck& check) {
  for (std::size_t i = 0; i < check.trajectory.size(); ++i) {
    const double distance = distance_m(check.trajectory[i], result.trajectory[i]);
    if (distance <= check.largest_distance_m) continue;
    check.largest_distance_m = distance;
    check.largest_distance_time_s = check.trajectory[i].time_s;
  }
  if (!check.displacement_m || !result.displacement_m) return;
  check.horizontal_change_m =
      meshes::horizontal_displacement(*check.displacement_m) - meshes::horizontal_displacement(*result.displacement_m);
}

}  // namespace

StepCheck check_time_step(const Scene& scene, const SceneResult& result, const RunOptions& options) {
  Simulation simulation = with_half_the_step(scene, options);
  SlicedRun run(simulation, scene.duration_s, options.stop, options.progress);
  StepCheck check;
  check.status = io::RunStatus::completed;
  const std::array<double, 3> start_m = simulation.centre_of_mass_m();
  for (const TrajectoryPoint& point : result.trajectory) {
    // Twice as many steps of half the length end at exactly the same number.
    check.status = run.advance_to(point.time_s);
    if (check.status != io::RunStatus::completed) break;
    check.trajectory.push_back({simulation.time_s(), simulation.centre_of_mass_m(), {}});
    run.report();
  }
  if (check.status == io::RunStatus::completed) check.status = run.advance_to(scene.duration_s);
  if (check.status == io::RunStatus::completed) {
    const std::array<double, 3> end_m = simulation.centre_of_mass_m();
    check.displacement_m = {end_m[0] - start_m[0], end_m[1] - start_m[1], end_m[2] - start_m[2]};
  }
  check.time_s = simulation.time_s();
  check.time_step_s = simulation.time_step_s();
  check.steps = simulation.steps();
  explain_status(simulation, check);
  compare(result, check);
  check.seconds = run.seconds();
  return check;
}

io::CsvTable step_check_table(const StepCheck& check, const Trajectory& whole) {
  io::CsvTable table({"time_s", "centre_of_mass_x_m", "centre_of_mass_y_m", "centre_of_mass_z_m", "distance_m"});
  for (std::size_t i = 0; i < check.trajectory.size(); ++i) {
    const TrajectoryPoint& point = check.trajectory[i];
    const auto& [x, y, z] = point.centre_of_mass_m;
    table.add_row(point.time_s, x, y, z, distance_m(point, whole.at(i)));
  }
  return table;
}

std::string step_check_text(const StepCheck& check, double body_length_m) {
  io::TomlText text;
  text.table("check_dt").add("status", io::to_string(check.status));
  if (!check.reason.empty()) text.add("reason", check.reason);
  text.add("time_step_s", check.time_step_s).add("steps", check.steps);
  if (check.displacement_m) {
    const double moved_m = meshes::horizontal_displacement(*check.displacement_m);
    text.add("displacement_m", *check.displacement_m).add("horizontal_displacement_m", moved_m);
    text.add("horizontal_displacement_body_lengths", moved_m / body_length_m);
  }
  if (check.horizontal_change_m) {
    text.add("horizontal_change_m", *check.horizontal_change_m);
    text.add("horizontal_change_body_lengths", *check.horizontal_change_m / body_length_m);
  }
  text.add("largest_distance_m", check.largest_distance_m).add("largest_distance_time_s", check.largest_distance_time_s);
  return text.text();
}

void add_step_check(const Scene& scene, const std::filesystem::path& folder, const RunOptions& options, SceneResult& result) {
  if (result.status == io::RunStatus::stopped) return;
  result.step_check = check_time_step(scene, result, options);
  step_check_table(*result.step_check, result.trajectory).write(folder / "check_dt.csv");
  io::write_whole(folder / "result.toml", result_text(result));
}

}  // namespace menger::voxel
