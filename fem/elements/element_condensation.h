#pragma once

// The L2 projection onto the pressure and dilatation modes of an element, for packs. Included only by the kernels of one
// instruction set.

#include <array>
#include <cstddef>

#include "fem/elements/element_shape_tables.h"

namespace menger::fem::detail {

/// The L2 projection of values at the quadrature points onto the modes of an element.
template <int degree, class Pack>
class ModeProjection {
 public:
  static constexpr auto shape = element_shape_tables<degree>();
  static constexpr std::size_t points = shape.points;
  static constexpr std::size_t modes = shape.modes;
  using Matrix = std::array<std::array<Pack, modes>, modes>;

  /// @param volume reference volume of each quadrature point
  explicit ModeProjection(const std::array<Pack, points>& volume)
      : volume_(volume), inverse_mass_(inverse(weighted_mass(volume))) {}

  /// Returns the projection of a function, evaluated at the quadrature points.
  [[nodiscard]] std::array<Pack, points> project(const std::array<Pack, points>& value) const {
    std::array<Pack, modes> moment;
    moment.fill(Pack(0.0));
    for (std::size_t q = 0; q < points; ++q) {
      for (std::size_t m = 0; m < modes; ++m) moment[m] = moment[m] + volume_[q] * value[q] * Pack(shape.mode[q][m]);
    }
    std::array<Pack, modes> coefficient;
    for (std::size_t m = 0; m < modes; ++m) {
      coefficient[m] = Pack(0.0);
      for (std::size_t n = 0; n < modes; ++n) coefficient[m] = coefficient[m] + inverse_mass_[m][n] * moment[n];
    }
    std::array<Pack, points> projected;
    for (std::size_t q = 0; q < points; ++q) {
      projected[q] = coefficient[0];
      for (std::size_t m = 1; m < modes; ++m) projected[q] = projected[q] + coefficient[m] * Pack(shape.mode[q][m]);
    }
    return projected;
  }

  /// Returns M^-1 H M^-1, with the mass matrix M of the modes and H_mn = integral value mode_m mode_n. It is the stiffness of the
  /// modes with respect to moments of the volume ratio.
  [[nodiscard]] Matrix sandwiched(const std::array<Pack, points>& value) const {
    std::array<Pack, points> weighted;
    for (std::size_t q = 0; q < points; ++q) weighted[q] = volume_[q] * value[q];
    const Matrix left = product(inverse_mass_, weighted_mass(weighted));
    Matrix result = product(left, inverse_mass_);
    for (std::size_t m = 0; m < modes; ++m)  // exactly symmetric in spite of rounding
      for (std::size_t n = 0; n < m; ++n) result[m][n] = result[n][m];
    return result;
  }

 private:
  static Matrix weighted_mass(const std::array<Pack, points>& weight) {
    Matrix mass;
    for (std::size_t m = 0; m < modes; ++m) {
      for (std::size_t n = 0; n < modes; ++n) {
        mass[m][n] = Pack(0.0);
        for (std::size_t q = 0; q < points; ++q) mass[m][n] = mass[m][n] + weight[q] * Pack(shape.mode[q][m] * shape.mode[q][n]);
      }
    }
    return mass;
  }

  /// Gauss-Jordan elimination without pivoting, which a symmetric positive definite matrix does not need.
  static Matrix inverse(Matrix a) {
    for (std::size_t p = 0; p < modes; ++p) {
      const Pack pivot = Pack(1.0) / a[p][p];
      a[p][p] = Pack(1.0);
      for (std::size_t n = 0; n < modes; ++n) a[p][n] = a[p][n] * pivot;
      for (std::size_t m = 0; m < modes; ++m) {
        if (m == p) continue;
        const Pack factor = a[m][p];
        a[m][p] = Pack(0.0);
        for (std::size_t n = 0; n < modes; ++n) a[m][n] = a[m][n] - factor * a[p][n];
      }
    }
    return a;
  }

  static Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c;
    for (std::size_t m = 0; m < modes; ++m) {
      for (std::size_t n = 0; n < modes; ++n) {
        c[m][n] = Pack(0.0);
        for (std::size_t k = 0; k < modes; ++k) c[m][n] = c[m][n] + a[m][k] * b[k][n];
      }
    }
    return c;
  }

  std::array<Pack, points> volume_;
  Matrix inverse_mass_;
};

}  // namespace menger::fem::detail
