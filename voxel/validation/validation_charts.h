#pragma once

#include <filesystem>
#include <vector>

#include "io/picture/picture.h"
#include "voxel/validation/validation.h"

namespace menger::voxel {

/// Draws the errors inside the range of validity: for each kind of observable the share of numbers whose error is no larger, and
/// the errors in displacement and volume over pressure, by body. @param aim a line at this error
/// @throws io::InputError if the place cannot be written
io::PictureOutcome draw_errors(const std::filesystem::path& file, const std::vector<CurveComparison>& comparisons, double aim);

/// Draws a curve in both models, a panel for each quantity: points are finite elements, lines the surrogate.
/// @throws io::InputError if the place cannot be written
io::PictureOutcome draw_curve(const std::filesystem::path& file, const CurveComparison& comparison);

}  // namespace menger::voxel
