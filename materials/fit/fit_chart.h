#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "materials/fit/fit_file.h"

namespace menger::materials {

/// Draws a test and its fits: nominal stress over stretch, the measured points with the stable laws in one panel and with the
/// others, dashed, in a second one. The legends give the place in the ranking and the root mean square error. Curves go on beyond
/// the fitted range by a quarter of its strain, to show what the laws make of it.
/// @return what is missing where there is no display @throws io::InputError if the place cannot be written
io::PictureOutcome write_fit_chart(const std::filesystem::path& file, const FitReport& report, const TensileTest& test);

}  // namespace menger::materials
