#pragma once

#include <array>
#include <vector>

namespace menger::voxel {

/// Loads and constraints on single voxels, for verification and for scenes beyond a free robot. Empty arrays: none; otherwise one
/// entry per voxel.
struct VoxelLoads {
  std::vector<std::array<double, 3>> force_N;                 ///< constant, world axes
  std::vector<std::array<double, 3>> moment_N_m;              ///< constant, world axes
  std::vector<std::array<double, 3>> initial_displacement_m;  ///< from the grid
  std::vector<std::array<double, 3>>
      initial_velocity_m_s;  ///< a voxel that starts with a horizontal one starts in kinetic friction
  std::vector<std::array<double, 3>> initial_angular_velocity_rad_s;
  std::vector<double> size_factor;  ///< constant factor > 0 on the driven size (a voxel warmer or colder than the others)
  std::vector<bool> fixed;          ///< held in all six degrees of freedom
};

}  // namespace menger::voxel
