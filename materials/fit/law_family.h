#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// A kind of law as a fit sees it: moduli in which the stress is linear, and shape parameters (exponents, locking) in which it is
/// not.
struct LawFamily {
  std::string name;                      ///< that of the law, with "_non_negative" if its moduli may not be negative
  bool non_negative = false;             ///< for Ogden of the parts of the shear modulus, mu_p alpha_p / 2
  std::vector<std::string> shape_names;  ///< of the shape parameters, as parameters_of names them
  std::vector<double> lowest_shape;
  std::vector<double> highest_shape;
  std::vector<std::vector<double>> starts;  ///< shape parameters to start from; one empty list for a linear law

  /// The laws that belong to one unit (1 Pa) of each modulus.
  std::function<std::vector<HyperelasticLaw>(std::span<const double> shape)> basis;

  /// The law of these shape parameters and moduli (Pa).
  std::function<HyperelasticLaw(std::span<const double> shape, std::span<const double> moduli)> compose;
};

/// Every law, and those of several moduli once more without negative ones.
/// @param largest_excess largest I1 - 3 of the test, which Gent's law must reach
std::vector<LawFamily> law_families(double largest_excess);

}  // namespace menger::materials
