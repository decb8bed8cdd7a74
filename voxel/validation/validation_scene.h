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

/// The comparison that is shown side by side, and its data.
struct SideBySide {
  const CurveComparison* comparison = nullptr;
  SurrogateParameters parameters;
  /// Collection of finite element fields: one step per row of the curve. Otherwise, if only pressure is applied, each row uses
  /// the step with its pressure.
  std::optional<std::filesystem::path> fields{};
  std::size_t pictured_row = 0;  ///< row of the curve; if it is not shown, the next one shown
  std::string finding{};         ///< what is wrong in that row, for the picture
};

/// The written states, the picture, and notes.
struct SideBySideOutcome {
  std::size_t states = 0;  ///< shown with both models, or with the surrogate alone if there are no fields
  io::PictureOutcome picture;
  std::vector<std::string> notes;
};

/// Writes the states of a curve in both models for ParaView, and a picture of both.
///
/// `worst.pvd` in a folder has time = row of the curve. Part 0 is the deformed surface of finite elements
/// (`worst/elements_0000.vtu`, ...; none without fields). Part 1 is the surrogate as boxes (`worst/voxels_0000.vtu`, ...; see
/// BodyBoxes). Both are in the same coordinates, by the convention of io/vtk/README.md. A free body of the surrogate is rotated
/// and shifted to the rigid motion of the finite elements (best fit; not without fields), because that motion depends on where
/// the body is held and is not a response of either model. Point data of voxels: displacement_m. Cell data: material,
/// volume_ratio (the active scalars). Field data of both: TimeValue, pressure_Pa, imposed. `worst.png` shows both models side by
/// side in one row of the curve, each with the outline of the body at rest. A validation shows the state whose shape is furthest
/// off in lengths, see furthest_off(), not the largest error in per cent: that can be of a curve that hardly answers.
/// @throws io::InputError if the fields cannot be read or the folder cannot be written to
SideBySideOutcome write_side_by_side(const std::filesystem::path& folder, const SideBySide& sides, bool with_picture = true);

}  // namespace menger::voxel
