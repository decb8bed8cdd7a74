#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "io/picture/picture.h"

namespace menger::evolution {

/// The outcome of write_both_models.
struct SceneOutcome {
  std::size_t frames = 0;  ///< number of frames with both models
  io::PictureOutcome picture;
  std::vector<std::string> notes;
};

/// Writes the motion of a design in both models, at the same times, for ParaView: `both.pvd` in a folder.
///
/// Part 0 is the frames of finite elements, which stay in the folder of their run. Part 1 is the surrogate (`voxels_0000.vtu`,
/// ..., see voxel::write_frame) in the same coordinates: both bodies begin at the same place. Also draws `strip.png`: some of
/// these frames, a row per model, both in the same coordinates.
/// @param design has frames in both models; without any, there is only a note and no file
/// @throws io::InputError if frames cannot be read or the folder cannot be written to
SceneOutcome write_both_models(const std::filesystem::path& folder, const ReevaluatedDesign& design, bool with_picture);

}  // namespace menger::evolution
