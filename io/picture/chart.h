#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/picture/picture.h"

namespace menger::io {

/// Red, green and blue, 0 to 255.
using Colour = std::array<unsigned char, 3>;

/// Nearly black, for measurements and references beside the colours of a chart.
inline constexpr Colour chart_ink{38, 38, 38};

/// A colour for each of twelve series, which then repeat; the first eight are told apart by colour-blind readers too.
Colour chart_colour(std::size_t series);

/// How the points of a series are drawn.
enum class Marks { line, points, line_and_points };

/// Points in the order in which lines join them.
struct ChartSeries {
  std::string name{};       ///< in the legend; none if empty
  std::vector<double> x{};  ///< as many as y, in the units of the axis title; a point that is not finite is a gap
  std::vector<double> y{};
  Marks marks = Marks::line;
  bool dashed = false;
  std::optional<Colour> colour{};  ///< chart_colour of the place among the series of the panel if there is none
};

/// A straight line across the whole panel that marks a value, such as a limit. The axis is made long enough to show it.
struct ChartMarker {
  enum class Direction { horizontal, vertical };
  Direction direction = Direction::horizontal;
  double at = 0.0;      ///< y of a horizontal line, x of a vertical one
  std::string label{};  ///< written along the line; none if empty
};

/// One of the two axes of a panel.
struct ChartAxis {
  std::string title{};             ///< quantity with its unit, as in "pressure (kPa)"
  bool logarithmic = false;        ///< to base ten
  double least_span = 0.0;         ///< the axis covers at least this much, so that noise alone does not fill it; linear axes only
  std::optional<double> lowest{};  ///< end of the axis; found from the data where not given
  std::optional<double> highest{};  ///< above lowest
};

/// A pair of axes and what is drawn between them.
struct ChartPanel {
  std::string title{};
  ChartAxis x{};
  ChartAxis y{};
  std::vector<ChartSeries> series{};  ///< the first on top of the others
  std::vector<ChartMarker> markers{};
  bool equal_scale = false;  ///< one unit is as long on either axis, the data in the middle; for linear axes without given ends
};

/// A picture of curves: panels side by side, from left to right.
struct Chart {
  std::string title{};
  std::vector<ChartPanel> panels{};
};

/// Draws a chart as PNG on white. Text is UTF-8; of signs beyond Latin and Greek not all are drawn. A panel has a legend if any
/// of its series has a name, in the corner that the curves leave free.
///
/// A chart has at least one panel. The axes of a panel without a point run from about 0 to 1, logarithmic ones from 1 to 10.
/// @return what is missing where no display can be had; then there is no file
/// @throws InputError naming file, series and value if a value that is not positive is to stand on a logarithmic axis, or if the
/// place cannot be written; nothing is written over then
PictureOutcome write_chart(const std::filesystem::path& file, const Chart& chart, const PictureStyle& style = {});

}  // namespace menger::io
