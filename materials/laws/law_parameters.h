#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "materials/laws/hyperelastic_law.h"

namespace menger::materials {

/// Returns the name and value of each parameter of a law: {"shear_modulus_Pa", 86e3}, ... For Ogden's law: modulus_1_Pa,
/// exponent_1, modulus_2_Pa, ...
std::vector<std::pair<std::string, double>> parameters_of(const HyperelasticLaw& law);

/// Returns the same kind of law with other parameters. @param values as many as parameters_of returns, in its order (asserted)
HyperelasticLaw with_parameters(const HyperelasticLaw& law, std::span<const double> values);

}  // namespace menger::materials
