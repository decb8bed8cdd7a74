// Neighbours whose properties differ by orders of magnitude.

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/extremes/voxel_rows.h"

namespace menger::extremes {

namespace {

using voxel::Simulation;

/// A column that hangs from its top voxel. The stretch of each beam is the weight below it divided by its stiffness.
struct HangingColumn {
  std::vector<meshes::Material> materials;
  voxel::Physics physics = still_physics();

  [[nodiscard]] double mass(std::size_t voxel) const {
    return physics.materials[static_cast<std::size_t>(materials[voxel] - 1)].density_kg_m3 * std::pow(edge_m, 3);
  }

  [[nodiscard]] double stretch_m(std::size_t beam) const {
    const auto modulus = [&](std::size_t voxel) {
      return physics.materials[static_cast<std::size_t>(materials[voxel] - 1)].youngs_modulus_Pa;
    };
    double weight_N = 0.0;
    for (std::size_t voxel = 0; voxel <= beam; ++voxel) weight_N += mass(voxel) * physics.gravity_m_s2;
    const double harmonic_mean_Pa = 2.0 * modulus(beam) * modulus(beam + 1) / (modulus(beam) + modulus(beam + 1));
    return weight_N / (harmonic_mean_Pa * edge_m);
  }

  void expect_stretches(Outcome& outcome, double time_s, double tolerance, double energy_bound) {
    physics.floor = false;
    voxel::VoxelLoads loads;
    loads.fixed.assign(materials.size(), false);
    loads.fixed.back() = true;
    Simulation simulation(column(materials), edge_m, physics, loads, with_ledger);
    expect_completed(outcome, simulation, simulation.advance_to(time_s));
    outcome.note(std::to_string(simulation.steps()) + " steps of " + shown(simulation.time_step_s(), 2) + " s");
    for (std::size_t beam = 0; beam + 1 < materials.size(); ++beam) {
      const double stretched = simulation.position_m(beam + 1)[2] - simulation.position_m(beam)[2] - edge_m;
      outcome.expect_near("beam " + std::to_string(beam) + " m", stretched, stretch_m(beam), tolerance);
    }
    expect_energy_error(outcome, simulation, energy_bound);
  }
};

/// A plate of 3 x 3 soft voxels on four stiff feet of one voxel each stands on the floor.
void run_stiff_feet(Outcome& outcome, double modulus_ratio) {
  const meshes::Polycube body = meshes::Polycube::from_digits(3, 3, 2, "202000202111111111");
  voxel::Physics physics = still_physics();
  physics.materials[1].youngs_modulus_Pa = modulus_ratio * modulus_Pa;
  Simulation simulation(body, edge_m, physics);
  constexpr std::size_t feet = 4;  // the first voxels
  double highest_m = 0.0;
  io::RunStatus status = io::RunStatus::completed;
  for (int part = 1; part <= 200 && status == io::RunStatus::completed; ++part) {
    status = simulation.advance_to(0.5 / 200.0 * part);
    for (std::size_t foot = 0; foot < feet; ++foot) highest_m = std::max(highest_m, simulation.position_m(foot)[2]);
  }
  expect_completed(outcome, simulation, status);
  outcome.note(std::to_string(simulation.steps()) + " steps of " + shown(simulation.time_step_s(), 2) + " s");
  const double depth_m = static_cast<double>(body.count()) * mass_kg * gravity_m_per_s2 /
                         (static_cast<double>(feet) * 2.0 * modulus_ratio * stiffness_N_per_m);
  outcome.expect_at_most("hop of a foot m", highest_m, 1e-6);
  for (std::size_t foot = 0; foot < feet; ++foot)
    outcome.expect_near("depth of a foot m", -simulation.position_m(foot)[2], depth_m, 1e-4);
}

}  // namespace

std::vector<Row> voxel_contrast_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "modulus ratio 1e6",
                  .done = "column of 10 GPa and 10 kPa voxels hangs under its weight",
                  .expected =
                      "each beam is stretched by the weight below it over E L, E the harmonic mean, to 1e-4: a stiff beam "
                      "by 3e-12 m, read from positions of 3 cm with seven digits left; the stiffest beam sets the step",
                  .run = [](Outcome& outcome) {
                    HangingColumn hanging{{2, 1, 2, 2}};
                    hanging.physics.damping_ratios.global = 5e-4;  // half of the value at which a stiff voxel creeps on soft ones
                    hanging.physics.materials[1].youngs_modulus_Pa = 1e6 * modulus_Pa;
                    hanging.expect_stretches(outcome, 0.05, 1e-4, 1e-6);
                  }});
  rows.push_back({.name = "mass ratio 1e4",
                  .done = "column of 10 kg/m^3 and 1e5 kg/m^3 voxels hangs under a hundredth of its weight",
                  .expected = "each beam is stretched by the weight below it over E L to 1e-4; the lightest voxel sets the step",
                  .run = [](Outcome& outcome) {
                    HangingColumn hanging{{1, 2, 1, 1}};
                    hanging.physics.damping_ratios.global = 0.05;
                    hanging.physics.materials[1].density_kg_m3 = 1e5;
                    hanging.physics.gravity_m_s2 = 0.01 * gravity_m_per_s2;
                    hanging.expect_stretches(outcome, 10.0, 1e-4, 1e-6);
                  }});
  for (const double ratio : {100.0, 1000.0}) {
    rows.push_back({.name = "feet of modulus ratio " + shown(ratio),
                    .done = "a plate of 10 kPa on four feet of " + shown(ratio) + " times that, one voxel each, stands for 0.5 s",
                    .expected = "no foot hops, by more than the beams of a settling plate could lift it, 1e-6 m; each sinks by a "
                                "quarter of the weight over 2 E L, to 1e-4; the foot on the floor sets the step, not its beam",
                    .run = [ratio](Outcome& outcome) { run_stiff_feet(outcome, ratio); }});
  }
  return rows;
}

}  // namespace menger::extremes
