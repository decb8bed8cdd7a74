#include "fem/explicit/material_damping.h"

#include <cmath>
#include <numbers>

namespace menger::fem {

materials::LossData assumed_silicone_loss() {
  return {.source = "assumed, because damping was not measured", .tan_delta = 0.1, .frequency_Hz = 30.0};
}

double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss) {
  return shear_modulus_Pa * loss.tan_delta / (2.0 * std::numbers::pi * loss.frequency_Hz);
}

MaxwellBranch maxwell_branch(double shear_modulus_Pa, const materials::LossData& loss) {
  const double ratio = 2.0 * loss.tan_delta * (loss.tan_delta + std::sqrt(1.0 + loss.tan_delta * loss.tan_delta));
  return {.shear_modulus_Pa = ratio * shear_modulus_Pa,
          .relaxation_time_s = 1.0 / (2.0 * std::numbers::pi * loss.frequency_Hz * std::sqrt(1.0 + ratio))};
}

}  // namespace menger::fem
