#include "evolution/posture/near_end.h"

#include <algorithm>
#include <utility>

#include "meshes/load_cases/body_extents.h"

namespace menger::evolution {
namespace {

using Place = std::array<double, 3>;

std::pair<double, double> range_along(const std::vector<Place>& places, std::size_t axis) {
  const auto [low, high] = std::ranges::minmax(places, {}, [&](const Place& place) { return place.at(axis); });
  return {low.at(axis), high.at(axis)};
}

}  // namespace

Place RigidMotion::taken_out(const Place& now_m) const {
  Place place = from_m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) place.at(i) += rotation.at(j).at(i) * (now_m.at(j) - to_m.at(j));
  return place;
}

Place mean_of(const std::vector<Place>& places_m) {
  Place mean{};
  for (const Place& place : places_m)
    for (std::size_t i = 0; i < 3; ++i) mean.at(i) += place.at(i) / static_cast<double>(places_m.size());
  return mean;
}

std::size_t longest_axis(const MovedPoints& points) {
  std::size_t longest = 0;
  double length_m = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_along(points.rest_m, axis);
    if (high - low <= length_m) continue;
    longest = axis;
    length_m = high - low;
  }
  return longest;
}

MovedPoints points_near_end(const MovedPoints& points, std::size_t axis, bool is_high, double within_m) {
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

RigidMotion motion_of_near_end(const MovedPoints& points, double cell_edge_m) {
  const MovedPoints held = points_near_end(points, longest_axis(points), false, cell_edge_m);
  meshes::EndPoints rest{};
  meshes::EndPoints now{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) {
      const MovedPoints end = points_near_end(held, axis, is_high, 0.0);
      rest.at(axis).at(is_high ? 1 : 0) = mean_of(end.rest_m);
      now.at(axis).at(is_high ? 1 : 0) = mean_of(end.now_m);
    }
  }
  return {.rotation = meshes::rotation_of_body(rest, now), .from_m = mean_of(held.rest_m), .to_m = mean_of(held.now_m)};
}

}  // namespace menger::evolution
