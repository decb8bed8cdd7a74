#include "tests/extremes/voxel_rows.h"

#include <algorithm>
#include <iterator>

#include "tests/extremes/part.h"

namespace menger::extremes {

voxel::Physics still_physics() {
  voxel::Physics physics;
  physics.gravity_m_s2 = gravity_m_per_s2;
  physics.actuation.mode = voxel::ActuationMode::none;
  physics.collisions.exclusion_depth.reset();
  return physics;
}

voxel::Physics floating_physics() {
  voxel::Physics physics = still_physics();
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.0;
  return physics;
}

void expect_energy_error(Outcome& outcome, const voxel::Simulation& simulation, double bound) {
  if (const auto& energies = simulation.energy()) {
    outcome.expect_energy_error(energies->residual_J() / energies->largest_energy_J, bound);
  } else {
    outcome.expect(false, "no energy balance");
  }
}

void expect_completed(Outcome& outcome, const voxel::Simulation& simulation, io::RunStatus status) {
  outcome.expect_status(status, io::RunStatus::completed,
                        simulation.divergence() ? voxel::divergence_text(*simulation.divergence()) : "");
}

meshes::Polycube column(const std::vector<meshes::Material>& materials) {
  meshes::Polycube body(1, 1, static_cast<int>(materials.size()));
  for (std::size_t z = 0; z < materials.size(); ++z) body.set({0, 0, static_cast<int>(z)}, materials[z]);
  return body;
}

meshes::Polycube walker() { return meshes::Polycube::from_digits(3, 3, 3, "101020202111222111121212121"); }

double coupling_of(double poissons_ratio) { return poissons_ratio / (1.0 - poissons_ratio); }

double wide_bar_stiffness(double coupling) { return (1.0 - coupling) * (1.0 + 2.0 * coupling) / (1.0 + coupling); }

double extrapolated(double narrow, double middle, double wide) { return (8.0 * wide - 6.0 * middle + narrow) / 3.0; }

Part part() {
  Part part{.name = "voxel", .rows = {}};
  for (auto& rows : {voxel_contrast_rows(), voxel_drive_rows(), voxel_step_rows(), voxel_floor_rows(), voxel_body_rows(),
                     voxel_coupling_rows(), voxel_solid_bar_rows()})
    std::copy(rows.begin(), rows.end(), std::back_inserter(part.rows));
  return part;
}

}  // namespace menger::extremes
