#pragma once

#include <cmath>

#include "materials/laws/accurate_functions.h"

namespace menger::materials {

/// The volumetric energies U(J) per reference volume, J > 0, with U(1) = U'(1) = 0 and U''(1) = kappa. All are accurate near J =
/// 1, where J - 1 is exact. `derivative` is U' (minus the pressure), `second_derivative` is U''.

/// The energy U = kappa/2 (J - 1)^2. It is finite at J = 0, so only the caller can prevent an element from being crushed.
struct QuadraticVolume {
  double bulk_modulus_Pa = 0.0;  ///< kappa > 0

  template <class T>
  T energy(const T& J) const {
    const T theta = J - T(1.0);
    return T(0.5 * bulk_modulus_Pa) * theta * theta;
  }
  template <class T>
  T derivative(const T& J) const {
    return T(bulk_modulus_Pa) * (J - T(1.0));
  }
  template <class T>
  T second_derivative(const T&) const {
    return T(bulk_modulus_Pa);
  }
};

/// The energy U = kappa/2 (ln J)^2. It is not convex for J > e.
struct LogSquaredVolume {
  double bulk_modulus_Pa = 0.0;  ///< kappa > 0

  template <class T>
  T energy(const T& J) const {
    const T logarithm = log_of(J);
    return T(0.5 * bulk_modulus_Pa) * logarithm * logarithm;
  }
  template <class T>
  T derivative(const T& J) const {
    return T(bulk_modulus_Pa) * log_of(J) / J;
  }
  template <class T>
  T second_derivative(const T& J) const {
    return T(bulk_modulus_Pa) * (T(1.0) - log_of(J)) / (J * J);
  }

 private:
  template <class T>
  static T log_of(const T& J) {
    using std::log;
    return log(J);
  }
};

/// The energy U = kappa/2 ((J^2 - 1)/2 - ln J). It is convex, and infinite at J = 0.
struct SimoTaylorVolume {
  double bulk_modulus_Pa = 0.0;  ///< kappa > 0

  template <class T>
  T energy(const T& J) const {
    const T theta = J - T(1.0);
    return T(0.5 * bulk_modulus_Pa) * (T(0.5) * theta * theta + log_remainder<T>(theta));
  }
  template <class T>
  T derivative(const T& J) const {
    return T(0.5 * bulk_modulus_Pa) * (J - T(1.0)) * (J + T(1.0)) / J;
  }
  template <class T>
  T second_derivative(const T& J) const {
    return T(0.5 * bulk_modulus_Pa) * (T(1.0) + T(1.0) / (J * J));
  }
};

}  // namespace menger::materials
