#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "materials/fit/fit_file.h"

namespace menger::materials {

/// Draws a chart of a test and its fits: nominal stress over stretch.
///
/// The first panel shows the measured points with the stable laws, the second one with the other laws, dashed. The legends show
/// the place in the ranking and the root mean square error. The curves extend beyond the fitted range by a quarter of its strain,
/// to show how the laws extrapolate.
/// @return what is missing if no display is available
/// @throws io::InputError if the file cannot be written
io::PictureOutcome write_fit_chart(const std::filesystem::path& file, const FitReport& report, const TensileTest& test);

}  // namespace menger::materials
