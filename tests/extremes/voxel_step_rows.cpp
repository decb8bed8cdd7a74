// Time steps below and above the limit of stability.

#include <algorithm>
#include <cstdint>
#include <numbers>

#include "meshes/design/reference_shapes.h"
#include "tests/extremes/voxel_rows.h"

namespace menger::extremes {

namespace {

constexpr double start_speed_m_per_s = 1e-6;

/// Two undamped voxels in their fastest mode, which shears their beam: omega^2 = 5 E L / m. Two fifths of it come from the masses
/// and three fifths from the inertias m L^2 / 6. The scheme is stable for omega h < 2; the recommended step is sqrt(m / (E L)) /
/// (2 pi).
const double limit_fraction = 4.0 * std::numbers::pi / std::sqrt(5.0);

voxel::Simulation shearing_pair(double part_of_limit) {
  voxel::Physics physics = floating_physics();
  physics.damping_ratios.bond = 0.0;
  physics.integration.time_step_fraction = part_of_limit * limit_fraction;
  voxel::VoxelLoads loads;
  loads.initial_velocity_m_s = {{0.0, -0.5 * start_speed_m_per_s, 0.0}, {0.0, 0.5 * start_speed_m_per_s, 0.0}};
  const double spin = -1.5 * start_speed_m_per_s / edge_m;  // without angular momentum
  loads.initial_angular_velocity_rad_s = {{0.0, 0.0, spin}, {0.0, 0.0, spin}};
  return {meshes::bar(2), edge_m, physics, loads, with_ledger};
}

/// Below the limit the scheme gives the amplitude h v sin(n phi) / sin(phi) after n steps, with cos(phi) = 1 - (omega h)^2 / 2.
void run_stable_step(Outcome& outcome, double part_of_limit) {
  voxel::Simulation simulation = shearing_pair(part_of_limit);
  double largest_m = 0.0;
  double exact_m = 0.0;
  const double angle = std::acos(1.0 - 2.0 * part_of_limit * part_of_limit);
  for (int step = 1; step <= 20000; ++step) {
    const io::RunStatus status = simulation.advance(1);
    if (status != io::RunStatus::completed) return expect_completed(outcome, simulation, status);
    exact_m =
        std::max(exact_m, std::abs(simulation.time_step_s() * start_speed_m_per_s * std::sin(step * angle) / std::sin(angle)));
    largest_m = std::max(largest_m, std::abs(simulation.position_m(1)[1] - simulation.position_m(0)[1]));
  }
  outcome.expect_near("largest shear m", largest_m, exact_m, 1e-5);
  expect_energy_error(outcome, simulation, 1e-6);
}

/// Above the limit the amplitude grows by exp(2 acosh(h / limit)) per step.
void run_unstable_step(Outcome& outcome, double part_of_limit) {
  voxel::Simulation simulation = shearing_pair(part_of_limit);
  const auto budget = static_cast<std::uint64_t>(std::ceil(40.0 / (2.0 * std::acosh(part_of_limit)))) + 20;
  const io::RunStatus status = simulation.advance(budget);
  const auto& divergence = simulation.divergence();
  outcome.expect_status(status, io::RunStatus::diverged, divergence ? voxel::divergence_text(*divergence) : "");
  outcome.expect_at_most("after steps", static_cast<double>(simulation.steps()), static_cast<double>(budget));
}

/// Searches for the largest fraction of the recommended step at which a driven, damped sponge on the floor does not diverge
/// within 0.1 s.
void run_sponge(Outcome& outcome) {
  const auto holds = [](double fraction) {
    voxel::Physics physics;
    physics.integration.time_step_fraction = fraction;
    voxel::Simulation simulation(meshes::menger_sponge(), edge_m, physics);
    return simulation.advance_to(0.1) == io::RunStatus::completed;
  };
  double stable = 0.9;
  double unstable = limit_fraction;
  outcome.expect(holds(stable), "holds at 0.9");
  outcome.expect(!holds(unstable), "diverges at " + shown(unstable, 3));
  for (int halving = 0; halving < 8; ++halving) {
    const double middle = 0.5 * (stable + unstable);
    (holds(middle) ? stable : unstable) = middle;
  }
  outcome.expect_between("limit found at", stable, 1.0, limit_fraction);
}

}  // namespace

std::vector<Row> voxel_step_rows() {
  std::vector<Row> rows;
  for (const double part : {0.5, 0.9, 0.99}) {
    rows.push_back({.name = "step at " + shown(part) + " of the limit",
                    .done = "two undamped voxels in their fastest mode, 20000 steps",
                    .expected =
                        "the largest h v sin(n phi) / sin(phi), cos(phi) = 1 - (omega h)^2 / 2, which the scheme gives in closed "
                        "form, to 1e-5: digits that 20000 steps leave",
                    .run = [part](Outcome& outcome) { run_stable_step(outcome, part); }});
  }
  for (const double part : {1.01, 1.2, 1.5, 2.0}) {
    rows.push_back({.name = "step at " + shown(part) + " of the limit",
                    .done = "two undamped voxels in their fastest mode",
                    .expected =
                        "diverged within 20 + 20 / acosh(h / limit) steps: the amplitude grows by exp(2 acosh(h / limit)) "
                        "per step, and e^40 passes every limit",
                    .run = [part](Outcome& outcome) { run_unstable_step(outcome, part); }});
  }
  rows.push_back({.name = "step of a driven sponge",
                  .done = "bisection of the step for a Menger sponge with default physics, 0.1 s each",
                  .expected = "holds at 0.9 of the recommended step, diverges at 5.6, where two undamped voxels do; the limit "
                              "lies above the recommended step",
                  .run = run_sponge});
  return rows;
}

}  // namespace menger::extremes
