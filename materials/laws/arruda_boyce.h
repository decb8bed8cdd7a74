#pragma once

#include <array>
#include <string_view>

#include "materials/laws/invariant_energy.h"

namespace menger::materials {

/// The eight-chain law of Arruda and Boyce, as the first five terms of its series:
/// W = mu sum_i c_i / lm^(2i-2) (I1^i - 3^i), c = 1/2, 1/20, 11/1050, 19/7000, 519/673750,
/// with I1 of the isochoric deformation.
///
/// The series has no limit of extension. Near and beyond lm it is softer than the law with the inverse Langevin function.
struct ArrudaBoyce {
  double shear_modulus_Pa = 0.0;  ///< mu > 0, a coefficient; the shear modulus at rest is larger
  double locking_stretch = 1.0;   ///< lm > 0

  static constexpr std::string_view name = "arruda_boyce";
  static constexpr bool uses_second_invariant = false;
  static constexpr std::array<double, 5> coefficients{1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0};

  template <class T>
  MENGER_HOST_DEVICE InvariantEnergy<T> energy(const T& x1, const T&) const {
    constexpr std::array<double, 5> c = coefficients;  // graphics processors see no members that are arrays
    const double decay = 1.0 / (locking_stretch * locking_stretch);
    const T invariant = T(3.0) + x1;
    T quotient(1.0);  // (I1^i - 3^i) / (I1 - 3), a sum of positive terms
    T power(1.0);     // I1^(i-1)
    T lower(0.0);     // I1^(i-2)
    T sum(0.0);
    T d1(0.0);
    T d11(0.0);
    double factor = shear_modulus_Pa;
    double power_of_three = 1.0;
    for (std::size_t n = 0; n < c.size(); ++n) {
      const double order = static_cast<double>(n) + 1.0;
      const T weight = T(factor * c[n]);
      sum = sum + weight * quotient;
      d1 = d1 + weight * T(order) * power;
      d11 = d11 + weight * T(order * (order - 1.0)) * lower;
      power_of_three *= 3.0;
      quotient = invariant * quotient + T(power_of_three);
      lower = power;
      power = power * invariant;
      factor *= decay;
    }
    return {.energy = x1 * sum, .d1 = d1, .d11 = d11};
  }

  template <class T>
  MENGER_HOST_DEVICE auto is_within_limit(const T& x1) const {
    return is_below_infinity(x1);
  }

  /// Returns mu (1 + 3/(5 lm^2) + 99/(175 lm^4) + 513/(875 lm^6) + 42039/(67375 lm^8)).
  [[nodiscard]] double shear_modulus_at_rest_Pa() const { return 2.0 * energy(0.0, 0.0).d1; }
};

}  // namespace menger::materials
