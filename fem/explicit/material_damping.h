#pragma once

#include <vector>

#include "fem/elements/maxwell_branch.h"
#include "materials/laws/silicone_record.h"

namespace menger::fem {

/// The damping model of a material.
enum class DampingModel {
  maxwell,       ///< branches: see maxwell_branches
  kelvin_voigt,  ///< a viscosity: see viscosity_Pa_s
};

/// Returns the loss factor that is assumed where damping was not measured: tan(delta) = 0.1 at 30 Hz.
///
/// The loss modulus is thus a tenth of the storage modulus. The first natural frequencies of hollow modules of centimetres lie in
/// the range of 30 Hz. A study has to vary this assumption to show its influence.
materials::LossData assumed_silicone_loss();

/// Returns the viscosity eta = mu tan(delta) / (2 pi f). At the frequency f of the data, the loss factor of small shear is that
/// of the data. It grows in proportion to the frequency, unlike that of silicones: one viscosity is valid for one range of
/// frequencies.
/// @param shear_modulus_Pa mu at rest, > 0
double viscosity_Pa_s(double shear_modulus_Pa, const materials::LossData& loss);

/// Returns the branch whose loss factor is largest at the frequency f of the data and equals that of the data there. With t =
/// tan(delta): m = g mu, g = 2 t (t + sqrt(1 + t^2)), tau = 1 / (2 pi f sqrt(1 + g)). The stiffness in slow motion is mu, as
/// without damping. In small shear at f the storage modulus is 2 mu (1 + g) / (2 + g), and in fast motion it is (1 + g) mu.
///
/// It is an assumption that the data are those of the peak. One loss factor at one frequency does not determine a branch. Several
/// branches need loss factors at several frequencies, see maxwell_branches. The loss factor falls to half of its peak at about a
/// quarter of the frequency and at four times the frequency. Motion at higher frequencies is damped less than by the viscosity of
/// the same data. Where friction makes a body walk, chance then has more influence: a body of eighteen cells moves 3.1, 2.6
/// and 3.3 mm in a second at steps of 0.9, 0.8 and 0.6 of the stable one, and 2.8, 2.8 and 2.6 mm with the viscosity, at
/// steps 1.7 times as short.
///
/// @param shear_modulus_Pa mu at rest, > 0
MaxwellBranch maxwell_branch(double shear_modulus_Pa, const materials::LossData& loss);

/// Returns branches in parallel whose loss factor follows the data. Data of one frequency give maxwell_branch; those of several
/// as many branches, most_branches at most. They relax at rates 2 pi f with f from the lowest frequency to one and a half times
/// the highest, in equal ratios: where a loss factor rises, its fastest branch lies beyond. Their moduli are >= 0 and come
/// nearest to the data in the sum of squares of relative errors. Branches without a modulus are left out.
///
/// At the angular frequency w, with g_k = m_k / mu and x_k = w tau_k, the loss factor is
///   sum g_k x_k / (1 + x_k^2) / (1 + sum g_k x_k^2 / (1 + x_k^2)).
/// The stiffness is mu in slow motion and (1 + sum g_k) mu in fast motion.
/// @param shear_modulus_Pa mu at rest, > 0
std::vector<MaxwellBranch> maxwell_branches(double shear_modulus_Pa, const materials::LossData& loss);

/// Returns the loss factor of small shear of a material with branches, see above.
double loss_factor(double shear_modulus_Pa, const std::vector<MaxwellBranch>& branches, double frequency_Hz);

}  // namespace menger::fem
