#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "materials/fit/law_family.h"

namespace menger::materials {

/// How many times more the terms of Ogden's law take from each other at rest than they leave: min(P, N) / |P - N|, with the sums
/// P and N of the positive and of the negative parts of the shear modulus, mu_p alpha_p / 2. 0 if no terms have opposite signs,
/// and for other laws.
double cancelled_part(const HyperelasticLaw& law);

/// Beyond this, cancelled_part leaves of the moduli less than any test resolves (0.5 %): the law consists of errors of the test.
inline constexpr double most_cancelled = 200.0;

/// The law of a family with the least squares of errors.
struct SeparableFit {
  HyperelasticLaw law;
  io::RunStatus status = io::RunStatus::completed;  ///< not_converged if the solver did not converge from the best start
  std::vector<std::string> shape_at_bound;          ///< names of the shape parameters that ended at a bound of their search range
  /// Results of other starts that are closer to the test, but have terms that cancel beyond most_cancelled, and are left out.
  std::size_t skipped_count = 0;
};

/// Fits a family to nominal stresses of uniaxial tension by unweighted least squares.
///
/// For given shape parameters the moduli solve a linear least-squares problem (QR). So the solver (Ceres, Levenberg-Marquardt)
/// searches only the shape parameters, with the derivatives of variable projection (Golub and Pereyra 1973). It runs from every
/// start of the family and from the best choices of its grid, and the best result is returned; one with terms that cancel beyond
/// most_cancelled only if there is no other. With many rows, starts are tried on 256 of them, and the best results end on all.
/// @param stretch, stress_Pa of the same length, not all stresses zero
/// @param progress called with the part of the work that is done, 0 to 1; may be empty
/// @return nothing if no start gives a finite result, for example if no law of the family extends to the stretches
std::optional<SeparableFit> fit_family(const LawFamily& family, const std::vector<double>& stretch,
                                       const std::vector<double>& stress_Pa, const std::function<void(double)>& progress = {});

}  // namespace menger::materials
