#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// Stretches of a test, with their logarithms.
struct Stretches {
  std::vector<double> stretch;
  std::vector<double> logarithm;
};

/// A kind of law as the fit uses it. The stress is linear in the moduli, and not linear in the shape parameters (exponents,
/// locking). A law either has no shape parameter, or one for each modulus: the one of the same number.
struct LawFamily {
  std::string name;  ///< name of the law, with "_non_negative" if its moduli may not be negative
  /// Whether negative moduli are forbidden; for Ogden's law negative parts of the shear modulus, mu_p alpha_p / 2.
  bool non_negative = false;
  std::vector<std::string> shape_names;  ///< names of the shape parameters, as in parameters_of
  std::vector<double> lowest_shape;
  std::vector<double> highest_shape;
  /// Start values of the shape parameters; one empty list for a law that is linear in all parameters.
  std::vector<std::vector<double>> starts;
  /// Values of a shape parameter, ascending, of which all choices are compared for further starts; may be empty.
  std::vector<double> grid;

  /// Returns, for each modulus, the law in which this modulus is 1 Pa and the others are zero.
  std::function<std::vector<HyperelasticLaw>(std::span<const double> shape)> basis;

  /// Sets, at each stretch, the nominal stress in uniaxial tension of a modulus of 1 Pa with its shape parameter, and the
  /// derivative of that stress with respect to the shape parameter. May be empty: both are then found from `basis`.
  std::function<void(double shape, const Stretches& stretches, std::span<double> stress, std::span<double> slope)> column;

  /// Returns the law with these shape parameters and moduli (Pa).
  std::function<HyperelasticLaw(std::span<const double> shape, std::span<const double> moduli)> compose;
};

/// Returns the families of all laws. Laws with several moduli are listed again with negative moduli forbidden.
/// @param largest_excess largest I1 - 3 of the test; Gent's law must extend to it
std::vector<LawFamily> law_families(double largest_excess);

}  // namespace menger::materials
