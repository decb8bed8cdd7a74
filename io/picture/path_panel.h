#pragma once

#include <vector>

#include "io/picture/chart.h"

namespace menger::io {

/// Axes of displacements cover at least this many body lengths, so that the tremor of a body that stays in place does not fill
/// the plot.
inline constexpr double least_path_span = 0.02;

/// Returns the panel of a path that is seen from above, with a point at its start and one at its end.
/// @param x,y displacement of the centre of mass along both axes, body lengths; as many, and at least one
ChartPanel path_panel(std::vector<double> x, std::vector<double> y);

}  // namespace menger::io
