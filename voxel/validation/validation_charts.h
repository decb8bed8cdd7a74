#pragma once

#include <filesystem>
#include <vector>

#include "io/picture/chart.h"
#include "io/picture/picture.h"
#include "voxel/validation/validation.h"

namespace menger::voxel {

/// Returns the chart of the errors inside the range of validity; of a kind of observable that has none inside, of those outside.
/// One panel has, for each kind, the fraction of numbers whose error is no larger; two others the errors in displacement and
/// volume over pressure, by body. @param aim error at which a line is drawn
io::Chart errors_chart(const std::vector<CurveComparison>& comparisons, double aim);

/// Draws it. @throws io::InputError if the place cannot be written
io::PictureOutcome draw_errors(const std::filesystem::path& file, const std::vector<CurveComparison>& comparisons, double aim);

/// Returns the chart of a curve of both models, see draw_curve. What coincides in both models is one curve with both names.
io::Chart curve_chart(const CurveComparison& comparison);

/// Draws a curve of both models, with one panel per quantity. Points are finite elements, lines are the surrogate.
/// @throws io::InputError if the place cannot be written
io::PictureOutcome draw_curve(const std::filesystem::path& file, const CurveComparison& comparison);

}  // namespace menger::voxel
