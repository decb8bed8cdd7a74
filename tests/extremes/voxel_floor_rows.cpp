// The floor: very large friction, long rest, and positions far from the origin.

#include <algorithm>

#include "meshes/design/reference_shapes.h"
#include "tests/extremes/voxel_rows.h"

namespace menger::extremes {

namespace {

/// Returns one voxel that is in equilibrium on the floor and starts with a horizontal velocity.
voxel::Simulation sliding_voxel(double friction, double speed_m_per_s) {
  voxel::Physics physics = still_physics();
  physics.damping_ratios.global = 0.0;
  for (voxel::VoxelMaterial& material : physics.materials) material.static_friction = material.kinetic_friction = friction;
  voxel::VoxelLoads loads;
  loads.initial_displacement_m = {{0.0, 0.0, -mass_kg * gravity_m_per_s2 / (2.0 * stiffness_N_per_m)}};
  loads.initial_velocity_m_s = {{speed_m_per_s, 0.0, 0.0}};
  return {meshes::bar(1), edge_m, physics, loads, with_ledger};
}

void run_no_friction(Outcome& outcome) {
  constexpr double speed_m_per_s = 0.5;
  voxel::Simulation simulation = sliding_voxel(0.0, speed_m_per_s);
  expect_completed(outcome, simulation, simulation.advance_to(2.0));
  outcome.expect_near("distance m", simulation.position_m(0)[0], speed_m_per_s * simulation.time_s(), 1e-12);
  expect_energy_error(outcome, simulation, 1e-12);
}

constexpr double large_friction = 1e3;

void run_large_friction(Outcome& outcome) {
  constexpr double speed_m_per_s = 3.0;
  voxel::Simulation simulation = sliding_voxel(large_friction, speed_m_per_s);
  expect_completed(outcome, simulation, simulation.advance_to(2.0));
  const double glide_m = speed_m_per_s * speed_m_per_s / (2.0 * large_friction * gravity_m_per_s2);
  outcome.expect_between("distance m", simulation.position_m(0)[0], 0.0, glide_m + speed_m_per_s * simulation.time_step_s());
  outcome.expect_at_most("speed m/s", simulation.velocity_m_s(0)[0], 0.0);
  expect_energy_error(outcome, simulation, 1e-12);
}

void run_creep(Outcome& outcome) {
  constexpr double speed_m_per_s = 0.3;
  voxel::Simulation simulation = sliding_voxel(large_friction, speed_m_per_s);
  expect_completed(outcome, simulation, simulation.advance_to(2.0));
  const double slowing_m_per_s = large_friction * gravity_m_per_s2 * simulation.time_step_s();
  outcome.expect_near("distance m", simulation.position_m(0)[0], (speed_m_per_s - 0.5 * slowing_m_per_s) * simulation.time_s(),
                      0.01);
}

/// 20 voxels at rest on the floor.
void run_rest(Outcome& outcome) {
  voxel::Simulation simulation(meshes::menger_sponge(), edge_m, still_physics());
  expect_completed(outcome, simulation, simulation.advance_to(10.0));
  const std::array<double, 3> settled_m = simulation.centre_of_mass_m();
  expect_completed(outcome, simulation, simulation.advance_to(1000.0));
  outcome.note(std::to_string(simulation.steps()) + " steps");
  const std::array<double, 3> end_m = simulation.centre_of_mass_m();
  for (std::size_t i = 0; i < 3; ++i)
    outcome.expect_at_most(std::string("drift in ") + "xyz"[i] + " m", end_m[i] - settled_m[i], 1e-12);
}

std::array<double, 3> walk_m(voxel::NumberType number, double shift_m, io::RunStatus& status) {
  const meshes::Polycube body = walker();
  voxel::Physics physics;
  physics.gravity_m_s2 = gravity_m_per_s2;
  physics.integration.number = number;
  physics.integration.damping = voxel::DampingMode::velocity;
  voxel::VoxelLoads loads;
  loads.initial_displacement_m.assign(body.count(), {shift_m, shift_m, 0.0});
  voxel::Simulation simulation(body, edge_m, physics, loads);
  const std::array<double, 3> start_m = simulation.centre_of_mass_m();
  status = simulation.advance_to(1.0);
  const std::array<double, 3> end_m = simulation.centre_of_mass_m();
  return {end_m[0] - start_m[0], end_m[1] - start_m[1], end_m[2] - start_m[2]};
}

/// Compares with double precision at the origin.
void run_shift(Outcome& outcome, voxel::NumberType number, double shift_m, double relative_tolerance) {
  io::RunStatus status{};
  const std::array<double, 3> here_m = walk_m(voxel::NumberType::float64, 0.0, status);
  const std::array<double, 3> there_m = walk_m(number, shift_m, status);
  outcome.expect_status(status, io::RunStatus::completed);
  const double walked_m = std::hypot(here_m[0], here_m[1], here_m[2]);
  outcome.note("at the origin it walks " + shown(walked_m) + " m");
  outcome.expect_at_most("difference by that",
                         std::hypot(there_m[0] - here_m[0], there_m[1] - here_m[1], there_m[2] - here_m[2]) / walked_m,
                         relative_tolerance);
}

}  // namespace

std::vector<Row> voxel_floor_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "friction 0",
                  .done = "a voxel slides for 2 s",
                  .expected = "keeps its speed: v t to 1e-12, rounding of 44000 steps",
                  .run = run_no_friction});
  rows.push_back({.name = "friction 1e3",
                  .done = "a voxel slides at 3 m/s, for 2 s; friction takes mu g h = 0.44 m/s per step",
                  .expected = "stops for good within v^2 / (2 mu g) and one step, and never turns back",
                  .run = run_large_friction});
  rows.push_back({.name = "friction 1e3 on a slow voxel",
                  .done = "a voxel slides at 0.3 m/s, slower than mu g h, for 2 s",
                  .expected =
                      "a limit of the model: its rule stops a voxel only by the work of friction along its path, and a step "
                      "that turns the voxel round does no such work; it creeps on at v - mu g h / 2, to 1 %. A step below "
                      "v / (mu g) avoids it",
                  .run = run_creep});
  rows.push_back({.name = "rest of 1000 s",
                  .done = "a Menger sponge lies on the floor for 2e7 steps",
                  .expected = "no drift: 10 s and 1000 s are the same to 1e-12 m, a ten-billionth of a voxel",
                  .is_slow = true,
                  .run = run_rest});
  rows.push_back(
      {.name = "origin shifted by 1 km in double",
       .done = "a driven robot walks for 1 s",
       .expected = "the walk from the origin to 1e-4: positions keep 1e-13 m, and friction, the only switch, amplifies that",
       .run = [](Outcome& outcome) { run_shift(outcome, voxel::NumberType::float64, 1000.0, 1e-4); }});
  rows.push_back({.name = "origin in float",
                  .done = "a driven robot walks for 1 s in single precision, from the origin",
                  .expected = "the walk in double to 1 %",
                  .run = [](Outcome& outcome) { run_shift(outcome, voxel::NumberType::float32, 0.0, 0.01); }});
  rows.push_back({.name = "origin shifted by 1 km in float",
                  .done = "a driven robot walks for 1 s in single precision, 1 km away",
                  .expected =
                      "the walk in double from the origin to 1 %, as from there: positions are kept from a point near the "
                      "robot; from the origin they would have 6e-5 m, 0.6 % of an edge and as much noise of strain",
                  .run = [](Outcome& outcome) { run_shift(outcome, voxel::NumberType::float32, 1000.0, 0.01); }});
  return rows;
}

}  // namespace menger::extremes
