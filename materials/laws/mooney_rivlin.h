#pragma once

#include <string_view>

#include "materials/laws/invariant_energy.h"

namespace menger::materials {

/// The law of Mooney and Rivlin: W = C10 (I1 - 3) + C01 (I2 - 3), with the isochoric invariants.
struct MooneyRivlin {
  double c10_Pa = 0.0;
  double c01_Pa = 0.0;  ///< a fit to tension alone often makes it negative, and the law unstable

  static constexpr std::string_view name = "mooney_rivlin";
  static constexpr bool uses_second_invariant = true;

  template <class T>
  MENGER_HOST_DEVICE InvariantEnergy<T> energy(const T& x1, const T& x2) const {
    return {.energy = T(c10_Pa) * x1 + T(c01_Pa) * x2, .d1 = T(c10_Pa), .d2 = T(c01_Pa)};
  }

  template <class T>
  MENGER_HOST_DEVICE auto is_within_limit(const T& x1) const {
    return is_below_infinity(x1);
  }

  [[nodiscard]] double shear_modulus_at_rest_Pa() const { return 2.0 * (c10_Pa + c01_Pa); }
};

}  // namespace menger::materials
