#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "meshes/design/polycube.h"

namespace menger::voxel {

/// Where and how a run left the range of the model.
struct Divergence {
  std::size_t voxel = 0;        ///< index in grid order
  meshes::CellIndex cell;       ///< its cell
  std::string quantity;         ///< "speed" (m/s), "strain" (1), "strain outside the range of validity" (1) or "not finite"
  std::optional<double> value;  ///< the largest of all voxels; none where it was not finite
  double limit = 0.0;           ///< that the value passed
  double time_s = 0.0;          ///< at the end of the step
};

/// Returns where and how a run diverged, in one line: "voxel 7 (cell 1, 2, 0): speed 1.3, limit 0.9, at 0.02 s". Speeds are in
/// m/s.
std::string divergence_text(const Divergence& divergence);

}  // namespace menger::voxel
