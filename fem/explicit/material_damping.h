#pragma once

#include "fem/explicit/maxwell_branch.h"
#include "materials/laws/silicone_record.h"

namespace menger::fem {

/// How a material damps.
enum class DampingModel {
  maxwell,       ///< by a branch: see maxwell_branch
  kelvin_voigt,  ///< by a viscosity: see viscosity_Pa_s
};

/// What stands in where damping was not measured: loss modulus a tenth of the storage modulus at 30 Hz, in the range of the first
/// natural frequencies of hollow modules of centimetres. An assumption, whose influence a study has to show by varying it.
materials::LossData assumed_silicone_loss();

/// eta = mu tan(delta) / (2 pi f): at the frequency f of the data the loss factor of small shear is that of the data. It grows in
/// proportion to the frequency, as silicones' does not: one viscosity holds for one range of frequencies.
/// @param shear_modulus_Pa mu at rest, > 0
double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss);

/// The branch whose loss factor is largest at the frequency f of the data, and is that of the data there: with t = tan(delta),
/// m = g mu, g = 2 t (t + sqrt(1 + t^2)), tau = 1 / (2 pi f sqrt(1 + g)). Slow motion meets mu as if there were no damping, small
/// shear at f the storage modulus 2 mu (1 + g) / (2 + g), fast motion (1 + g) mu.
///
/// That the data are those of the peak is an assumption: one loss factor at one frequency does not determine a branch, let alone
/// a series of them, which needs loss factors at several frequencies. The loss factor falls to half of the peak's at about a
/// quarter and four times the frequency. What a body does at higher frequencies is damped less than by the viscosity of the same
/// data, and where friction makes it walk, chance has more of a say: one of eighteen cells goes 3.1, 2.6 and 3.3 mm in a second
/// at steps of 0.9, 0.8 and 0.6 of the stable one, and 2.8, 2.8 and 2.6 mm with the viscosity, at steps 1.7 times as short.
/// @param shear_modulus_Pa mu at rest, > 0
MaxwellBranch maxwell_branch(double shear_modulus_Pa, const materials::LossData& loss);

}  // namespace menger::fem
