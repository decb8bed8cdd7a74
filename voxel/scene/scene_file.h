#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/study/study_visitor.h"
#include "voxel/scene/scene.h"

namespace menger::voxel {

/// A scene and the files that it was read from.
struct LoadedScene {
  Scene scene;
  /// The scene's own file, then those of the design and of calibrated parameters if it names them.
  std::vector<std::filesystem::path> files;
};

/// Describes the keys of a scene; menger simulate --keys lists them. Only the design must be given.
void describe(io::StudyVisitor& visitor, Scene& scene);

/// The whole scene as TOML for read_scene, with the design inline and all defaults written out.
std::string scene_text(const Scene& scene);

/// Reads a scene from TOML.
///
/// @param level given by the option --level, which is its name in messages; replaces the level of the file, which must be valid
/// nevertheless
/// @param memory_bytes a scene that needs more is refused before anything is built
/// @throws io::InputError with file, key and value; also for scales too extreme to compute with (unusable_scales), for calibrated
/// parameters that do not suit the design or its drive (unusable_parameters, outside_validity), and for a calibrated body of
/// level 1 in pieces, which could not be cast. One of a higher level runs, with a note (BodyPieces)
LoadedScene read_scene(const std::filesystem::path& file, std::optional<int> level = {},
                       std::size_t memory_bytes = machine_memory_bytes());

}  // namespace menger::voxel
