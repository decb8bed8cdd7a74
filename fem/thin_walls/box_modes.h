#pragma once

// Boxes as sums of eight patterns, for packs.

#include <array>
#include <cstddef>
#include <cstdint>

#include "fem/thin_walls/corner_gather.h"
#include "fem/thin_walls/corner_scatter.h"
#include "fem/thin_walls/thin_wall_kernel.h"

namespace menger::fem::detail {

/// Values of one component at the corners of a box: corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1).
template <class T>
using CornerValues = std::array<T, 8>;

/// What a field at the corners of a box does along its axes: signed sums over the corners, eight times the coefficients of the
/// trilinear function.
template <class T>
struct BoxModes {
  Vector3<T> constant;
  std::array<Vector3<T>, 3> linear;     ///< along xi, eta, zeta
  std::array<Vector3<T>, 4> hourglass;  ///< of eta zeta, zeta xi, xi eta, xi eta zeta
};

/// The signed sums of component i.
template <class T>
MENGER_HOST_DEVICE void set_modes(const CornerValues<T>& u, std::size_t i, BoxModes<T>& modes) {
  std::array<T, 4> sums;  // over xi, by eta and zeta
  std::array<T, 4> differences;
  for (std::size_t n = 0; n < 4; ++n) {
    sums[n] = u[2 * n + 1] + u[2 * n];
    differences[n] = u[2 * n + 1] - u[2 * n];
  }
  const auto over = [](const std::array<T, 4>& v, T& sum_low, T& sum_high, T& change_low, T& change_high) {
    sum_low = v[1] + v[0];
    sum_high = v[3] + v[2];
    change_low = v[1] - v[0];
    change_high = v[3] - v[2];
  };
  T sum_low, sum_high, by_eta_low, by_eta_high;
  over(sums, sum_low, sum_high, by_eta_low, by_eta_high);
  T by_xi_low, by_xi_high, by_both_low, by_both_high;
  over(differences, by_xi_low, by_xi_high, by_both_low, by_both_high);
  modes.constant[i] = sum_high + sum_low;
  modes.linear[0][i] = by_xi_high + by_xi_low;
  modes.linear[1][i] = by_eta_high + by_eta_low;
  modes.linear[2][i] = sum_high - sum_low;
  modes.hourglass[0][i] = by_eta_high - by_eta_low;
  modes.hourglass[1][i] = by_xi_high - by_xi_low;
  modes.hourglass[2][i] = by_both_high + by_both_low;
  modes.hourglass[3][i] = by_both_high - by_both_low;
}

/// The transpose: what work on the patterns is as forces on the corners.
/// @tparam has_resultant false: without the constant pattern
template <bool has_resultant, class T>
MENGER_HOST_DEVICE void add_up(const BoxModes<T>& modes, std::size_t i, CornerValues<T>& forces) {
  const T& along = modes.linear[2][i];
  for (std::size_t k = 0; k < 2; ++k) {
    const auto with = [&](const T& value, const T& change) { return k == 0 ? value - change : value + change; };
    const T by_xi = with(modes.linear[0][i], modes.hourglass[1][i]);
    const T by_eta = with(modes.linear[1][i], modes.hourglass[0][i]);
    const T by_both = with(modes.hourglass[2][i], modes.hourglass[3][i]);
    T low = k == 0 ? -along - by_eta : along - by_eta;
    T high = k == 0 ? by_eta - along : along + by_eta;
    if constexpr (has_resultant) {
      low = low + modes.constant[i];
      high = high + modes.constant[i];
    }
    const T low_change = by_xi - by_both;
    const T high_change = by_xi + by_both;
    forces[4 * k] = low - low_change;
    forces[4 * k + 1] = low + low_change;
    forces[4 * k + 2] = high - high_change;
    forces[4 * k + 3] = high + high_change;
  }
}

/// How the corners of boxes lie in memory, for lanes that are numbers or registers.
template <class T>
struct BoxMemory {
  /// Gathers nodal values into lanes. @param first_components of each lane's corners @param first_axis the component that is to
  /// come first; the others follow in a circle
  MENGER_HOST_DEVICE static BoxModes<T> modes(const std::uint32_t* first_components, std::size_t first_axis,
                                              const NumberOf<T>* values) {
    std::array<CornerValues<T>, 3> u;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Vector3<T> value = CornerGather<T>::gather(first_components + corner, values);
      for (std::size_t i = 0; i < 3; ++i) u[i][corner] = value[i];
    }
    BoxModes<T> modes;
    for (std::size_t local = 0; local < 3; ++local) set_modes(u[(first_axis + local) % 3], local, modes);
    return modes;
  }

  /// Writes the forces of a batch to their slots, see ThinWallKernels::forces.
  template <bool has_resultant>
  MENGER_HOST_DEVICE static void store(const BoxModes<T>& modes, std::size_t first_axis, NumberOf<T>* slots) {
    std::array<CornerValues<T>, 3> f;
    for (std::size_t local = 0; local < 3; ++local) add_up<has_resultant>(modes, local, f[(first_axis + local) % 3]);
    for (std::size_t corner = 0; corner < 8; ++corner)
      CornerScatter<T>::scatter({f[0][corner], f[1][corner], f[2][corner]}, slots + 4 * Lanes<T>::count * corner);
  }
};

}  // namespace menger::fem::detail
