#pragma once

#include <string_view>

#include "materials/laws/accurate_functions.h"
#include "materials/laws/invariant_energy.h"

namespace menger::materials {

/// Gent's law for chains of limited extension: W = -mu Jm/2 ln(1 - (I1 - 3)/Jm) for I1 - 3 < Jm, with I1 of the isochoric
/// deformation.
///
/// At and beyond the limit, energy and stress are finite but have no meaning. Check is_within_limit.
struct Gent {
  double shear_modulus_Pa = 0.0;  ///< mu > 0
  double locking_excess = 1.0;    ///< Jm > 0, the value of I1 - 3 at which the chains are straight

  static constexpr std::string_view name = "gent";
  static constexpr bool uses_second_invariant = false;

  template <class T>
  MENGER_HOST_DEVICE InvariantEnergy<T> energy(const T& x1, const T&) const {
    const T used = x1 * T(1.0 / locking_excess);
    const T y = select(used < T(largest_use), used, T(largest_use));
    const T rest = T(1.0) - y;
    const T slope = T(0.5 * shear_modulus_Pa) / rest;
    const T logarithm = y + log_remainder<T>(-y);  // -ln(1 - y)
    return {.energy = T(0.5 * shear_modulus_Pa * locking_excess) * logarithm,
            .d1 = slope,
            .d11 = slope / rest * T(1.0 / locking_excess)};
  }

  template <class T>
  MENGER_HOST_DEVICE auto is_within_limit(const T& x1) const {
    return x1 * T(1.0 / locking_excess) < T(largest_use);
  }

  [[nodiscard]] double shear_modulus_at_rest_Pa() const { return shear_modulus_Pa; }

 private:
  /// The largest part of Jm that I1 - 3 may reach. There dW/dI1 is a million times that at rest.
  static constexpr double largest_use = 1.0 - 1e-6;
};

}  // namespace menger::materials
