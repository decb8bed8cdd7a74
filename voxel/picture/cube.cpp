#include "voxel/picture/cube.h"

namespace menger::voxel {
namespace {

constexpr std::array<std::array<double, 3>, cube_corner_count> signs{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

/// The distances from the centre of a voxel to its sides -x, +x, -y, +y, -z, +z.
std::array<double, 6> reach_of(const Frame& frame, std::size_t voxel) {
  if (!frame.reach_m.empty()) return frame.reach_m[voxel];
  std::array<double, 6> reach{};
  reach.fill(0.5 * frame.size_m[voxel]);
  return reach;
}

}  // namespace

std::array<std::array<double, 3>, cube_corner_count> cube_corners_m(const Frame& frame, std::size_t voxel) {
  const auto [w, x, y, z] = frame.orientation[voxel];
  const std::array<std::array<double, 3>, 3> rotation{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                                       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                                       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
  const std::array<double, 6> reach = reach_of(frame, voxel);
  std::array<std::array<double, 3>, cube_corner_count> corners{};
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    std::array<double, 3> arm{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sign = signs[corner][axis];
      arm[axis] = sign * (sign < 0.0 ? reach[2 * axis] : reach[2 * axis + 1]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& row = rotation[axis];
      corners[corner][axis] = frame.position_m[voxel][axis] + (row[0] * arm[0] + row[1] * arm[1] + row[2] * arm[2]);
    }
  }
  return corners;
}

std::array<std::array<double, 3>, cube_corner_count> rest_corners_m(const Frame& frame, std::size_t voxel) {
  std::array<std::array<double, 3>, cube_corner_count> corners{};
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      corners[corner][axis] = frame.rest_position_m[voxel][axis] + 0.5 * frame.cell_edge_m * signs[corner][axis];
  }
  return corners;
}

double volume_ratio(const Frame& frame, std::size_t voxel) {
  const std::array<double, 6> reach = reach_of(frame, voxel);
  double ratio = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) ratio *= (reach[2 * axis] + reach[2 * axis + 1]) / frame.cell_edge_m;
  return ratio;
}

}  // namespace menger::voxel
