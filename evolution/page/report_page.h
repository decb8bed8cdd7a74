#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evolution/verdict/finding.h"

namespace menger::evolution {

/// A table of text for people. Numbers are rounded; units are in the titles of the columns.
struct PageTable {
  std::string title{};
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};
  std::string note{};  ///< what is left out, and where everything stands
};

/// How the points of a series are drawn.
enum class PageMarks { line, points, line_and_points };

/// A curve of a chart. A pair with a number that is not finite is a gap.
struct PageSeries {
  std::string name{};
  std::vector<double> x{};
  std::vector<double> y{};
  PageMarks marks = PageMarks::line;
  bool dashed = false;
  int material = 0;                   ///< 1 or 2 if it is of one material: drawn in its colour; otherwise 0
  std::vector<std::string> labels{};  ///< of the points, shown when one is pointed at; none, or as many as points
};

/// A straight line across a chart, explained in its legend.
struct PageMarker {
  bool vertical = true;
  double at = 0.0;
  std::string label{};
};

struct PageAxis {
  std::string title{};  ///< quantity with its unit
  bool logarithmic = false;
};

/// A chart with two axes, drawn by the page as SVG.
struct PageChart {
  std::string title{};
  PageAxis x;
  PageAxis y;
  std::vector<PageSeries> series{};
  std::vector<PageMarker> markers{};
  bool equal_scale = false;  ///< one unit has the same length on both axes
  bool diagonal = false;     ///< with the line of equal values
  std::string note{};
};

/// A PNG picture of the results.
struct PagePicture {
  std::string caption{};  ///< what it shows
  std::string file{};     ///< where it lies, from the folder of the report
  std::string png{};      ///< the bytes of the file
};

/// A body that moves, as the page draws it: the quadrilaterals of its surface and its corners at some times.
///
/// Coordinates are rounded to 16 bits: x = origin_m + scale_m (integer + 32768) along each axis, so that the error is below
/// 1 / 131000 of the largest extent of the motion.
struct PageBody {
  std::string name{};                                 ///< "finite elements", "surrogate"
  std::vector<std::array<std::uint32_t, 4>> faces{};  ///< numbers of corners
  std::size_t corners = 0;
  std::vector<double> times{};            ///< one per frame, in the unit of the scene's clock, increasing
  std::vector<std::int16_t> positions{};  ///< three per corner, corner by corner, frame by frame
  std::array<double, 3> origin_m{};
  double scale_m = 1.0;
  std::vector<std::uint8_t> materials{};            ///< 1 or 2 per face, where the body has both; otherwise empty
  std::vector<std::uint8_t> chambers{};             ///< number of the nearest chamber per face, where pressures are known
  std::vector<std::vector<double>> pressures_Pa{};  ///< per chamber, one per frame; empty if not known
  std::vector<std::array<double, 3>> centres_m{};   ///< of the body, one per frame
  std::vector<double> travelled_m{};  ///< horizontal displacement of the centre of mass, one per frame; may be empty
};

/// Pictures or frames of a stroke: fewer show another motion than there is.
inline constexpr double least_per_stroke = 5.0;

/// Returns whether so many pictures or frames show a stroke. Times of voxels are multiples of a step: a hundredth less counts.
constexpr bool shows_strokes(double per_stroke) { return per_stroke >= least_per_stroke - 0.01; }

/// Bodies that move on one clock, beside each other.
struct PageScene {
  std::string title{};
  std::string source{};
  std::string clock = "time";  ///< what the slider moves
  std::string unit = "s";
  std::optional<double> ground_m{};  ///< height of the ground, if there is one
  std::vector<PageBody> bodies{};
  std::optional<double> angle_deg{};     ///< between the walks of two bodies, where both walk
  std::optional<double> frequency_Hz{};  ///< of the drive
  std::string note{};
  std::string animation{};  ///< name of the file beside the page that shows the same; empty if there is none
};

/// A part of the page under a heading.
struct PageSection {
  std::string title{};
  std::string id{};  ///< letters and hyphens
  std::vector<std::string> words{};
  std::vector<PageChart> charts{};
  std::vector<PageTable> tables{};
};

/// Everything that the page shows.
struct ReportPage {
  std::string title{};
  std::string made{};    ///< by which version, of which folder
  std::string folder{};  ///< of the report, from that of the page; links to sources begin with it
  Verdict verdict;
  PageTable inputs{};  ///< what the results were computed from
  std::vector<PageScene> scenes{};
  std::vector<PageSection> sections{};
  std::vector<PagePicture> pictures{};
  std::vector<std::string> notes{};  ///< what could not be shown, and why
};

}  // namespace menger::evolution
