#include "fem/surfaces/ground.h"

namespace menger::fem {
namespace {

/// Calls add(N, depth, area) for every point of the rule that lies below the plane.
template <std::size_t n, class Add>
void for_each_point_below(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current, const Add& add) {
  constexpr std::size_t degree = face_degree<n>;
  constexpr std::size_t width = degree + 1;
  constexpr auto rule = gauss_rule<degree + 2>();
  for (const QuadraturePoint& at_v : rule) {
    for (const QuadraturePoint& at_u : rule) {
      const auto along_u = shape_values<degree>(at_u.position);
      const auto along_v = shape_values<degree>(at_v.position);
      std::array<double, n> values{};
      double depth = ground.height_m;
      for (std::size_t a = 0; a < n; ++a) {
        values[a] = along_u[a % width] * along_v[a / width];
        depth -= values[a] * current[a][2];
      }
      if (!(depth > 0.0)) continue;
      const auto slope_u = shape_derivatives<degree>(at_u.position);
      const auto slope_v = shape_derivatives<degree>(at_v.position);
      Point by_u{};
      Point by_v{};
      for (std::size_t a = 0; a < n; ++a) {
        by_u = sum(by_u, scaled(slope_u[a % width] * along_v[a / width], reference[a]));
        by_v = sum(by_v, scaled(along_u[a % width] * slope_v[a / width], reference[a]));
      }
      add(values, depth, at_u.weight * at_v.weight * norm(cross(by_u, by_v)));
    }
  }
}

}  // namespace

template <std::size_t n>
double ground_energy_J(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current) {
  double energy = 0.0;
  for_each_point_below(ground, reference, current, [&](const std::array<double, n>&, double depth, double area) {
    energy += 0.5 * ground.stiffness_Pa_per_m * depth * depth * area;
  });
  return energy;
}

template <std::size_t n>
std::array<double, n> ground_gradient_N(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current) {
  std::array<double, n> gradient{};
  for_each_point_below(ground, reference, current, [&](const std::array<double, n>& values, double depth, double area) {
    for (std::size_t a = 0; a < n; ++a) gradient[a] -= ground.stiffness_Pa_per_m * depth * area * values[a];
  });
  return gradient;
}

template <std::size_t n>
std::array<double, n * n> ground_hessian(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current) {
  std::array<double, n * n> hessian{};
  for_each_point_below(ground, reference, current, [&](const std::array<double, n>& values, double, double area) {
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) hessian[a * n + b] += ground.stiffness_Pa_per_m * area * (values[a] * values[b]);
  });
  return hessian;
}

template <std::size_t n>
double ground_force_N(const GroundPlane& ground, const FaceNodes<n>& reference, const FaceNodes<n>& current) {
  double force = 0.0;
  for_each_point_below(ground, reference, current, [&](const std::array<double, n>&, double depth, double area) {
    force += ground.stiffness_Pa_per_m * depth * area;
  });
  return force;
}

template double ground_energy_J(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
template double ground_energy_J(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
template std::array<double, 4> ground_gradient_N(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
template std::array<double, 9> ground_gradient_N(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
template std::array<double, 16> ground_hessian(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
template std::array<double, 81> ground_hessian(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);
template double ground_force_N(const GroundPlane&, const FaceNodes<4>&, const FaceNodes<4>&);
template double ground_force_N(const GroundPlane&, const FaceNodes<9>&, const FaceNodes<9>&);

}  // namespace menger::fem
