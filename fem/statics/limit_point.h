#pragma once

#include <optional>

#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// The extremum of a plenum's pressure between three consecutive states, if it turns in the middle one: that of the parabola
/// through them, p over V.
std::optional<LimitPoint> pressure_extremum(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                            std::size_t plenum);

/// The limit point that three states under control by pressure approach: near it V - V_limit falls as sqrt(p_limit - p), so p is
/// a parabola in V with its top there. Nothing if the parabola has no top ahead, or one that is further away than a few times the
/// last step of pressure.
std::optional<LimitPoint> extrapolated_limit(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                             std::size_t plenum);

}  // namespace menger::fem
