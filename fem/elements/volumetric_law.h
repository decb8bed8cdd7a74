#pragma once

#include <variant>

#include "materials/laws/volumetric_energy.h"

namespace menger::fem {

/// The volumetric energies by name: "quadratic", "log_squared", "simo_taylor".
using VolumetricLaw = std::variant<materials::QuadraticVolume, materials::LogSquaredVolume, materials::SimoTaylorVolume>;

}  // namespace menger::fem
