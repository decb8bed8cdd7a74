#pragma once

#include <filesystem>

#include "fem/inflation/inflation_run.h"
#include "io/picture/chart.h"

namespace menger::fem {

/// Draws the pressure of every plenum over its volume, in cubic centimetres and as a change in per cent, with its limit points.
io::PictureOutcome draw_pressure_volume(const std::filesystem::path& file, const InflationResult& result);

/// Draws how far the named points have moved from rest, mm, over the pressure; over the path parameter where plena have different
/// pressures, or none.
io::PictureOutcome draw_displacements(const std::filesystem::path& file, const InflationResult& result);

}  // namespace menger::fem
