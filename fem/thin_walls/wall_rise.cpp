#include "fem/thin_walls/wall_rise.h"

#include <cmath>

namespace menger::fem {
namespace {

/// f1 x f2 of the axes that follow the normal.
GradientColumn area_normal(const std::array<GradientColumn, 3>& f, std::size_t normal) {
  const GradientColumn& a = f[(normal + 1) % 3];
  const GradientColumn& b = f[(normal + 2) % 3];
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const GradientColumn& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

}  // namespace

std::array<double, 2> wall_bending_rises_m(const std::array<double, 3>& edges_m, std::size_t normal,
                                           const BoxNumbers& displacements_m) {
  const std::array<GradientColumn, 3> f = centre_gradient(edges_m, displacements_m);
  const double area_ratio = length(area_normal(f, normal));
  std::array<double, 2> rises{};
  for (std::size_t n = 0; n < 2; ++n) {
    const std::size_t axis = (normal + 1 + n) % 3;
    double change = 0.0;  // f.q, with q the change of f from the middle to a face
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const bool is_alike = (corner >> axis & 1U) == (corner >> normal & 1U);
      for (std::size_t i = 0; i < 3; ++i)
        change += f[axis][i] * (is_alike ? 0.25 : -0.25) / edges_m[axis] * displacements_m[3 * corner + i];
    }
    rises[n] = area_ratio * edges_m[axis] * edges_m[axis] * change / (6.0 * edges_m[normal]);
  }
  return rises;
}

std::array<double, 2> wall_shear_rises(const std::array<double, 3>& edges_m, std::size_t normal, double shear_modulus_Pa) {
  constexpr double shear_factor = 5.0 / 6.0;
  std::array<double, 2> rises{};
  for (std::size_t n = 0; n < 2; ++n) {
    const double edge_m = edges_m[(normal + 1 + n) % 3];
    rises[n] = edge_m * edge_m / (12.0 * shear_factor * shear_modulus_Pa * edges_m[normal]);
  }
  return rises;
}

GradientColumn wall_rise_m(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m,
                           const std::array<double, 3>& place, const std::array<double, 2>& rises_m) {
  double rise_m = 0.0;
  for (std::size_t n = 0; n < 2; ++n) {
    const double x = place[(normal + 1 + n) % 3];
    rise_m += 6.0 * x * (1.0 - x) * rises_m[n];
  }
  GradientColumn direction = area_normal(centre_gradient(edges_m, displacements_m), normal);
  const double factor = rise_m / length(direction);
  for (double& component : direction) component *= factor;
  return direction;
}

}  // namespace menger::fem
