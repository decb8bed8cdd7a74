#include "fem/dead_load.h"

#include "fem/element_shape_tables.h"
#include "fem/face.h"

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

template <std::size_t degree>
void add_traction(const Space& space, const SpaceFace& face, const Point& traction, std::vector<double>& load) {
  constexpr auto rule = gauss_rule<degree + 1>();
  for (const QuadraturePoint& v : rule) {
    for (const QuadraturePoint& u : rule) {
      const auto nu = shape_values<degree>(u.position);
      const auto nv = shape_values<degree>(v.position);
      const auto du = shape_derivatives<degree>(u.position);
      const auto dv = shape_derivatives<degree>(v.position);
      Point x_u{};
      Point x_v{};
      for (std::size_t j = 0; j <= degree; ++j) {
        for (std::size_t i = 0; i <= degree; ++i) {
          const Point& X = space.positions[static_cast<std::size_t>(face.nodes[i + (degree + 1) * j])];
          x_u = sum(x_u, scaled(du[i] * nv[j], X));
          x_v = sum(x_v, scaled(nu[i] * dv[j], X));
        }
      }
      const double area = u.weight * v.weight * norm(cross(x_u, x_v));
      for (std::size_t j = 0; j <= degree; ++j)
        for (std::size_t i = 0; i <= degree; ++i) add(load, face.nodes[i + (degree + 1) * j], area * nu[i] * nv[j], traction);
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
      if (space.degree == 1) {
        add_traction<1>(space, face, traction.traction_Pa, load);
      } else {
        add_traction<2>(space, face, traction.traction_Pa, load);
      }
    }
  }
  return load;
}

}  // namespace menger::fem
