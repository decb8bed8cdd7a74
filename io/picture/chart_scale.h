#pragma once

#include <string>
#include <vector>

#include "io/picture/chart.h"

namespace menger::io {

/// A mark on an axis; small ones, without label, stand between those of a logarithmic axis.
struct ChartTick {
  double at = 0.0;  ///< as a coordinate
  std::string label;
};

/// How values become coordinates along an axis, and which part of it is shown.
struct ChartScale {
  bool logarithmic = false;
  double low = 0.0;  ///< as a coordinate
  double high = 1.0;

  /// The value itself, or its logarithm to base ten. @param value positive for a logarithmic scale
  [[nodiscard]] double coordinate(double value) const;

  /// Distance from the low end by the length of the axis.
  [[nodiscard]] double fraction(double value) const { return (coordinate(value) - low) / (high - low); }

  /// Round values: 1, 2 or 5 times powers of ten apart on a linear scale; powers of ten on a logarithmic one, or 1, 2 and 5 times
  /// them where it shows less than two.
  [[nodiscard]] std::vector<ChartTick> ticks() const;
};

/// A scale that shows all finite values with a margin, from zero on where they come near it from one side.
/// @param values positive for a logarithmic axis
ChartScale scale_of(const ChartAxis& axis, const std::vector<double>& values);

/// Widens one of two linear scales about its middle so that one unit is as long on both. @param aspect length of x by that of y
void make_equal(ChartScale& x, ChartScale& y, double aspect);

}  // namespace menger::io
