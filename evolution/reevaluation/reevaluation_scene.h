#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "evolution/reevaluation/reevaluation_comparison.h"
#include "io/picture/picture.h"

namespace menger::evolution {

/// What was written of a design in both models.
struct SceneOutcome {
  std::size_t frames = 0;  ///< with both models
  io::PictureOutcome picture;
  std::vector<std::string> notes;
};

/// Writes a design in both models for ParaView, on one clock: `both.pvd` in a folder, part 0 the frames of finite elements where
/// their run left them, part 1 the surrogate (`voxels_0000.vtu`, ..., see voxel::write_frame) in the same place of the world,
/// moved aside along -y. And `strip.png`, some of these frames in a row per model, each model where it went.
/// @param design with frames in both models; without any nothing is written but a note
/// @throws io::InputError if frames cannot be read or the folder cannot be written to
SceneOutcome write_both_models(const std::filesystem::path& folder, const JudgedDesign& design, bool with_picture);

}  // namespace menger::evolution
