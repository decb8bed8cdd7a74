#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace menger::materials {

/// One term of Ogden's law.
struct OgdenTerm {
  double modulus_Pa = 0.0;  ///< mu_p; a law is certainly stable if mu_p alpha_p > 0 in each term
  double exponent = 1.0;    ///< alpha_p, not zero

  /// Returns a term from the other convention, W = sum 2 mu_p/alpha_p^2 (...), in which the moduli add up to the shear modulus.
  static OgdenTerm from_shear_modulus(double part_of_shear_modulus_Pa, double exponent) {
    return {.modulus_Pa = 2.0 * part_of_shear_modulus_Pa / exponent, .exponent = exponent};
  }

  [[nodiscard]] double part_of_shear_modulus_Pa() const { return 0.5 * modulus_Pa * exponent; }
};

/// Ogden's law: W = sum_p mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3), with the isochoric principal stretches l =
/// J^(-1/3) lambda. The shear modulus at rest is 1/2 sum mu_p alpha_p. Stress and tangent are in ogden_response.h.
template <std::size_t term_count>
struct Ogden {
  static_assert(term_count >= 1 && term_count <= 3);
  static constexpr std::string_view name = std::array{"ogden1", "ogden2", "ogden3"}[term_count - 1];
  std::array<OgdenTerm, term_count> terms;

  [[nodiscard]] double shear_modulus_at_rest_Pa() const {
    double sum = 0.0;
    for (const OgdenTerm& term : terms) sum += term.part_of_shear_modulus_Pa();
    return sum;
  }
};

}  // namespace menger::materials
