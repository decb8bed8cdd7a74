#pragma once

#include <filesystem>

#include "io/picture/picture.h"
#include "meshes/load_cases/response_curve.h"

namespace menger::fem {

/// Draws a response curve: a panel for each kind of ordinate over the last abscissa, one line for each pressure where there is a
/// second one. @return what is missing where no display can be had @throws io::InputError naming the file if the place cannot be
/// written
io::PictureOutcome draw_response_curve(const std::filesystem::path& file, const meshes::ResponseCurve& curve);

}  // namespace menger::fem
