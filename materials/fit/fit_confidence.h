#pragma once

#include <vector>

#include "materials/fit/fit.h"

namespace menger::materials {

/// Sets the confidence intervals of the parameters that are not at a bound (see LawFit::confidence_95). The law of the fit is
/// linearised about its parameters.
/// @param stretch stretches of the fitted rows, more than there are parameters; the RMSE of the fit must be set
void set_confidence(LawFit& fit, const std::vector<double>& stretch);

}  // namespace menger::materials
