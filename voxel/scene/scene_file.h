#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/study/study_visitor.h"
#include "voxel/scene/scene.h"

namespace menger::voxel {

/// A scene and where it came from.
struct LoadedScene {
  Scene scene;
  std::vector<std::filesystem::path>
      files;  ///< that were read: the scene's, then those of the design and of calibrated parameters if it names them
};

/// The keys of a scene; menger simulate --keys lists them. Only the design must be given.
void describe(io::StudyVisitor& visitor, Scene& scene);

/// The whole scene as the TOML that read_scene reads, with the design inline and every default spelled out.
std::string scene_text(const Scene& scene);

/// Reads a scene from TOML.
///
/// @param level of the option --level, by which messages call it; takes the place of the file's, which must be right all the same
/// @param memory_bytes a scene that would need more is refused, before anything is built
/// @throws io::InputError with file, key and value; also for scales that cannot be computed with (unusable_scales), and for
/// calibrated parameters that the design or its drive does not suit (unusable_parameters, outside_validity), or a calibrated body
/// of level 1 in pieces, because it could not be cast; one of a higher level runs, with a note (BodyPieces)
LoadedScene read_scene(const std::filesystem::path& file, std::optional<int> level = {},
                       std::size_t memory_bytes = machine_memory_bytes());

}  // namespace menger::voxel
