#pragma once

#include <cstddef>

#include "evolution/page/report_page.h"

namespace menger::evolution {

/// Points of a series that a chart draws at most: more are not seen, and take space and time.
inline constexpr std::size_t most_chart_points = 2000;

/// Makes curves of a chart that cannot be told apart one, with the names of all. A dashed curve does not hide another one.
void join_equal_series(PageChart& chart);

/// Thins the longer series of a chart, and says so in its note. Of each stretch of points the lowest, the highest and the first
/// gap stay, and so do the first and the last point, so that the curve looks the same.
void thin_series(PageChart& chart);

}  // namespace menger::evolution
