#pragma once

#include <optional>

#include "fem/statics/inflation_path.h"

namespace menger::fem {

/// Returns the extremum of a plenum's pressure between three consecutive states, if the pressure turns at the middle one. It is
/// the extremum of the parabola p(V) through them.
std::optional<LimitPoint> pressure_extremum(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                            std::size_t plenum);

/// Returns the limit point that three states under control by pressure approach. Near a limit point V - V_limit falls as
/// sqrt(p_limit - p), so p is a parabola in V whose top is the limit point. Nothing if the parabola has no top ahead, or one that
/// is more than five times the last step of pressure away.
std::optional<LimitPoint> extrapolated_limit(const PathPoint& first, const PathPoint& second, const PathPoint& third,
                                             std::size_t plenum);

}  // namespace menger::fem
