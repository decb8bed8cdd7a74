#include <utility>
#include <vector>

#include "io/picture/chart.h"
#include "io/picture/path_panel.h"
#include "meshes/load_cases/observables.h"
#include "voxel/picture/preview.h"

namespace menger::voxel {

io::PictureOutcome plot_trajectory(const std::filesystem::path& file, const Trajectory& trajectory, double body_length_m,
                                   const std::string& name, const io::PictureStyle& style) {
  if (trajectory.size() < 2) return {.missing = "it needs at least two records"};
  io::ChartSeries over_time;
  std::vector<double> x;
  std::vector<double> y;
  for (const TrajectoryPoint& point : trajectory) {
    const auto displacement = displacement_m(trajectory, point);
    over_time.x.push_back(point.time_s);
    over_time.y.push_back(meshes::horizontal_displacement(displacement) / body_length_m);
    x.push_back(displacement[0] / body_length_m);
    y.push_back(displacement[1] / body_length_m);
  }
  const io::ChartPanel displacement{.x = {.title = "time (s)", .lowest = over_time.x.front(), .highest = over_time.x.back()},
                                    .y = {.title = "horizontal displacement (body lengths)", .least_span = io::least_path_span},
                                    .series = {over_time}};
  const io::ChartPanel path = io::path_panel(std::move(x), std::move(y));
  return io::write_chart(file, {.title = name, .panels = {displacement, path}}, style);
}

}  // namespace menger::voxel
