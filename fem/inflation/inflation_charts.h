#pragma once

#include <filesystem>

#include "fem/inflation/inflation_run.h"
#include "io/picture/chart.h"

namespace menger::fem {

/// Draws the pressure of every plenum over its volume, in cubic centimetres and as a change in per cent, with its limit points.
io::PictureOutcome draw_pressure_volume(const std::filesystem::path& file, const InflationResult& result);

}  // namespace menger::fem
