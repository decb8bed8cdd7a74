#include "voxel/picture/cube.h"

namespace menger::voxel {

std::array<std::array<double, 3>, cube_corner_count> cube_corners_m(const Frame& frame, std::size_t voxel) {
  constexpr std::array<std::array<double, 3>, cube_corner_count> signs{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  const auto [w, x, y, z] = frame.orientation[voxel];
  const std::array<std::array<double, 3>, 3> rotation{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                                                       {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                                                       {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
  std::array<double, 6> reach{};
  reach.fill(0.5 * frame.size_m[voxel]);
  if (!frame.reach_m.empty()) reach = frame.reach_m[voxel];
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

}  // namespace menger::voxel
