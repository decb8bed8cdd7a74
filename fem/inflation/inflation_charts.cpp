#include "fem/inflation/inflation_charts.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/shown/shown_quantity.h"

namespace menger::fem {
namespace {

/// with more plena, colours repeat and there is no legend
constexpr std::size_t largest_named_count = 12;

/// The scale of a volume axis.
enum class VolumeScale { cubic_centimetres, per_cent };

double on_axis(VolumeScale scale, double volume_m3, double rest_m3) {
  return scale == VolumeScale::cubic_centimetres ? 1e6 * volume_m3 : 100.0 * (volume_m3 / rest_m3 - 1.0);
}

std::string limit_label(const LimitPoint& limit) { return "limit point " + io::kilopascals(limit.pressure_Pa, 4); }

io::ChartPanel panel(const InflationResult& result, VolumeScale scale) {
  io::ChartPanel panel;
  panel.x.title = scale == VolumeScale::cubic_centimetres ? "chamber volume (cm³)" : "change of chamber volume (%)";
  panel.y.title = "pressure (kPa)";
  const PathPoint& rest = result.path.points.front();
  const bool named = result.plenum_names.size() > 1 && result.plenum_names.size() <= largest_named_count;
  for (std::size_t p = 0; p < result.plenum_names.size(); ++p) {
    io::ChartSeries series{.name = named ? result.plenum_names[p] : "",
                           .marks = io::Marks::line_and_points,
                           // Chambers alike have the same curve: the one below shows through the gaps.
                           .dashed = p % 2 == 1,
                           .colour = io::chart_colour(p)};
    for (const PathPoint& point : result.path.points) {
      series.x.push_back(on_axis(scale, point.plenum_volumes_m3[p], rest.plenum_volumes_m3[p]));
      series.y.push_back(1e-3 * point.pressures_Pa[p]);
    }
    panel.series.push_back(std::move(series));
  }
  for (const LimitPoint& limit : result.path.limit_points) {
    io::ChartSeries mark{.name = limit_label(limit), .marks = io::Marks::points, .colour = io::chart_ink};
    mark.x = {on_axis(scale, limit.volume_m3, rest.plenum_volumes_m3[limit.plenum])};
    mark.y = {1e-3 * limit.pressure_Pa};
    panel.series.insert(panel.series.begin(), std::move(mark));
  }
  return panel;
}

/// Whether all plena have the same pressure all along the path, and it is not zero throughout.
bool has_one_pressure(const std::vector<PathPoint>& points) {
  bool is_pressed = false;
  for (const PathPoint& point : points) {
    const auto [low, high] = std::ranges::minmax_element(point.pressures_Pa);
    if (low == point.pressures_Pa.end() || *low != *high) return false;
    is_pressed = is_pressed || *low != 0.0;
  }
  return is_pressed;
}

}  // namespace

io::PictureOutcome draw_pressure_volume(const std::filesystem::path& file, const InflationResult& result) {
  if (result.path.points.empty()) return {.written = false, .missing = "the path has no points"};
  const io::Chart chart{.title = "pressure over volume",
                        .panels = {panel(result, VolumeScale::cubic_centimetres), panel(result, VolumeScale::per_cent)}};
  return io::write_chart(file, chart, {.width_px = 2000, .height_px = 900});
}

io::PictureOutcome draw_displacements(const std::filesystem::path& file, const InflationResult& result) {
  const std::vector<PathPoint>& points = result.path.points;
  if (points.empty() || result.point_names.empty()) return {.written = false, .missing = "there are no points"};
  const bool is_over_pressure = has_one_pressure(points);
  io::ChartPanel panel;
  panel.x.title = is_over_pressure ? "pressure (kPa)" : "path parameter: the knots of the path are 0, 1, 2, ...";
  panel.y.title = "distance from its place at rest (mm)";
  for (std::size_t n = 0; n < result.point_names.size(); ++n) {
    io::ChartSeries series{
        .name = result.point_names[n], .marks = io::Marks::line_and_points, .dashed = n % 2 == 1, .colour = io::chart_colour(n)};
    for (std::size_t at = 0; at < points.size(); ++at) {
      const Point& moved_m = result.observations[at][n].displacement_m;
      series.x.push_back(is_over_pressure ? 1e-3 * points[at].pressures_Pa.front() : points[at].s);
      series.y.push_back(1e3 * std::hypot(moved_m[0], moved_m[1], moved_m[2]));
    }
    panel.series.push_back(std::move(series));
  }
  return io::write_chart(file, {.title = "how far points move", .panels = {panel}}, {.width_px = 1400, .height_px = 900});
}

}  // namespace menger::fem
