#include "evolution/posture/bend.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "evolution/posture/frame_grid.h"
#include "evolution/posture/two_numbers.h"
#include "io/process/child_reading.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/vtk/collection.h"
#include "meshes/load_cases/body_extents.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;
using Place = std::array<double, 3>;

/// Points of a body at rest, and where they are in the last state.
struct MovedPoints {
  std::vector<Place> rest_m;
  std::vector<Place> now_m;

  void add(const MovedPoints& from, std::size_t n) {
    rest_m.push_back(from.rest_m[n]);
    now_m.push_back(from.now_m[n]);
  }
};

MovedPoints read_points(const fs::path& first, const fs::path& last) {
  const auto rest = read_frame_grid(first);
  const auto now = read_frame_grid(last);
  vtkDataArray* moved = now->GetPointData()->GetArray("displacement_m");
  if (moved == nullptr || now->GetNumberOfPoints() != rest->GetNumberOfPoints())
    throw io::InputError(last.string() + ": is of another mesh than the first state");
  MovedPoints points;
  for (vtkIdType n = 0; n < rest->GetNumberOfPoints(); ++n) {
    Place place{};
    rest->GetPoint(n, place.data());
    points.rest_m.push_back(place);
    for (std::size_t axis = 0; axis < 3; ++axis) place.at(axis) += moved->GetComponent(n, static_cast<int>(axis));
    points.now_m.push_back(place);
  }
  return points;
}

Place mean_of(const std::vector<Place>& places) {
  Place mean{};
  for (const Place& place : places)
    for (std::size_t i = 0; i < 3; ++i) mean.at(i) += place.at(i) / static_cast<double>(places.size());
  return mean;
}

std::pair<double, double> range_along(const std::vector<Place>& places, std::size_t axis) {
  const auto [low, high] = std::ranges::minmax(places, {}, [&](const Place& place) { return place.at(axis); });
  return {low.at(axis), high.at(axis)};
}

/// The points within a distance of an end of the box around all.
MovedPoints near_end(const MovedPoints& points, std::size_t axis, bool is_high, double within_m) {
  const auto [low, high] = range_along(points.rest_m, axis);
  constexpr double rounding = 1e-6;  // of their extent
  const double margin_m = within_m + rounding * (high - low);
  MovedPoints found;
  for (std::size_t n = 0; n < points.rest_m.size(); ++n) {
    const double at = points.rest_m[n].at(axis);
    if (is_high ? at >= high - margin_m : at <= low + margin_m) found.add(points, n);
  }
  return found;
}

Bend bend_of(const MovedPoints& points, double cell_edge_m) {
  std::size_t longest = 0;
  double length_m = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_along(points.rest_m, axis);
    if (high - low <= length_m) continue;
    longest = axis;
    length_m = high - low;
  }
  const MovedPoints held = near_end(points, longest, false, cell_edge_m);
  const MovedPoints far = near_end(points, longest, true, 0.0);
  meshes::EndPoints rest{};
  meshes::EndPoints now{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) {
      const MovedPoints end = near_end(held, axis, is_high, 0.0);
      rest.at(axis).at(is_high ? 1 : 0) = mean_of(end.rest_m);
      now.at(axis).at(is_high ? 1 : 0) = mean_of(end.now_m);
    }
  }
  const auto rotation = meshes::rotation_of_body(rest, now);
  const Place held_rest_m = mean_of(held.rest_m);
  const Place held_now_m = mean_of(held.now_m);
  const Place far_rest_m = mean_of(far.rest_m);
  const Place far_now_m = mean_of(far.now_m);
  // Turned back with the near end: R^T (x - x_near), beside X - X_near.
  Bend bend;
  double across2_m2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    double back_m = 0.0;
    for (std::size_t j = 0; j < 3; ++j) back_m += rotation.at(j).at(i) * (far_now_m.at(j) - held_now_m.at(j));
    const double moved_m = back_m - (far_rest_m.at(i) - held_rest_m.at(i));
    if (i == longest)
      bend.along_m = moved_m;
    else
      across2_m2 += moved_m * moved_m;
  }
  bend.sideways_m = std::sqrt(across2_m2);
  return bend;
}

}  // namespace

std::optional<Bend> bend_in_inflation(const fs::path& folder, double cell_edge_m) {
  if (!io::is_file(folder / "fields.pvd")) return std::nullopt;
  std::vector<io::CollectionEntry> states = io::read_collection(folder / "fields.pvd");
  std::erase_if(states, [&](const io::CollectionEntry& state) {
    return state.part != 0 || !std::isfinite(state.time_s) || !is_within(folder / state.file, folder);
  });
  std::ranges::stable_sort(states, {}, &io::CollectionEntry::time_s);
  if (states.size() < 2) return std::nullopt;
  const std::string told = io::read_in_child(folder / states.front().file, "VTK", [&] {
    const Bend bend = bend_of(read_points(folder / states.front().file, folder / states.back().file), cell_edge_m);
    return two_numbers(bend.sideways_m, bend.along_m);
  });
  const auto [sideways_m, along_m] = two_numbers_in(told);
  return Bend{.sideways_m = sideways_m, .along_m = along_m};
}

}  // namespace menger::evolution
