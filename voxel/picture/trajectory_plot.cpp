#include "io/picture/chart.h"
#include "meshes/load_cases/observables.h"
#include "voxel/picture/preview.h"

namespace menger::voxel {
namespace {

/// Axes cover at least this many body lengths. Otherwise the small motions of a body at rest would fill the plot.
constexpr double least_span = 0.02;

}  // namespace

io::PictureOutcome plot_trajectory(const std::filesystem::path& file, const Trajectory& trajectory, double body_length_m,
                                   const std::string& name, const io::PictureStyle& style) {
  if (trajectory.size() < 2) return {.missing = "it needs at least two records"};
  io::ChartSeries over_time;
  io::ChartSeries from_above{.colour = io::chart_colour(0)};
  for (const TrajectoryPoint& point : trajectory) {
    const auto displacement = displacement_m(trajectory, point);
    over_time.x.push_back(point.time_s);
    over_time.y.push_back(meshes::horizontal_displacement(displacement) / body_length_m);
    from_above.x.push_back(displacement[0] / body_length_m);
    from_above.y.push_back(displacement[1] / body_length_m);
  }
  const io::ChartSeries start{.name = "start",
                              .x = {from_above.x.front()},
                              .y = {from_above.y.front()},
                              .marks = io::Marks::points,
                              .colour = io::chart_ink};
  const io::ChartSeries end{.name = "end",
                            .x = {from_above.x.back()},
                            .y = {from_above.y.back()},
                            .marks = io::Marks::points,
                            .colour = io::chart_colour(1)};
  const io::ChartPanel displacement{.x = {.title = "time (s)", .lowest = over_time.x.front(), .highest = over_time.x.back()},
                                    .y = {.title = "horizontal displacement (body lengths)", .least_span = least_span},
                                    .series = {over_time}};
  const io::ChartPanel path{.x = {.title = "path from above: x (body lengths)", .least_span = least_span},
                            .y = {.title = "y (body lengths)", .least_span = least_span},
                            .series = {start, end, from_above},
                            .equal_scale = true};
  return io::write_chart(file, {.title = name, .panels = {displacement, path}}, style);
}

}  // namespace menger::voxel
