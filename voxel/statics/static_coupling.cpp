#include "voxel/statics/static_coupling.h"

#include <cmath>
#include <numbers>

namespace menger::voxel {
namespace {

Eigen::Vector3d eigen(const Vector3<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

std::vector<CouplingSpring> coupling_springs(const StaticBody& body, const std::vector<Pose>& poses,
                                             const std::vector<double>& rest_lengths) {
  std::vector<CouplingSpring> springs(body.beams.size());
  std::vector<std::array<double, 3>> sums(body.voxel_count());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const StaticBeam& beam = body.beams[i];
    CouplingSpring& spring = springs[i];
    const Eigen::Vector3d separation = eigen(poses[beam.upper].position - poses[beam.lower].position);
    const bool whole = body.is_voxel(beam.lower) && body.is_voxel(beam.upper);
    const double share = whole ? 0.5 : 0.5 * std::numbers::sqrt2;
    spring.weight = share * std::sqrt(beam.coefficients.axial / rest_lengths[i]);
    spring.length = separation.norm();
    if (spring.length > 0.0) spring.direction = separation / spring.length;
    for (const std::size_t node : {beam.lower, beam.upper}) {
      if (body.is_voxel(node))
        sums[node][static_cast<std::size_t>(beam.axis)] += spring.weight * (spring.length - rest_lengths[i]);
    }
  }
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const StaticBeam& beam = body.beams[i];
    const auto axis = static_cast<std::size_t>(beam.axis);
    for (const std::size_t node : {beam.lower, beam.upper}) {
      if (!body.is_voxel(node)) continue;
      const double across = sums[node][(axis + 1) % 3] + sums[node][(axis + 2) % 3];
      springs[i].tension += body.parameters.lateral_coupling * springs[i].weight * across;
    }
  }
  return springs;
}

std::vector<std::array<std::size_t, 2>> coupled_beams(const StaticBody& body) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const auto& beams : body.beam_at) {
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) {
        if (a / 2 != b / 2 && beams[a] && beams[b]) pairs.push_back({*beams[a], *beams[b]});
      }
    }
  }
  return pairs;
}

}  // namespace menger::voxel
