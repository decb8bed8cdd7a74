#pragma once

#include <array>
#include <vector>

namespace menger::voxel {

/// Loads and constraints on single voxels, for verification and for scenes with more than a free robot. An empty array means
/// none; otherwise it has one entry per voxel.
struct VoxelLoads {
  std::vector<std::array<double, 3>> force_N;                 ///< constant, world axes
  std::vector<std::array<double, 3>> moment_N_m;              ///< constant, world axes
  std::vector<std::array<double, 3>> initial_displacement_m;  ///< from the grid
  /// A voxel that starts with a horizontal velocity starts in kinetic friction.
  std::vector<std::array<double, 3>> initial_velocity_m_s;
  std::vector<std::array<double, 3>> initial_angular_velocity_rad_s;
  std::vector<double> size_factor;  ///< constant factor > 0 on the driven size (a voxel warmer or colder than the others)
  std::vector<bool> fixed;          ///< held in all six degrees of freedom
};

}  // namespace menger::voxel
