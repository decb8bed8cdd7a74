#include "fem/statics/pressed_walls.h"

#include <algorithm>
#include <map>

#include "fem/statics/thin_wall_groups.h"
#include "meshes/hexahedra/element_geometry.h"

namespace menger::fem {
namespace {

using FaceKey = std::array<Index, 4>;

FaceKey sorted(FaceKey nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// The chamber behind each boundary face of this rank.
std::map<FaceKey, int> chambers_of_faces(const Space& space, const Body& body) {
  std::map<FaceKey, int> chambers;
  for (const SpaceFace& face : space.faces) {
    for (std::size_t c = 0; c < body.chambers.size(); ++c) {
      const std::vector<std::size_t>& labels = body.chambers[c].labels;
      if (std::find(labels.begin(), labels.end(), face.label) != labels.end())
        chambers[sorted({face.nodes[0], face.nodes[1], face.nodes[2], face.nodes[3]})] = static_cast<int>(c);
    }
  }
  return chambers;
}

}  // namespace

PressedWalls::PressedWalls(const Space& space, const Body& body) : space_(space), plenum_count_(body.plenum_count) {
  if (!body.thin_walls) return;
  const std::map<FaceKey, int> chambers = chambers_of_faces(space, body);
  volume_by_pressure_.assign(plenum_count_ * plenum_count_, 0.0);
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const ThinWallPlace& place = body.thin_walls->places[space.mesh_elements[e]];
    if (place.element != ThinWallElement::wall) continue;
    PressedWall wall{.element = e, .normal = place.normal, .edges_m = box_edges_m(space, e)};
    for (std::size_t side = 0; side < 2; ++side) {
      FaceKey nodes{};
      for (std::size_t n = 0; n < 4; ++n)
        nodes[n] = space.element_nodes[8 * e + meshes::face_corners[2 * place.normal + side][n]];
      const auto found = chambers.find(sorted(nodes));
      if (found == chambers.end()) continue;
      wall.chambers[side] = found->second;
      wall.plena[side] = static_cast<int>(body.chambers[static_cast<std::size_t>(found->second)].plenum);
    }
    if (wall.plena[0] < 0 && wall.plena[1] < 0) continue;
    const double modulus_Pa = materials::shear_modulus_at_rest_Pa(body.regions[space.element_regions[e]].law);
    wall.shear_bulge_m3_per_Pa = wall_shear_bulge(wall.edges_m, wall.normal, modulus_Pa);
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t other = 0; other < 2; ++other) {
        if (wall.plena[side] < 0 || wall.plena[other] < 0) continue;
        volume_by_pressure_[static_cast<std::size_t>(wall.plena[side]) * plenum_count_ +
                            static_cast<std::size_t>(wall.plena[other])] += sign(side) * sign(other) * wall.shear_bulge_m3_per_Pa;
      }
    }
    walls_.push_back(wall);
  }
  MPI_Allreduce(MPI_IN_PLACE, volume_by_pressure_.data(), static_cast<int>(volume_by_pressure_.size()), MPI_DOUBLE, MPI_SUM,
                space.communicator);
}

void PressedWalls::add_bulges(std::span<const double> displacements_m, std::span<const double> plenum_pressures_Pa,
                              std::span<double> chamber_volumes_m3) const {
  for (const PressedWall& wall : walls_) {
    const BoxNumbers u = corner_displacements(space_, wall.element, displacements_m);
    double bulge_m3 = wall_bulge(wall.edges_m, wall.normal, u);
    for (std::size_t side = 0; side < 2; ++side)
      if (wall.plena[side] >= 0)
        bulge_m3 += sign(side) * wall.shear_bulge_m3_per_Pa * plenum_pressures_Pa[static_cast<std::size_t>(wall.plena[side])];
    for (std::size_t side = 0; side < 2; ++side)
      if (wall.chambers[side] >= 0) chamber_volumes_m3[static_cast<std::size_t>(wall.chambers[side])] += sign(side) * bulge_m3;
  }
}

}  // namespace menger::fem
