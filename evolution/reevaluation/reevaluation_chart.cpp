#include "evolution/reevaluation/reevaluation_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "meshes/design/fractal.h"
#include "meshes/load_cases/observables.h"

namespace menger::evolution {
namespace {

constexpr io::Colour diagonal_colour{150, 150, 150};

io::ChartSeries points(std::string name, std::size_t colour) {
  return {.name = std::move(name), .marks = io::Marks::points, .colour = io::chart_colour(colour)};
}

/// A trajectory relative to its start.
struct Path {
  std::vector<double> time_s;
  std::vector<std::array<double, 3>> from_start_m;
};

Path path_of(const voxel::Trajectory& trajectory) {
  Path path;
  for (const voxel::TrajectoryPoint& point : trajectory) {
    path.time_s.push_back(point.time_s);
    path.from_start_m.push_back(voxel::displacement_m(trajectory, point));
  }
  return path;
}

void add_path(io::Chart& chart, const Path& path, const std::string& name, std::size_t colour, double body_length_m) {
  const io::ChartSeries series{.name = name, .marks = io::Marks::line, .colour = io::chart_colour(colour)};
  std::array lines{series, series, series};
  for (std::size_t n = 0; n < path.time_s.size(); ++n) {
    const std::array<double, 3>& moved = path.from_start_m[n];
    lines[0].x.push_back(moved[0] / body_length_m);
    lines[0].y.push_back(moved[1] / body_length_m);
    lines[1].x.push_back(path.time_s[n]);
    lines[1].y.push_back(meshes::horizontal_displacement(moved) / body_length_m);
    lines[2].x.push_back(path.time_s[n]);
    lines[2].y.push_back(moved[2] / body_length_m);
  }
  for (std::size_t panel = 0; panel < lines.size(); ++panel) chart.panels.at(panel).series.push_back(lines.at(panel));
}

}  // namespace

io::Chart scatter_chart(const ReevaluationStudy& study, const ReevaluationFindings& findings) {
  std::array speeds{points("top", 0), points("sample", 1)};
  std::array angles{points("top", 0), points("sample", 1)};
  double largest = 0.0;
  for (const ReevaluatedDesign& design : findings.designs) {
    const auto& surrogate = design.surrogate.result.displacement_m;
    if (!surrogate || !design.elements.displacement_m) continue;
    const std::size_t set = design.design.is_top ? 0 : 1;
    const double x = motion_of(study, *surrogate).body_lengths_per_minute;
    const double y = motion_of(study, *design.elements.displacement_m).body_lengths_per_minute;
    largest = std::max({largest, x, y});
    speeds.at(set).x.push_back(x);
    speeds.at(set).y.push_back(y);
    if (const auto angle = gap_of(study, design).angle_deg) {
      angles.at(set).x.push_back(x);
      angles.at(set).y.push_back(*angle);
    }
  }
  io::ChartPanel speed{.title = "speed",
                       .x = {.title = model_of_search(study) + " (body lengths per minute)"},
                       .y = {.title = "finite elements (body lengths per minute)"},
                       .equal_scale = true};
  io::ChartPanel angle{
      .title = "angle between both directions",
      .x = {.title = model_of_search(study) + " (body lengths per minute)", .lowest = 0.0, .highest = 1.1 * largest + 1e-9},
      .y = {.title = "angle (degrees)", .lowest = 0.0, .highest = 190.0}};
  for (const auto& series : speeds) {
    if (!series.x.empty()) speed.series.push_back(series);
  }
  for (const auto& series : angles) {
    if (!series.x.empty()) angle.series.push_back(series);
  }
  speed.series.push_back({.name = "equal",
                          .x = {0.0, largest},
                          .y = {0.0, largest},
                          .marks = io::Marks::line,
                          .dashed = true,
                          .colour = diagonal_colour});
  angle.markers = {{.at = 45.0, .label = "the same direction, below 45 degrees"}, {.at = 90.0, .label = "a right angle"}};
  return {.title = "", .panels = {speed, angle}};
}

io::Chart trajectories_chart(const ReevaluationStudy& study, const ReevaluatedDesign& design) {
  io::Chart chart;
  chart.panels = {{.x = {.title = "path from above: x (body lengths)"}, .y = {.title = "y (body lengths)"}, .equal_scale = true},
                  {.x = {.title = "time (s)"}, .y = {.title = "horizontal displacement (body lengths)"}},
                  {.x = {.title = "time (s)"}, .y = {.title = "height of the centre above its start (body lengths)"}}};
  const double body_length_m = meshes::body_length_m(study.level, study.search.search.cell_edge_m);
  if (!design.elements.trajectory.empty())
    add_path(chart, path_of(design.elements.trajectory), "finite elements", 1, body_length_m);
  add_path(chart, path_of(design.surrogate.trajectory), model_of_search(study), 0, body_length_m);
  return chart;
}

}  // namespace menger::evolution
