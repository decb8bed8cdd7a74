// The smallest and the largest body, and a body that folds onto itself.

#include <algorithm>

#include "meshes/design/reference_shapes.h"
#include "tests/extremes/voxel_rows.h"

namespace menger::extremes {

namespace {

void run_one_voxel(Outcome& outcome) {
  voxel::Simulation simulation(meshes::bar(1), edge_m, still_physics(), {}, with_ledger);
  expect_completed(outcome, simulation, simulation.advance_to(2.0));
  outcome.expect_near("depth m", -simulation.position_m(0)[2], mass_kg * gravity_m_per_s2 / (2.0 * stiffness_N_per_m), 1e-6);
  outcome.expect(simulation.beam_count() == 0, "no beams");
  expect_energy_error(outcome, simulation, 1e-9);
}

/// Every column carries only its own weight. The floor is compressed by n/2 weights over E L, the beam above voxel k by the n - 1
/// - k weights above it.
void run_full_cube(Outcome& outcome) {
  constexpr int n = 27;
  voxel::Physics physics = still_physics();
  physics.damping_ratios.global = 0.05;  // half of the value at which a column of 27 creeps
  voxel::Simulation simulation(meshes::full_cube(n), edge_m, physics);
  expect_completed(outcome, simulation, simulation.advance_to(0.2));
  const double unit_m = mass_kg * gravity_m_per_s2 / stiffness_N_per_m;
  outcome.expect_near("depth of the bottom m", -simulation.position_m(0)[2], 0.5 * n * unit_m, 1e-5);
  const double top_m = simulation.position_m(simulation.voxel_count() - 1)[2];
  outcome.expect_near("shortening m", (n - 1) * edge_m + simulation.position_m(0)[2] - top_m, 0.5 * n * (n - 1) * unit_m, 1e-4);
}

/// A U of 5 x 1 x 9 cells. Its arms, x = 0 and x = 4, are three cells apart and are thrown at each other.
struct ThrownArms {
  static constexpr int width = 5, height = 9;
  meshes::Polycube body{width, 1, height};
  voxel::VoxelLoads loads;
  double start_energy_J = 0.0;
  std::vector<std::size_t> left, right;

  explicit ThrownArms(double tip_speed_m_per_s) {
    for (int x = 0; x < width; ++x) body.set({x, 0, 0}, 1);
    for (int z = 1; z < height; ++z) {
      body.set({0, 0, z}, 1);
      body.set({width - 1, 0, z}, 1);
    }
    loads.initial_velocity_m_s.assign(body.count(), {0.0, 0.0, 0.0});
    for (int z = 1; z < height; ++z) {
      left.push_back(static_cast<std::size_t>(width + 2 * (z - 1)));
      right.push_back(left.back() + 1);
      const double speed = tip_speed_m_per_s * z / (height - 1);
      loads.initial_velocity_m_s[left.back()][0] = speed;
      loads.initial_velocity_m_s[right.back()][0] = -speed;
      start_energy_J += mass_kg * speed * speed;
    }
  }
};

double distance_m(const voxel::Simulation& simulation, std::size_t a, std::size_t b) {
  const auto p = simulation.position_m(a);
  const auto q = simulation.position_m(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// The contact of two voxels has the stiffness 2 E L, so an overlap d takes E L d^2 of the initial energy.
void run_folding(Outcome& outcome) {
  const ThrownArms arms(3.0);
  voxel::Physics physics = floating_physics();
  physics.damping_ratios.global = 0.02;
  physics.collisions.exclusion_depth = 1;
  physics.integration.time_step_fraction = 0.225;
  voxel::Simulation simulation(arms.body, edge_m, physics, arms.loads, with_ledger);
  const std::array<double, 3> start_m = simulation.centre_of_mass_m();
  double nearest_m = 1.0;
  for (int record = 0; record < 12000; ++record) {
    const io::RunStatus status = simulation.advance(10);
    if (status != io::RunStatus::completed) return expect_completed(outcome, simulation, status);
    for (const std::size_t a : arms.left)
      for (const std::size_t b : arms.right) nearest_m = std::min(nearest_m, distance_m(simulation, a, b));
  }
  const double touching_m = 1.25 * edge_m;
  const double deepest_m = std::sqrt(arms.start_energy_J / stiffness_N_per_m);
  outcome.expect_between("least distance of the arms m", nearest_m, touching_m - deepest_m, touching_m);
  const std::array<double, 3> end_m = simulation.centre_of_mass_m();
  outcome.expect_at_most("drift of the centre of mass across m", end_m[0] - start_m[0], 1e-10);
  outcome.expect_near("distance of the tips of the opened robot m", distance_m(simulation, arms.left.back(), arms.right.back()),
                      (ThrownArms::width - 1) * edge_m, 1e-3);
  expect_energy_error(outcome, simulation, 1e-2);
}

}  // namespace

std::vector<Row> voxel_body_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "robot of one voxel",
                  .done = "it lies on the floor for 2 s",
                  .expected = "sinks by its weight over 2 E L, to 1e-6",
                  .run = run_one_voxel});
  rows.push_back(
      {.name = "full cube of 27",
       .done = "19683 voxels settle under their weight for 0.2 s",
       .expected = "sinks and shortens by the sums of weights over stiffnesses, to 1e-4: what the slowest mode has left",
       .is_slow = true,
       .run = run_full_cube});
  rows.push_back({.name = "folded robot",
                  .done = "arms of a floating U are thrown at each other with 3 m/s at their tips",
                  .expected =
                      "they touch, and overlap by no more than the kinetic energy can press, sqrt(E0 / (E L)); the U opens "
                      "again; its centre of mass stays; energy to 1 %, what the switch between small and large angles costs",
                  .run = run_folding});
  return rows;
}

}  // namespace menger::extremes
