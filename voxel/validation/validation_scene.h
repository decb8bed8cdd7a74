#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/picture.h"
#include "voxel/model/surrogate_parameters.h"
#include "voxel/validation/validation.h"

namespace menger::voxel {

/// What is put beside each other.
struct SideBySide {
  const CurveComparison* comparison = nullptr;
  SurrogateParameters parameters;
  /// Collection of finite elements: one step per row of the curve, else, where nothing but
  /// pressure is applied, of each row the step with its pressure.
  std::optional<std::filesystem::path> fields{};
  std::size_t pictured_row = 0;  ///< of the curve; the next one shown if that is not
};

/// What was written of it.
struct SideBySideOutcome {
  std::size_t states = 0;  ///< with both models, or with the surrogate alone where there are no fields
  io::PictureOutcome picture;
  std::vector<std::string> notes;
};

/// Writes the states of a curve in both models for ParaView, on one clock: `worst.pvd` in a folder with time = row of the curve,
/// part 0 the deformed surface of finite elements (`worst/elements_0000.vtu`, ...; none without fields), part 1 the surrogate as
/// boxes (`worst/voxels_0000.vtu`, ...; see BodyBoxes), moved aside along -y. A free body is shown turned and shifted as the
/// finite elements are on the whole (best fit of rigid motions; without fields not at all), since where its rigid motion is held
/// is not an answer of either model. Cell data of voxels: material, volume_change; field data of both: TimeValue, pressure_Pa,
/// imposed. And `worst.png`, both models in one row of the curve.
/// @throws io::InputError if the fields cannot be read or the folder cannot be written to
SideBySideOutcome write_side_by_side(const std::filesystem::path& folder, const SideBySide& sides, bool with_picture = true);

}  // namespace menger::voxel
