#pragma once

#include <string_view>

#include "materials/laws/invariant_energy.h"

namespace menger::materials {

/// Yeoh's law: W = C10 x + C20 x^2 + C30 x^3 with x = I1 - 3 of the isochoric deformation.
struct Yeoh {
  double c10_Pa = 0.0;
  double c20_Pa = 0.0;
  double c30_Pa = 0.0;

  static constexpr std::string_view name = "yeoh";
  static constexpr bool uses_second_invariant = false;

  template <class T>
  MENGER_HOST_DEVICE InvariantEnergy<T> energy(const T& x1, const T&) const {
    const T c1 = T(c10_Pa);
    const T c2 = T(c20_Pa);
    const T c3 = T(c30_Pa);
    return {.energy = x1 * (c1 + x1 * (c2 + x1 * c3)),
            .d1 = c1 + x1 * (T(2.0) * c2 + T(3.0) * x1 * c3),
            .d11 = T(2.0) * c2 + T(6.0) * x1 * c3};
  }

  template <class T>
  MENGER_HOST_DEVICE auto is_within_limit(const T& x1) const {
    return is_below_infinity(x1);
  }

  [[nodiscard]] double shear_modulus_at_rest_Pa() const { return 2.0 * c10_Pa; }
};

}  // namespace menger::materials
