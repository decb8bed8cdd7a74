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

/// The colour of measurements and references in a chart: nearly black, unlike the colours of the series.
inline constexpr Colour chart_ink{38, 38, 38};

/// Returns the colour of a series, counted from 0. There are twelve colours, which then repeat. Colour-blind readers can tell the
/// first eight apart.
Colour chart_colour(std::size_t series);

/// Returns whether two rows of numbers look the same on an axis that spans so much, so that of two curves one hides the other.
bool look_alike(const std::vector<double>& a, const std::vector<double>& b, double span);

/// How the points of a series are drawn.
enum class Marks { line, points, line_and_points };

/// A curve of a chart: points, joined by lines in the order given.
struct ChartSeries {
  std::string name{};       ///< in the legend; the series is not in the legend if empty
  std::vector<double> x{};  ///< as many as y, in the units of the axis title; a point that is not finite is a gap
  std::vector<double> y{};
  Marks marks = Marks::line;
  bool dashed = false;
  /// The colour of the series. If there is none: chart_colour of the number of the series in its panel.
  std::optional<Colour> colour{};
};

/// A straight line across the whole panel that marks a value, such as a limit. The axis is extended to show it.
struct ChartMarker {
  enum class Direction { horizontal, vertical };
  Direction direction = Direction::horizontal;
  double at = 0.0;      ///< y of a horizontal line, x of a vertical one
  std::string label{};  ///< in the legend; the line is not in the legend if empty
};

/// One of the two axes of a panel.
struct ChartAxis {
  std::string title{};       ///< quantity with its unit, as in "pressure (kPa)"
  bool logarithmic = false;  ///< to base ten
  /// The axis spans at least this much, so that noise alone does not fill it. Without effect on a logarithmic axis, or if both
  /// ends are given.
  double least_span = 0.0;
  std::optional<double> lowest{};   ///< lower end of the axis; found from the data if not given
  std::optional<double> highest{};  ///< upper end of the axis, above `lowest`; found from the data if not given
};

/// A pair of axes and what is drawn between them.
struct ChartPanel {
  std::string title{};
  ChartAxis x{};
  ChartAxis y{};
  std::vector<ChartSeries> series{};  ///< the first is drawn on top of the others
  std::vector<ChartMarker> markers{};
  /// Whether one unit has the same length on both axes; the data are then in the middle. For linear axes without given ends.
  bool equal_scale = false;
};

/// A picture of curves: panels side by side, from left to right.
struct Chart {
  std::string title{};
  std::vector<ChartPanel> panels{};
};

/// Draws a chart on a white background and writes it as a PNG file.
///
/// Text is UTF-8; some characters beyond Latin and Greek are not drawn. A panel has a legend if at least one of its series or
/// markers has a name. The legend stands in the corner that the curves leave free.
///
/// A chart has at least one panel. The axes of a panel without points run from about 0 to 1, logarithmic axes from 1 to 10.
/// @return what is missing if no display is available; then no file is written
/// @throws InputError naming file, series and value if a logarithmic axis has a value that is not positive, or if the file cannot
/// be written; nothing is overwritten then
PictureOutcome write_chart(const std::filesystem::path& file, const Chart& chart, const PictureStyle& style = {});

}  // namespace menger::io
