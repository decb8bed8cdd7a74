#pragma once

#include <string_view>

#include "materials/laws/invariant_energy.h"

namespace menger::materials {

/// The neo-Hookean law: W = mu/2 (I1 - 3), with I1 of the isochoric deformation.
struct NeoHookean {
  double shear_modulus_Pa = 0.0;  ///< mu > 0

  static constexpr std::string_view name = "neo_hookean";
  static constexpr bool uses_second_invariant = false;

  template <class T>
  MENGER_HOST_DEVICE InvariantEnergy<T> energy(const T& x1, const T&) const {
    const T slope = T(0.5 * shear_modulus_Pa);
    return {.energy = slope * x1, .d1 = slope};
  }

  template <class T>
  MENGER_HOST_DEVICE auto is_within_limit(const T& x1) const {
    return is_below_infinity(x1);
  }

  [[nodiscard]] double shear_modulus_at_rest_Pa() const { return shear_modulus_Pa; }
};

}  // namespace menger::materials
