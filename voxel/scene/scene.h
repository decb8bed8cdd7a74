#pragma once

#include <cstddef>
#include <string>

#include "meshes/design/design_file.h"
#include "meshes/design/polycube.h"
#include "voxel/model/parameters.h"

namespace menger::voxel {

/// What is written beside the trajectory.
struct SceneOutput {
  bool frames = true;         ///< the body as .vtu files with their collection
  bool pictures = true;       ///< PNG of the body at the end and of its trajectory
  int records_per_frame = 1;  ///< every n-th record is also a frame, >= 1

  bool operator==(const SceneOutput&) const = default;
};

/// One robot and what happens to it.
struct Scene {
  meshes::Design design;
  int level = 1;  ///< of the fractal, >= 1
  Physics physics;
  double duration_s = 2.0;  ///< > 0
  double record_interval_s =
      0.02;                    ///< > 0, at most duration_s; a record is taken at the first step at or after each multiple of it
  bool energy_ledger = false;  ///< keep the energy balance (slow)
  SceneOutput output;

  bool operator==(const Scene&) const = default;
};

/// More records than this are refused.
inline constexpr double largest_record_count = 1e6;

/// Higher levels are refused. A body two cells long is a million cells long there, and one of a single cell never grows.
inline constexpr int largest_level = 20;

/// Length of a body in metres: cells per side of the aggregate (m^level for a design of m cells along its longest side) times the
/// cell edge.
double body_length_m(const meshes::Design& design, int level);

/// Memory in bytes that simulating a design at a level takes, estimated without building anything; saturates at SIZE_MAX.
/// @param voxels_per_cell along an edge
std::size_t estimated_memory_bytes(const meshes::Polycube& basal_body, int level, int voxels_per_cell = 1);

/// Of a physics: 1 without a surrogate.
int voxels_per_cell(const Physics& physics);

/// Memory of this machine in bytes.
std::size_t machine_memory_bytes();

}  // namespace menger::voxel
