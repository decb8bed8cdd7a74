#pragma once

#include <array>
#include <cmath>
#include <span>

namespace menger::meshes {

/// Returns the weighted mean of positions, sum(w_i x_i) / sum(w_i), in the unit of the positions. There is one weight (mass) > 0
/// per position.
inline std::array<double, 3> centre_of_mass(std::span<const std::array<double, 3>> positions, std::span<const double> weights) {
  std::array<double, 3> sum{0.0, 0.0, 0.0};
  double total = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += weights[i] * positions[i][axis];
    total += weights[i];
  }
  return {sum[0] / total, sum[1] / total, sum[2] / total};
}

/// Returns the horizontal length sqrt(dx^2 + dy^2) of a displacement (x, y, z up), in its unit.
inline double horizontal_displacement(const std::array<double, 3>& displacement) {
  return std::hypot(displacement[0], displacement[1]);
}

/// The first columns of a table of a robot's motion, for every model: time, centre of mass, and its horizontal displacement from
/// the first row.
inline constexpr std::array<const char*, 6> locomotion_columns{"time_s",
                                                               "centre_of_mass_x_m",
                                                               "centre_of_mass_y_m",
                                                               "centre_of_mass_z_m",
                                                               "horizontal_displacement_m",
                                                               "horizontal_displacement_body_lengths"};

}  // namespace menger::meshes
