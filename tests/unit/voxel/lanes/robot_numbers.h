#pragma once

#include <cstring>
#include <vector>

#include "voxel/lanes/simulation.h"

namespace menger::voxel {

/// All that the following steps depend on and that a user sees of one robot.
inline std::vector<double> numbers_of(const Simulation& simulation) {
  std::vector<double> numbers{static_cast<double>(simulation.steps())};
  for (std::size_t i = 0; i < simulation.voxel_count(); ++i) {
    for (const double value : simulation.position_m(i)) numbers.push_back(value);
    for (const double value : simulation.orientation(i)) numbers.push_back(value);
    for (const double value : simulation.velocity_m_s(i)) numbers.push_back(value);
    for (const double value : simulation.angular_velocity_rad_s(i)) numbers.push_back(value);
    numbers.push_back(simulation.is_in_static_friction(i) ? 1.0 : 0.0);
  }
  for (const double strain : simulation.frame().strain) numbers.push_back(strain);
  return numbers;
}

inline bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace menger::voxel
