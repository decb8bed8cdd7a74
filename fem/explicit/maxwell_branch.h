#pragma once

namespace menger::fem {

/// A spring in line with a dashpot, beside the law of a material: what it answers to fast motion and forgets in time.
///
/// A symmetric tensor A per point says where the branch is at rest: psi = m/2 ((A : C' - 3) - ln det A) with C' = J^(-2/3) C, and
/// dA/dt = (C'^-1 - A) / tau. In the deformation A = C'^-1 it carries nothing. P = m J^(-2/3) (F A - (A : C)/3 F^-T), without
/// pressure; what is lost, m / (2 tau) (A : C' + A^-1 : C'^-1 - 6), is never negative, and rotations change nothing: A lives in
/// the reference configuration. The transient network of @cite linder2011micromechanically.
///
/// At small strain it is Maxwell's element: beside a shear modulus mu, with g = m / mu, the storage modulus at the angular
/// frequency w is mu (1 + g w^2 tau^2 / (1 + w^2 tau^2)), the loss modulus mu g w tau / (1 + w^2 tau^2), and the loss factor
/// g w tau / (1 + (1 + g) w^2 tau^2). Slow motion meets mu alone, fast motion (1 + g) mu and ever smaller loss factors: stiffness
/// has a bound, and so has the stable step.
struct MaxwellBranch {
  double shear_modulus_Pa = 0.0;   ///< m >= 0 of the spring; 0: no branch
  double relaxation_time_s = 0.0;  ///< tau, > 0 where there is a branch

  [[nodiscard]] bool is_there() const { return shear_modulus_Pa > 0.0; }
};

}  // namespace menger::fem
