#pragma once

#include <variant>

#include "materials/laws/volumetric_energy.h"

namespace menger::fem {

/// A volumetric energy. Their names are "quadratic", "log_squared" and "simo_taylor".
using VolumetricLaw = std::variant<materials::QuadraticVolume, materials::LogSquaredVolume, materials::SimoTaylorVolume>;

}  // namespace menger::fem
