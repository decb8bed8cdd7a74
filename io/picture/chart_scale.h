#pragma once

#include <string>
#include <vector>

#include "io/picture/chart.h"

namespace menger::io {

/// A mark on an axis. A logarithmic axis also has small marks without a label between the others.
struct ChartTick {
  double at = 0.0;  ///< as a coordinate
  std::string label;
};

/// Converts values to coordinates along an axis, and holds which part of the axis is shown.
struct ChartScale {
  bool logarithmic = false;
  double low = 0.0;  ///< lower end, as a coordinate
  double high = 1.0;

  /// Returns the value itself, or its logarithm to base ten. @param value positive for a logarithmic scale
  [[nodiscard]] double coordinate(double value) const;

  /// Returns the position of a value as a fraction of the length of the axis: 0 at the low end, 1 at the high end.
  [[nodiscard]] double fraction(double value) const { return (coordinate(value) - low) / (high - low); }

  /// Returns marks at round values. On a linear scale they are 1, 2 or 5 times a power of ten apart. On a logarithmic scale they
  /// are powers of ten; if the axis shows fewer than two of these, also 2 and 5 times them.
  [[nodiscard]] std::vector<ChartTick> ticks() const;
};

/// Returns a scale that shows all finite values with a margin. A linear scale begins or ends at zero if the values come near zero
/// from one side.
/// @param values positive for a logarithmic axis
ChartScale scale_of(const ChartAxis& axis, const std::vector<double>& values);

/// Widens one of two linear scales about its middle so that one unit has the same length on both.
/// @param aspect length of the x axis divided by that of the y axis
void make_equal(ChartScale& x, ChartScale& y, double aspect);

}  // namespace menger::io
