// Drives at the limit of possible sizes.

#include <numbers>

#include "meshes/design/reference_shapes.h"
#include "tests/extremes/voxel_rows.h"

namespace menger::extremes {

namespace {

constexpr double amplitude = 0.9;

/// A floating bar. All its voxels shrink to a tenth and grow to nearly twice their size.
void run_bar(Outcome& outcome, voxel::DampingMode damping) {
  voxel::Physics physics = floating_physics();
  physics.actuation.mode = voxel::ActuationMode::in_phase;
  physics.actuation.amplitude = amplitude;
  physics.integration.damping = damping;
  constexpr int length = 5;
  voxel::Simulation simulation(meshes::bar(length), edge_m, physics, {}, with_ledger);
  const double start_m = simulation.centre_of_mass_m()[0];
  const double period_s = physics.actuation.period_s();
  constexpr double beams = length - 1;
  for (const double quarter : {1.0, 3.0, 8.0}) {
    const io::RunStatus status = simulation.advance_to(0.25 * quarter * period_s);
    if (status != io::RunStatus::completed) return expect_completed(outcome, simulation, status);
    const double size_m = edge_m * (1.0 + amplitude * std::round(std::sin(0.5 * std::numbers::pi * quarter)));
    outcome.expect_near("length at T/4 x " + shown(quarter) + " m",
                        simulation.position_m(length - 1)[0] - simulation.position_m(0)[0], beams * size_m, 0.02);
  }
  outcome.expect_at_most("drift of the centre of mass m", simulation.centre_of_mass_m()[0] - start_m, 1e-12);
  expect_energy_error(outcome, simulation, 1e-3);
}

/// A beam between voxels of one phase is held at length L by the other voxels. It is stretched by L / s - 1, which exceeds the
/// limit 1 at s = L / 2.
void run_walker(Outcome& outcome) {
  std::vector<double> times_s;
  for (const double fraction : {0.9, 0.3}) {
    voxel::Physics physics;
    physics.actuation.amplitude = amplitude;
    physics.integration.time_step_fraction = fraction;
    voxel::Simulation simulation(walker(), edge_m, physics);
    const io::RunStatus status = simulation.advance_to(0.2);
    const auto& divergence = simulation.divergence();
    outcome.expect_status(status, io::RunStatus::diverged, divergence ? voxel::divergence_text(*divergence) : "");
    outcome.expect(divergence && divergence->quantity == "strain", "by its strain");
    times_s.push_back(simulation.time_s());
  }
  const double period_s = voxel::Actuation{}.period_s();
  outcome.expect_between("time s", times_s[0], period_s * std::asin(0.5 / amplitude) / (2.0 * std::numbers::pi), 0.25 * period_s);
  outcome.expect_near("time at a third of the step s", times_s[1], times_s[0], 0.01);
}

}  // namespace

std::vector<Row> voxel_drive_rows() {
  std::vector<Row> rows;
  for (const auto damping : {voxel::DampingMode::increments, voxel::DampingMode::velocity}) {
    rows.push_back({.name = "actuation of 90 percent in phase with damping from " + std::string(to_string(damping)),
                    .done = "floating bar of 5 voxels, in phase, sizes from 0.1 to 1.9 L at 5 Hz, default step",
                    .expected = "completed over two periods; at the turning points the bar has its driven length to 2 %, the "
                                "inertia of a drive at 1/50 of the lowest frequency; the centre of mass stays to rounding",
                    .run = [damping](Outcome& outcome) { run_bar(outcome, damping); }});
  }
  rows.push_back({.name = "actuation of 90 percent in antiphase",
                  .done = "a robot of two materials on the floor, driven by 90 %, default step and a third of it",
                  .expected =
                      "diverged by its strain: voxels that others hold at L / s > 2 times their size are out of the range of "
                      "the beam; from s = L / 2 on, before the turn at T/4, at the same time for both steps",
                  .run = run_walker});
  return rows;
}

}  // namespace menger::extremes
