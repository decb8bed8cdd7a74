#pragma once

#include <cstddef>
#include <vector>

namespace menger::fem {

/// A Maxwell branch: a spring in series with a dashpot, in parallel with the law of a material. It resists fast motion and
/// relaxes in time.
///
/// A symmetric tensor A per point describes the deformation at which the branch is at rest. With C' = J^(-2/3) C:
///   energy       psi = m/2 ((A : C' - 3) - ln det A),
///   relaxation   dA/dt = (C'^-1 - A) / tau,
///   stress       P = m J^(-2/3) (F A - (A : C)/3 F^-T), without pressure,
///   dissipation  m / (2 tau) (A : C' + A^-1 : C'^-1 - 6), never negative.
/// At A = C'^-1 the branch has no stress. Rotations change nothing, since A belongs to the reference configuration. This is the
/// transient network of @cite linder2011micromechanically.
///
/// At small strain it is Maxwell's element. Beside a shear modulus mu, with g = m / mu, at the angular frequency w:
///   storage modulus  mu (1 + g w^2 tau^2 / (1 + w^2 tau^2)),
///   loss modulus     mu g w tau / (1 + w^2 tau^2),
///   loss factor      g w tau / (1 + (1 + g) w^2 tau^2).
/// The stiffness is mu in slow motion and (1 + g) mu in fast motion, where the loss factor becomes ever smaller. So the stiffness
/// has an upper bound, and the stable step a lower one.
struct MaxwellBranch {
  double shear_modulus_Pa = 0.0;   ///< m >= 0 of the spring; 0: no branch
  double relaxation_time_s = 0.0;  ///< tau, > 0 where there is a branch

  [[nodiscard]] bool is_there() const { return shear_modulus_Pa > 0.0; }
};

/// The most branches of one material: three follow a loss factor over a decade and a half of frequencies.
inline constexpr std::size_t most_branches = 3;

/// How many sets of numbers elements keep for branches in parallel. One branch has one. Of several, the first set is their mean,
/// weighted by their moduli: stress is linear in A, so that the mean gives the stress of all, and forces cost what those of one
/// branch do. Each branch has a set of its own after it, which changes where branches relax.
constexpr std::size_t branch_set_count(std::size_t branches) { return branches > 1 ? branches + 1 : branches; }

/// Returns those of some branches that have a modulus.
std::vector<MaxwellBranch> acting(const std::vector<MaxwellBranch>& branches);

}  // namespace menger::fem
