#pragma once

// Gradients of trilinear fields on boxes by sum factorisation, for packs. Included only by the kernels of an instruction set.

#include <array>
#include <cstddef>
#include <xsimd/xsimd.hpp>

namespace menger::fem::detail {

/// The values of a 3x3 field at the eight Gauss points of a box; point q lies at (q & 1, q >> 1 & 1, q >> 2 & 1).
///
/// Column j is constant along axis j, because the derivative by X_j of a trilinear function is. So it has four values.
template <class Pack>
struct BoxGradient {
  std::array<std::array<std::array<Pack, 4>, 3>, 3> values;  ///< [i][j][k]

  /// Returns the index of the value of column j that belongs to point q.
  static constexpr std::size_t position(std::size_t j, std::size_t q) {
    if (j == 0) return q >> 1U;
    return j == 1 ? (q & 1U) | (q >> 1U & 2U) : q & 3U;
  }
  const Pack& at(std::size_t i, std::size_t j, std::size_t q) const { return values[i][j][position(j, q)]; }
  Pack& at(std::size_t i, std::size_t j, std::size_t q) { return values[i][j][position(j, q)]; }
};

/// The factors of a box for gradients: one per axis for the linear, bilinear and trilinear coefficients of a field.
template <class Pack>
struct BoxFactors {
  std::array<Pack, 3> linear;  ///< 2/h_j times a constant
  std::array<Pack, 3> bilinear;
  std::array<Pack, 3> trilinear;

  BoxFactors(const std::array<Pack, 3>& inverse_edges, const Pack& constant) {
    constexpr double gauss_point = 0.57735026918962576451;  // 1/sqrt(3)
    for (std::size_t j = 0; j < 3; ++j) {
      linear[j] = inverse_edges[j] * constant;
      bilinear[j] = linear[j] * Pack(gauss_point);
      trilinear[j] = linear[j] * Pack(1.0 / 3.0);
    }
  }
};

/// The two other axes of each axis. Bit b of a coefficient's index is set if its function is odd along axis b.
struct OtherAxes {
  std::size_t first;
  std::size_t second;
};
inline constexpr std::array<OtherAxes, 3> other_axes{{{1, 2}, {0, 2}, {0, 1}}};

/// Computes the gradient of the nodal values u[3 corner + i], plus `identity` on its diagonal. The factors contain 1/8 * 2/h.
template <class Pack>
inline void compute_gradient(const std::array<Pack, 24>& u, const BoxFactors<Pack>& factors, double identity,
                             BoxGradient<Pack>& gradient) {
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Pack, 8> c;
    for (std::size_t a = 0; a < 8; ++a) c[a] = u[3 * a + i];
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      for (std::size_t a = 0; a < 8; ++a) {
        if ((a & bit) != 0) continue;
        const Pack low = c[a];
        const Pack high = c[a | bit];
        c[a] = low + high;
        c[a | bit] = high - low;
      }
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t self = std::size_t{1} << j;
      const std::size_t first = std::size_t{1} << other_axes[j].first;
      const std::size_t second = std::size_t{1} << other_axes[j].second;
      const Pack constant = xsimd::fma(c[self], factors.linear[j], Pack(i == j ? identity : 0.0));
      const Pack along_first = c[self | first] * factors.bilinear[j];
      const Pack along_second = c[self | second] * factors.bilinear[j];
      const Pack twisted = c[7] * factors.trilinear[j];
      const Pack low = constant - along_first;
      const Pack high = constant + along_first;
      const Pack low_change = along_second - twisted;
      const Pack high_change = along_second + twisted;
      gradient.values[i][j] = {low - low_change, high - high_change, low + low_change, high + high_change};
    }
  }
}

/// Computes the transpose, the nodal forces f[3 corner + i] = sum over points of H_ij dN_corner/dX_j. `sums` holds for each place
/// of column j the sum over its two points. The factors contain 1/8 * 2/h times the weight of a point.
template <class Pack>
inline void compute_nodal_forces(const BoxGradient<Pack>& sums, const BoxFactors<Pack>& factors, std::array<Pack, 24>& forces) {
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Pack, 8> c;
    std::array<Pack, 3> twisted;
    std::array<Pack, 3> along_first;
    std::array<Pack, 3> along_second;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::array<Pack, 4>& h = sums.values[i][j];
      const Pack low = h[0] + h[1];
      const Pack low_change = h[1] - h[0];
      const Pack high = h[2] + h[3];
      const Pack high_change = h[3] - h[2];
      c[std::size_t{1} << j] = (low + high) * factors.linear[j];
      along_first[j] = (low_change + high_change) * factors.bilinear[j];
      along_second[j] = (high - low) * factors.bilinear[j];
      twisted[j] = (high_change - low_change) * factors.trilinear[j];
    }
    c[0] = Pack(0.0);
    c[3] = along_first[0] + along_first[1];
    c[5] = along_second[0] + along_first[2];
    c[6] = along_second[1] + along_second[2];
    c[7] = twisted[0] + twisted[1] + twisted[2];
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      for (std::size_t a = 0; a < 8; ++a) {
        if ((a & bit) != 0) continue;
        const Pack even = c[a];
        const Pack odd = c[a | bit];
        c[a] = even - odd;
        c[a | bit] = even + odd;
      }
    }
    for (std::size_t a = 0; a < 8; ++a) forces[3 * a + i] = c[a];
  }
}

}  // namespace menger::fem::detail
