#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "io/text/run_status.h"
#include "materials/fit/law_family.h"

namespace menger::materials {

/// The least-squares law of a family.
struct SeparableFit {
  HyperelasticLaw law;
  io::RunStatus status = io::RunStatus::completed;  ///< not_converged if the solver gave up on the best start
  std::vector<std::string> shape_at_bound;          ///< names of the shape parameters that ended at a bound of their search
};

/// Fits a family to nominal stresses of uniaxial tension by unweighted least squares.
///
/// For given shape parameters the moduli are those of a linear least-squares problem (QR), so that the solver (Ceres,
/// Levenberg-Marquardt) sees the shape parameters only; it runs from every start of the family and the best end counts.
/// @param stretch, stress_Pa of one length, not all stresses zero
/// @return nothing if no start leads to numbers, as where no law of the family reaches the stretches
std::optional<SeparableFit> fit_family(const LawFamily& family, const std::vector<double>& stretch,
                                       const std::vector<double>& stress_Pa);

}  // namespace menger::materials
