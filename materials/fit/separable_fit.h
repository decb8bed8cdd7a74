#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "materials/fit/law_family.h"

namespace menger::materials {

/// The law of a family with the least squares of errors.
struct SeparableFit {
  HyperelasticLaw law;
  io::RunStatus status = io::RunStatus::completed;  ///< not_converged if the solver did not converge from the best start
  std::vector<std::string> shape_at_bound;          ///< names of the shape parameters that ended at a bound of their search range
};

/// Fits a family to nominal stresses of uniaxial tension by unweighted least squares.
///
/// For given shape parameters the moduli solve a linear least-squares problem (QR). So the solver (Ceres, Levenberg-Marquardt)
/// searches only the shape parameters. It runs from every start of the family, and the best result is returned.
/// @param stretch, stress_Pa of the same length, not all stresses zero
/// @return nothing if no start gives a finite result, for example if no law of the family extends to the stretches
std::optional<SeparableFit> fit_family(const LawFamily& family, const std::vector<double>& stretch,
                                       const std::vector<double>& stress_Pa);

}  // namespace menger::materials
