#include "fem/space/face_area.h"

#include "fem/surfaces/face.h"

namespace menger::fem {
namespace {

template <std::size_t degree>
std::vector<double> nodal_areas_of_degree(const Space& space, const SpaceFace& face) {
  constexpr std::size_t side = degree + 1;
  constexpr auto rule = gauss_rule<side>();
  std::vector<double> areas_m2(side * side, 0.0);
  for (const QuadraturePoint& v : rule) {
    for (const QuadraturePoint& u : rule) {
      const auto nu = shape_values<degree>(u.position);
      const auto nv = shape_values<degree>(v.position);
      const auto du = shape_derivatives<degree>(u.position);
      const auto dv = shape_derivatives<degree>(v.position);
      Point x_u{};
      Point x_v{};
      for (std::size_t n = 0; n < side * side; ++n) {
        const Point& X = space.positions[static_cast<std::size_t>(face.nodes[n])];
        x_u = sum(x_u, scaled(du[n % side] * nv[n / side], X));
        x_v = sum(x_v, scaled(nu[n % side] * dv[n / side], X));
      }
      const double area_m2 = u.weight * v.weight * norm(cross(x_u, x_v));
      for (std::size_t n = 0; n < side * side; ++n) areas_m2[n] += area_m2 * nu[n % side] * nv[n / side];
    }
  }
  return areas_m2;
}

}  // namespace

std::vector<double> nodal_areas_m2(const Space& space, const SpaceFace& face) {
  return space.degree == 1 ? nodal_areas_of_degree<1>(space, face) : nodal_areas_of_degree<2>(space, face);
}

}  // namespace menger::fem
