#include "fem/explicit/explicit_contact.h"

#include <algorithm>

#include "fem/surfaces/point.h"

namespace menger::fem {

std::vector<double> outer_node_areas_m2(const meshes::HexahedralMesh& mesh) {
  std::vector<bool> is_inside(mesh.label_names.size(), false);
  for (const meshes::Chamber& chamber : mesh.chambers)
    for (const std::size_t label : chamber.labels) is_inside[label] = true;
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const meshes::BoundaryFace& face : mesh.faces) {
    if (is_inside[face.label]) continue;
    const auto& [a, b, c, d] = face.corners;
    const Point diagonal = difference(mesh.points[c], mesh.points[a]);
    const Point other = difference(mesh.points[d], mesh.points[b]);
    for (const std::size_t node : face.corners) areas[node] += 0.125 * norm(cross(diagonal, other));
  }
  return areas;
}

double ground_energy_J(const RigidGround& ground, std::span<const double> positions_m, std::span<const double> areas_m2) {
  double energy = 0.0;
  for (std::size_t node = 0; node < areas_m2.size(); ++node) {
    const double depth = std::max(ground.height_m - positions_m[3 * node + 2], 0.0);
    energy += 0.5 * ground.stiffness_Pa_per_m * areas_m2[node] * depth * depth;
  }
  return energy;
}

double ground_force_N(const RigidGround& ground, std::span<const double> positions_m, std::span<const double> areas_m2) {
  double force = 0.0;
  for (std::size_t node = 0; node < areas_m2.size(); ++node)
    force += ground.stiffness_Pa_per_m * areas_m2[node] * std::max(ground.height_m - positions_m[3 * node + 2], 0.0);
  return force;
}

}  // namespace menger::fem
