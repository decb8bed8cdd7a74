#pragma once

#include <vector>

#include "materials/fit/fit.h"

namespace menger::materials {

/// Sets the intervals of the parameters that are at no bound (see LawFit::confidence_95), by the law of the fit linearised about
/// its parameters.
/// @param stretch of the fitted rows, more of them than parameters; the RMSE of the fit must be set
void set_confidence(LawFit& fit, const std::vector<double>& stretch);

}  // namespace menger::materials
