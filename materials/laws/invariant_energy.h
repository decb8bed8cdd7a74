#pragma once

#include <concepts>
#include <limits>
#include <string_view>

#include "io/device/host_device.h"

namespace menger::materials {

/// An isochoric strain energy density W with its derivatives. It is a function of x1 = I1 - 3 and x2 = I2 - 3, with the isochoric
/// invariants. A law without the second invariant leaves the derivatives with respect to x2 at zero.
template <class T>
struct InvariantEnergy {
  T energy;  ///< W, J/m^3
  T d1;      ///< dW/dx1
  T d2 = T(0.0);
  T d11 = T(0.0);  ///< d2W/dx1^2
  T d12 = T(0.0);
  T d22 = T(0.0);
};

/// The limit of a law without one: false only if x1 is not a number or has overflowed. For a pack of numbers it returns a mask.
template <class T>
MENGER_HOST_DEVICE auto is_below_infinity(const T& x1) {
  return x1 < T(std::numeric_limits<double>::infinity());
}

/// A law whose energy depends only on the invariants.
template <class Law>
concept InvariantLaw = requires(const Law& law, double x1, double x2) {
  { law.energy(x1, x2) } -> std::same_as<InvariantEnergy<double>>;
  { Law::name } -> std::convertible_to<std::string_view>;  // in files
  { Law::uses_second_invariant } -> std::convertible_to<bool>;
  { law.is_within_limit(x1) } -> std::convertible_to<bool>;
  { law.shear_modulus_at_rest_Pa() } -> std::convertible_to<double>;
};

}  // namespace menger::materials
