#include "meshes/load_cases/outermost_points.h"

#include <algorithm>

namespace menger::meshes {
namespace {

/// Returns the means of values over the points of each end. @param value_of (point, coordinate) -> value
template <class Ends, class ValueOf>
EndPoints means(const Ends& points_of_ends, const ValueOf& value_of) {
  EndPoints found{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::vector<std::size_t>& points = points_of_ends.at(axis).at(end);
      for (const std::size_t n : points)
        for (std::size_t i = 0; i < 3; ++i) found.at(axis).at(end).at(i) += value_of(n, i) / static_cast<double>(points.size());
    }
  }
  return found;
}

}  // namespace

OutermostPoints::OutermostPoints(std::span<const std::array<double, 3>> at_rest_m) {
  constexpr double rounding = 1e-6;  // of the extent of the body
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along_m = [axis](const std::array<double, 3>& point) { return point.at(axis); };
    const auto [lowest, highest] = std::ranges::minmax(at_rest_m, {}, along_m);
    const double low_m = along_m(lowest);
    const double high_m = along_m(highest);
    const double within_m = rounding * (high_m - low_m);
    for (std::size_t n = 0; n < at_rest_m.size(); ++n) {
      if (along_m(at_rest_m[n]) <= low_m + within_m) points_.at(axis)[0].push_back(n);
      if (along_m(at_rest_m[n]) >= high_m - within_m) points_.at(axis)[1].push_back(n);
    }
  }
  at_rest_m_ = means(points_, [&](std::size_t n, std::size_t i) { return at_rest_m[n].at(i); });
}

std::array<double, 3> OutermostPoints::upright_axis(std::span<const double> displacements_m) const {
  EndPoints now_m = means(points_, [&](std::size_t n, std::size_t i) { return displacements_m[3 * n + i]; });
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t i = 0; i < 3; ++i) now_m.at(axis).at(end).at(i) += at_rest_m_.at(axis).at(end).at(i);
  const auto rotation = rotation_of_body(at_rest_m_, now_m);
  return {rotation[0][2], rotation[1][2], rotation[2][2]};
}

}  // namespace menger::meshes
