#include "fem/statics/dead_load.h"

#include "fem/elements/element_shape_tables.h"
#include "fem/space/face_area.h"

namespace menger::fem {

namespace {

void add(std::vector<double>& load, Index node, double factor, const Point& direction) {
  for (std::size_t i = 0; i < 3; ++i) load[3 * static_cast<std::size_t>(node) + i] += factor * direction[i];
}

template <int degree>
void add_gravity(const Space& space, const Body& body, std::vector<double>& load) {
  constexpr auto shape = element_shape_tables<degree>();
  for (std::size_t e = 0; e < space.local_element_count(); ++e) {
    const double density = body.regions[space.element_regions[e]].density_kg_per_m3;
    const Index* nodes = space.element_nodes.data() + e * shape.nodes;
    for (std::size_t q = 0; q < shape.points; ++q) {
      std::array<Point, 3> by_reference{};  // dX / dxi_j
      for (std::size_t a = 0; a < shape.nodes; ++a) {
        const Point& X = space.positions[static_cast<std::size_t>(nodes[a])];
        for (std::size_t j = 0; j < 3; ++j) by_reference[j] = sum(by_reference[j], scaled(shape.gradient[q][a][j], X));
      }
      const double mass = density * shape.weight[q] * dot(by_reference[0], cross(by_reference[1], by_reference[2]));
      for (std::size_t a = 0; a < shape.nodes; ++a) add(load, nodes[a], mass * shape.value[q][a], body.gravity_m_per_s2);
    }
  }
}

}  // namespace

std::vector<double> dead_load_of(const Space& space, const Body& body) {
  std::vector<double> load(3 * space.positions.size(), 0.0);
  if (norm(body.gravity_m_per_s2) > 0.0) {
    if (space.degree == 1) {
      add_gravity<1>(space, body, load);
    } else {
      add_gravity<2>(space, body, load);
    }
  }
  for (const SpaceFace& face : space.faces) {
    for (const Traction& traction : body.tractions) {
      if (traction.label != face.label) continue;
      const std::vector<double> areas_m2 = nodal_areas_m2(space, face);
      for (std::size_t n = 0; n < areas_m2.size(); ++n) add(load, face.nodes[n], areas_m2[n], traction.traction_Pa);
    }
  }
  return load;
}

}  // namespace menger::fem
