#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace menger::evolution {

/// Points of a body at rest, and where they are in another state.
struct MovedPoints {
  std::vector<std::array<double, 3>> rest_m;
  std::vector<std::array<double, 3>> now_m;  ///< as many

  void add(const MovedPoints& from, std::size_t n) {
    rest_m.push_back(from.rest_m[n]);
    now_m.push_back(from.now_m[n]);
  }
};

/// A rigid motion x = R (X - from) + to.
struct RigidMotion {
  std::array<std::array<double, 3>, 3> rotation{};  ///< R[row][column]
  std::array<double, 3> from_m{};
  std::array<double, 3> to_m{};

  /// Returns where a point would be without the motion: R^T (x - to) + from.
  [[nodiscard]] std::array<double, 3> taken_out(const std::array<double, 3>& now_m) const;
};

/// Returns the mean of some points. @pre there is at least one
std::array<double, 3> mean_of(const std::vector<std::array<double, 3>>& places_m);

/// Returns the axis along which a body is longest at rest, the first of several. @pre there is at least one point
std::size_t longest_axis(const MovedPoints& points);

/// Returns the points within a distance of an end of the box around all points at rest.
MovedPoints points_near_end(const MovedPoints& points, std::size_t axis, bool is_high, double within_m);

/// Returns the motion of the near end of a body: of its points within one cell of the lowest end of its longest axis. With it
/// taken out, a body that floats free looks as if held there.
/// @param cell_edge_m > 0 @pre there are points at all ends of the box around the body, as corners of elements are
RigidMotion motion_of_near_end(const MovedPoints& points, double cell_edge_m);

}  // namespace menger::evolution
