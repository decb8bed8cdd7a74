#include "fem/walk/body_posture.h"

#include <algorithm>
#include <limits>

namespace menger::fem {

BodyPosture::BodyPosture(const meshes::HexahedralMesh& mesh) : mesh_(mesh) {
  constexpr double rounding = 1e-6;  // of the extent of the body
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low_m = std::numeric_limits<double>::infinity();
    double high_m = -low_m;
    for (const auto& point : mesh.points) {
      low_m = std::min(low_m, point[axis]);
      high_m = std::max(high_m, point[axis]);
    }
    const double within_m = rounding * (high_m - low_m);
    for (std::size_t node = 0; node < mesh.points.size(); ++node) {
      if (mesh.points[node][axis] <= low_m + within_m) nodes_.at(axis)[0].push_back(node);
      if (mesh.points[node][axis] >= high_m - within_m) nodes_.at(axis)[1].push_back(node);
    }
  }
  at_rest_m_ = ends_m(std::vector<double>(3 * mesh.points.size(), 0.0));
}

meshes::EndPoints BodyPosture::ends_m(std::span<const double> displacements_m) const {
  meshes::EndPoints ends{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::vector<std::size_t>& nodes = nodes_.at(axis).at(end);
      for (std::size_t i = 0; i < 3; ++i) {
        double sum_m = 0.0;
        for (const std::size_t node : nodes) sum_m += mesh_.points[node][i] + displacements_m[3 * node + i];
        ends.at(axis).at(end).at(i) = sum_m / static_cast<double>(nodes.size());
      }
    }
  }
  return ends;
}

Point BodyPosture::upright_axis(std::span<const double> displacements_m) const {
  const auto rotation = meshes::rotation_of_body(at_rest_m_, ends_m(displacements_m));
  return {rotation[0][2], rotation[1][2], rotation[2][2]};
}

}  // namespace menger::fem
