#pragma once

#include <cstddef>
#include <string>

#include "meshes/design/design_file.h"
#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// What a run writes in addition to the trajectory.
struct SceneOutput {
  bool frames = true;         ///< the body as .vtu files, with their collection
  bool pictures = true;       ///< PNG pictures of the body at the end and of its trajectory
  int records_per_frame = 1;  ///< every n-th record is also a frame, >= 1

  bool operator==(const SceneOutput&) const = default;
};

/// One robot, its physics, and the simulation to run.
struct Scene {
  meshes::Design design;
  int level = 1;  ///< of the fractal, >= 1
  Physics physics;
  double duration_s = 2.0;  ///< > 0
  /// > 0, at most duration_s. A record is taken at the first step at or after each multiple of it.
  double record_interval_s = 0.02;
  bool energy_ledger = false;  ///< keep the energy balance (slow)
  SceneOutput output;

  bool operator==(const Scene&) const = default;
};

/// Scenes with more records than this are refused.
inline constexpr double largest_record_count = 1e6;

/// Higher levels are refused. At this level a body two cells long is a million cells long; a body of a single cell never grows.
inline constexpr int largest_level = 20;

/// Estimates the memory in bytes for simulating a design at a level, without building anything. Saturates at SIZE_MAX.
/// @param voxels_per_cell along an edge
std::size_t estimated_memory_bytes(const meshes::Polycube& basal_body, int level, int voxels_per_cell);

/// Voxels per cell edge of a physics: 1 without a surrogate.
int voxels_per_cell(const Physics& physics);

/// Memory of this machine in bytes.
std::size_t machine_memory_bytes();

}  // namespace menger::voxel
