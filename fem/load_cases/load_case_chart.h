#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "meshes/load_cases/response_curve.h"

namespace menger::fem {

/// Draws a response curve: a panel for each kind of ordinate over the last abscissa. If there is a second abscissa, each pressure
/// has its own line.
/// @return what is missing if there is no display
/// @throws io::InputError naming the file if it cannot be written
io::PictureOutcome draw_response_curve(const std::filesystem::path& file, const meshes::ResponseCurve& curve);

}  // namespace menger::fem
