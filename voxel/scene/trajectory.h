#pragma once

#include <array>
#include <optional>
#include <vector>

#include "io/text/csv_table.h"
#include "voxel/engine/energy_ledger.h"

namespace menger::voxel {

/// Centre of mass and energies of the body at one time.
struct TrajectoryPoint {
  double time_s = 0.0;
  std::array<double, 3> centre_of_mass_m{};
  std::optional<EnergyLedger> energy;  ///< if the energy balance is kept
};

using Trajectory = std::vector<TrajectoryPoint>;

/// Displacement (m) of the centre of mass since the first point of the trajectory.
std::array<double, 3> displacement_m(const Trajectory& trajectory, const TrajectoryPoint& point);

/// The body at a given time, without energies. It is interpolated linearly between records; before the first and after the last
/// record it is that record. Precondition: the trajectory has points, in the order of time.
TrajectoryPoint point_at(const Trajectory& trajectory, double time_s);

/// The trajectory as a table: time_s, centre_of_mass_x_m, _y_m, _z_m, horizontal_displacement_m (since the first point),
/// horizontal_displacement_body_lengths, and the terms of the energy balance if the first point has one.
io::CsvTable trajectory_table(const Trajectory& trajectory, double body_length_m);

}  // namespace menger::voxel
