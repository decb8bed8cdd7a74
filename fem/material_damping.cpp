#include "fem/material_damping.h"

#include <numbers>

namespace menger::fem {

materials::LossData assumed_silicone_loss() {
  return {.source = "assumed, because damping was not measured", .tan_delta = 0.1, .frequency_Hz = 30.0};
}

double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss) {
  return shear_modulus_Pa * loss.tan_delta / (2.0 * std::numbers::pi * loss.frequency_Hz);
}

MaterialDamping damping_of(const materials::SiliconeRecord& record) {
  MaterialDamping damping;
  damping.is_measured = record.loss.has_value();
  damping.loss = record.loss.value_or(assumed_silicone_loss());
  damping.viscosity_Pa_s = viscosity_Pa_s(materials::shear_modulus_at_rest_Pa(record.recommended.law), damping.loss);
  return damping;
}

}  // namespace menger::fem
