#include "voxel/scene/trajectory.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "meshes/load_cases/observables.h"

namespace menger::voxel {
namespace {

/// The terms of the energy balance in the order of their columns.
constexpr std::pair<const char*, double EnergyLedger::*> energy_columns[] = {
    {"kinetic_J", &EnergyLedger::kinetic_J},
    {"elastic_J", &EnergyLedger::elastic_J},
    {"gravitational_J", &EnergyLedger::gravitational_J},
    {"bond_damping_work_J", &EnergyLedger::bond_damping_work_J},
    {"global_damping_work_J", &EnergyLedger::global_damping_work_J},
    {"actuation_work_J", &EnergyLedger::actuation_work_J},
    {"floor_normal_work_J", &EnergyLedger::floor_normal_work_J},
    {"friction_work_J", &EnergyLedger::friction_work_J},
    {"collision_work_J", &EnergyLedger::collision_work_J},
    {"load_work_J", &EnergyLedger::load_work_J},
};

}  // namespace

std::array<double, 3> displacement_m(const Trajectory& trajectory, const TrajectoryPoint& point) {
  std::array<double, 3> displacement{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    displacement[axis] = point.centre_of_mass_m[axis] - trajectory.front().centre_of_mass_m[axis];
  }
  return displacement;
}

TrajectoryPoint point_at(const Trajectory& trajectory, double time_s) {
  assert(!trajectory.empty());
  const auto after = std::ranges::lower_bound(trajectory, time_s, {}, &TrajectoryPoint::time_s);
  TrajectoryPoint point{.time_s = time_s, .centre_of_mass_m = {}, .energy = {}};
  if (after == trajectory.begin() || after == trajectory.end()) {
    point.centre_of_mass_m = after == trajectory.begin() ? after->centre_of_mass_m : trajectory.back().centre_of_mass_m;
    return point;
  }
  const TrajectoryPoint& before = *(after - 1);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.centre_of_mass_m.at(axis) = std::lerp(before.centre_of_mass_m.at(axis), after->centre_of_mass_m.at(axis), part);
  return point;
}

io::CsvTable trajectory_table(const Trajectory& trajectory, double body_length_m) {
  const bool with_energy = !trajectory.empty() && trajectory.front().energy.has_value();
  std::vector<std::string> columns(meshes::locomotion_columns.begin(), meshes::locomotion_columns.end());
  if (with_energy) {
    for (const auto& [name, term] : energy_columns) columns.emplace_back(name);
    columns.emplace_back("energy_residual_J");
  }

  io::CsvTable table(columns);
  for (const TrajectoryPoint& point : trajectory) {
    const auto& centre = point.centre_of_mass_m;
    const double displacement = meshes::horizontal_displacement(displacement_m(trajectory, point));
    std::vector<io::CsvCell> cells{point.time_s, centre[0], centre[1], centre[2], displacement, displacement / body_length_m};
    if (with_energy) {
      const EnergyLedger& energy = point.energy.value();
      for (const auto& [name, term] : energy_columns) cells.emplace_back(energy.*term);
      cells.emplace_back(energy.residual_J());
    }
    table.add_cells(cells);
  }
  return table;
}

}  // namespace menger::voxel
