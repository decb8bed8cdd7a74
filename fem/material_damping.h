#pragma once

#include "materials/silicone_record.h"

namespace menger::fem {

/// The viscosity of a material and what it comes from.
struct MaterialDamping {
  double viscosity_Pa_s = 0.0;  ///< eta of ExplicitMaterial
  materials::LossData loss;     ///< with its source
  bool is_measured = false;     ///< false: `assumed_silicone_loss`
};

/// What stands in where damping was not measured: loss modulus a tenth of the storage modulus at 30 Hz, in the range of the first
/// natural frequencies of hollow modules of centimetres. An assumption, whose influence a study has to show by varying it.
materials::LossData assumed_silicone_loss();

/// eta = mu tan(delta) / (2 pi f): at the frequency f of the data the loss factor of small shear is that of the data. It grows in
/// proportion to the frequency, as silicones' does not: one viscosity holds for one range of frequencies. A Prony series, which
/// holds for more, needs loss factors at several frequencies: one alone does not determine it, and no record has even that.
/// @param shear_modulus_Pa mu at rest, > 0
double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss);

/// Damping of a silicone with the stiffness of its recommended law.
MaterialDamping damping_of(const materials::SiliconeRecord& record);

}  // namespace menger::fem
