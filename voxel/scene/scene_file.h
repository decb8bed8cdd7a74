#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "voxel/scene/scene.h"

namespace menger::voxel {

/// A scene and where it came from.
struct LoadedScene {
  Scene scene;
  std::vector<std::filesystem::path>
      files;  ///< that were read: the scene's, then those of the design and of calibrated parameters if it names them
};

/// Reads a scene from TOML.
///
/// `design = "file"` (relative to the scene file) or a table `[design]` with name, cell_edge_m, cells (three integers) and digits
/// (0, 1, 2 of all cells, x fastest, then y, then z); level, duration_s, record_interval_s, energy_ledger; `[output]` frames,
/// pictures, records_per_frame; and the tables of read_physics. Only the design must be given.
///
/// @param level of the option --level, by which messages call it; takes the place of the file's, which must be right all the same
/// @param memory_bytes a scene that would need more is refused, before anything is built
/// @throws io::InputError with file, key and value; also for scales that cannot be computed with (unusable_scales), and for
/// calibrated parameters that the design or its drive does not suit (unusable_parameters, outside_validity), or a calibrated body
/// of level 1 in pieces, because it could not be cast; one of a higher level runs, with a note (BodyPieces)
LoadedScene read_scene(const std::filesystem::path& file, std::optional<int> level = {},
                       std::size_t memory_bytes = machine_memory_bytes());

}  // namespace menger::voxel
