#include "fem/thin_walls/wall_volume.h"

#include <cstddef>

#include "fem/thin_walls/wall_rise.h"

namespace menger::fem {
namespace {

GradientColumn cross(const GradientColumn& a, const GradientColumn& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Derivative of the gradient's column along an axis by the displacement of a corner, 1/m.
double slope(const std::array<double, 3>& edges_m, std::size_t corner, std::size_t axis) {
  return (corner >> axis & 1U) != 0U ? 0.25 / edges_m[axis] : -0.25 / edges_m[axis];
}

/// The columns without the 1 on the diagonal.
std::array<GradientColumn, 3> displacement_gradient(const std::array<double, 3>& edges_m, const BoxNumbers& u) {
  std::array<GradientColumn, 3> g{};
  for (std::size_t corner = 0; corner < 8; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < 3; ++i) g[axis][i] += slope(edges_m, corner, axis) * u[3 * corner + i];
  return g;
}

double dot(const GradientColumn& a, const GradientColumn& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Derivative of q along an axis by the displacement of a corner, 1/m.
double twist(const std::array<double, 3>& edges_m, std::size_t normal, std::size_t corner, std::size_t axis) {
  const double value = slope(edges_m, corner, axis);
  return (corner >> normal & 1U) != 0U ? value : -value;
}

/// The in-plane part of a wall's deformation.
struct BentLayer {
  std::array<std::size_t, 2> axes{};
  std::array<GradientColumn, 2> f{};
  std::array<GradientColumn, 2> q{};
  std::array<double, 2> squares{};  ///< l_i^2 / (6 t)
  double area_m2 = 0.0;             ///< at rest
  double ratio_square = 1.0;        ///< d
  double rise_m = 0.0;              ///< sum l_i^2 f_i.q_i / (6 t)

  BentLayer(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& u)
      : axes{(normal + 1) % 3, (normal + 2) % 3} {
    const std::array<GradientColumn, 3> columns = centre_gradient(edges_m, u);
    area_m2 = edges_m[axes[0]] * edges_m[axes[1]];
    for (std::size_t n = 0; n < 2; ++n) {
      f[n] = columns[axes[n]];
      for (std::size_t corner = 0; corner < 8; ++corner)
        for (std::size_t i = 0; i < 3; ++i) q[n][i] += twist(edges_m, normal, corner, axes[n]) * u[3 * corner + i];
      squares[n] = edges_m[axes[n]] * edges_m[axes[n]] / (6.0 * edges_m[normal]);
      rise_m += squares[n] * dot(f[n], q[n]);
    }
    const GradientColumn across = cross(f[0], f[1]);
    ratio_square = dot(across, across);
  }
};

}  // namespace

std::array<GradientColumn, 3> centre_gradient(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m) {
  std::array<GradientColumn, 3> f = displacement_gradient(edges_m, displacements_m);
  for (std::size_t axis = 0; axis < 3; ++axis) f[axis][axis] += 1.0;
  return f;
}

double wall_volume_change(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m) {
  const auto g = displacement_gradient(edges_m, displacements_m);
  // det(1 + g) - 1 = tr g + the sum of the principal minors + det g, without cancellation
  const double trace = g[0][0] + g[1][1] + g[2][2];
  double minors = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    minors += g[i][i] * g[j][j] - g[i][j] * g[j][i];
  }
  const GradientColumn normal = cross(g[0], g[1]);
  const double determinant = normal[0] * g[2][0] + normal[1] * g[2][1] + normal[2] * g[2][2];
  return edges_m[0] * edges_m[1] * edges_m[2] * (trace + minors + determinant);
}

BoxNumbers wall_volume_gradient(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m) {
  const auto f = centre_gradient(edges_m, displacements_m);
  const double volume = edges_m[0] * edges_m[1] * edges_m[2];
  BoxNumbers gradient{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const GradientColumn cofactor = cross(f[(axis + 1) % 3], f[(axis + 2) % 3]);
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (std::size_t i = 0; i < 3; ++i) gradient[3 * corner + i] += volume * slope(edges_m, corner, axis) * cofactor[i];
  }
  return gradient;
}

std::vector<double> wall_volume_hessian(const std::array<double, 3>& edges_m, const BoxNumbers& displacements_m) {
  const auto f = centre_gradient(edges_m, displacements_m);
  const double volume = edges_m[0] * edges_m[1] * edges_m[2];
  std::vector<double> hessian(576, 0.0);
  // d2J / df_a,i df_b,j = e_ijk f_c,k for the axes a, b, c in a circle
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    const GradientColumn& third = f[(a + 2) % 3];
    for (std::size_t first = 0; first < 8; ++first) {
      for (std::size_t second = 0; second < 8; ++second) {
        const double factor = volume * slope(edges_m, first, a) * slope(edges_m, second, b);
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t j = (i + 1) % 3;
          const double value = factor * third[(i + 2) % 3];
          const auto add = [&](std::size_t row, std::size_t column, double number) {
            hessian[24 * row + column] += number;
            hessian[24 * column + row] += number;
          };
          add(3 * first + i, 3 * second + j, value);
          add(3 * first + j, 3 * second + i, -value);
        }
      }
    }
  }
  return hessian;
}

double wall_bulge(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m) {
  const BentLayer layer(edges_m, normal, displacements_m);
  return layer.area_m2 * layer.ratio_square * layer.rise_m;
}

BoxNumbers wall_bulge_gradient(const std::array<double, 3>& edges_m, std::size_t normal, const BoxNumbers& displacements_m) {
  const BentLayer layer(edges_m, normal, displacements_m);
  const double mixed = dot(layer.f[0], layer.f[1]);
  BoxNumbers gradient{};
  for (std::size_t n = 0; n < 2; ++n) {
    const GradientColumn& own = layer.f[n];
    const GradientColumn& other = layer.f[1 - n];
    const double square = dot(other, other);
    for (std::size_t i = 0; i < 3; ++i) {
      const double by_f = layer.area_m2 * (2.0 * layer.rise_m * (square * own[i] - mixed * other[i]) +
                                           layer.ratio_square * layer.squares[n] * layer.q[n][i]);
      const double by_q = layer.area_m2 * layer.ratio_square * layer.squares[n] * own[i];
      for (std::size_t corner = 0; corner < 8; ++corner)
        gradient[3 * corner + i] +=
            by_f * slope(edges_m, corner, layer.axes[n]) + by_q * twist(edges_m, normal, corner, layer.axes[n]);
    }
  }
  return gradient;
}

double wall_shear_bulge(const std::array<double, 3>& edges_m, std::size_t normal, double shear_modulus_Pa) {
  const std::array<double, 2> rises = wall_shear_rises(edges_m, normal, shear_modulus_Pa);
  return edges_m[(normal + 1) % 3] * edges_m[(normal + 2) % 3] * (rises[0] + rises[1]);
}

}  // namespace menger::fem
