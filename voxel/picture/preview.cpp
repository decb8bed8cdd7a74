#include "voxel/picture/preview.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "io/picture/scale_bar.h"
#include "io/text/formatted.h"
#include "voxel/picture/picture_parts.h"
#include "voxel/picture/picture_view.h"

namespace menger::voxel {
namespace {

/// Shifts that place robots on one horizontal line across the picture, with gaps, centred over the origin.
std::vector<Placed> side_by_side(std::span<const Frame> frames, const View& view) {
  constexpr double gap = 0.35;  // of the mean width
  double width = 0.0;
  for (const Frame& frame : frames) width += view_extent(frame, view).size(0);
  const double space = gap * width / static_cast<double>(frames.size());

  std::vector<Placed> robots;
  double across = 0.0;
  for (const Frame& frame : frames) {
    const Extent world = world_extent(frame);
    const Vector middle{world.centre(0), world.centre(1), 0.0};
    const Extent seen = view_extent(frame, view);
    const double left = seen.low[0] - view.coordinates(middle)[0];
    Vector shift{};
    for (std::size_t axis = 0; axis < 3; ++axis) shift[axis] = (across - left) * view.right[axis] - middle[axis];
    robots.push_back({&frame, shift});
    across += seen.size(0) + space;
  }
  return robots;
}

Extent moved(Extent extent, const Vector& shift) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent.low[axis] += shift[axis];
    extent.high[axis] += shift[axis];
  }
  return extent;
}

/// The ground under a robot: its box and its shadow, with a margin around them.
Extent tile_of(const Placed& robot, std::span<const Vector> trail, double ground_height) {
  const Extent box = moved(world_extent(*robot.frame), robot.shift);
  Extent tile = box;
  tile.add(shadow_of(box.high, ground_height));
  tile.add(shadow_of({box.low[0], box.high[1], box.high[2]}, ground_height));
  for (const Vector& point : trail) tile.add({point[0], point[1], ground_height});
  const double margin = 0.12 * std::max(box.size(0), box.size(1));
  for (const std::size_t axis : {0U, 1U}) {
    tile.low[axis] -= margin;
    tile.high[axis] += margin;
  }
  tile.high[2] = tile.low[2] = ground_height;
  return tile;
}

/// Extent of the four corners of a tile, along the axes of the view.
Extent view_of_tile(const Extent& tile, const View& view) {
  Extent seen;
  for (const double x : {tile.low[0], tile.high[0]}) {
    for (const double y : {tile.low[1], tile.high[1]}) seen.add(view.coordinates({x, y, tile.low[2]}));
  }
  return seen;
}

/// Which colour is which material, if a robot has both: "blue: material 1, orange: material 2".
std::string colour_text(const Frame& frame) {
  for (const int material : {1, 2})
    if (std::ranges::find(frame.material, material) == frame.material.end()) return {};
  return "blue: material 1, orange: material 2";
}

/// Where a point is seen in a picture that is aimed: 0 to 1 from left to right and from below.
std::array<double, 2> seen_at(const Vector& point, const View& view, const Extent& seen, double picture_width,
                              double picture_height) {
  const Vector place = view.coordinates(point);
  return {0.5 + (place[0] - seen.centre(0)) / picture_width, 0.5 + (place[1] - seen.centre(1)) / picture_height};
}

void fill_window(vtkRenderWindow& window, const std::vector<Placed>& robots, std::span<const Vector> trail,
                 std::span<const std::string> captions, const RobotStyle& style) {
  const View view = isometric_view();
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  add_light(*renderer);

  double cells_across = 0.0;
  for (const Placed& robot : robots) cells_across += view_extent(*robot.frame, view).size(0) / robot.frame->cell_edge_m;
  const double line_width = io::supersampling * std::clamp(30.0 / cells_across, 0.6, 2.0);

  Extent seen;
  Vector corner{};  // of the ground, where its axes begin
  std::vector<double> middles;
  for (const Placed& robot : robots) {
    const double ground_height = -0.5 * robot.frame->cell_edge_m;
    const Extent body = moved(view_extent(*robot.frame, view), view.coordinates(robot.shift));
    seen.unite(body);
    middles.push_back(body.centre(0));

    const auto surface = robot_surface(robot);
    add_robot(*renderer, *surface, line_width);
    if (!style.floor) continue;
    const Extent tile = tile_of(robot, trail, ground_height);
    corner = tile.low;
    seen.unite(view_of_tile(tile, view));
    const double layer = 0.002 * std::max(tile.size(0), tile.size(1));
    add_floor(*renderer, tile, ground_height - 2.0 * layer);
    add_shadow(*renderer, *surface, ground_height, ground_height - layer);
  }
  if (!trail.empty()) {
    const double ground_height = -0.5 * robots.front().frame->cell_edge_m;
    std::vector<Vector> path(trail.begin(), trail.end());
    for (Vector& point : path) {
      if (style.floor) point[2] = ground_height;
      seen.add(view.coordinates(point));
    }
    add_trail(*renderer, path);
  }

  const int font_size = style.picture.height_px / 36;
  const double bar_m = io::scale_bar_length(0.25 * seen.size(0));
  const bool has_axes = style.floor && !style.title.empty();
  if (has_axes) add_ground_axes(*renderer, corner, 0.5 * bar_m);
  if (!style.title.empty()) {
    add_scale_bar(*renderer, view, seen, bar_m);
    add_caption(*renderer, style.title, 0.5, font_size, 0.95);
    add_caption(*renderer, "bar: " + io::shown(1e3 * bar_m, 3) + " mm" + (trail.empty() ? "" : "; line: the path of the centre"),
                0.5, font_size);
    add_caption(*renderer, colour_text(*robots.front().frame), 0.5, font_size, 0.075);
  }
  window.AddRenderer(renderer);
  const double aspect = static_cast<double>(style.picture.width_px) / style.picture.height_px;
  aim(*renderer, view, seen, aspect, !style.title.empty() ? 0.14 : captions.empty() ? 0.04 : 0.08);
  const double picture_height = 2.0 * renderer->GetActiveCamera()->GetParallelScale();
  const double picture_width = picture_height * aspect;
  for (const std::size_t axis : {0U, 1U}) {  // x goes down in the picture, y up
    if (!has_axes) break;
    Vector end = corner;
    end[axis] += 0.5 * bar_m;
    const auto [across, up] = seen_at(end, view, seen, picture_width, picture_height);
    add_caption(*renderer, axis == 0 ? "x" : "y", across, font_size, axis == 0 ? up - 0.045 : up + 0.012);
  }
  for (std::size_t i = 0; i < captions.size(); ++i) {
    add_caption(*renderer, captions[i], 0.5 + (middles[i] - seen.centre(0)) / picture_width, font_size);
  }
}

}  // namespace

io::PictureOutcome render_robot(const std::filesystem::path& file, const Frame& frame,
                                std::span<const std::array<double, 3>> trail_m, const RobotStyle& style) {
  return io::write_picture(file, style.picture, [&](vtkRenderWindow& window) {
    fill_window(window, {{&frame, {}}}, trail_m, {}, style);
  });
}

io::PictureOutcome render_row(const std::filesystem::path& file, std::span<const Frame> frames,
                              std::span<const std::string> captions, const RobotStyle& style) {
  assert(!frames.empty() && (captions.empty() || captions.size() == frames.size()));
  return io::write_picture(file, style.picture, [&](vtkRenderWindow& window) {
    fill_window(window, side_by_side(frames, isometric_view()), {}, captions, style);
  });
}

}  // namespace menger::voxel
