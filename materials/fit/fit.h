#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/text/run_status.h"
#include "materials/fit/tensile_test.h"
#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

/// Engineering strains between which a law is fitted, ends included.
struct StrainRange {
  double lowest = 0.0;
  double highest = 1.0;
};

/// A law fitted to a tensile test, and how much it is to be trusted.
struct LawFit {
  std::string name;  ///< of the law, with "_non_negative" if its moduli were kept from being negative
  HyperelasticLaw law;
  io::RunStatus status = io::RunStatus::completed;  ///< completed or not_converged

  double rmse_Pa = 0.0;
  double relative_rmse = 0.0;  ///< RMSE over the largest stress
  double r_squared = 0.0;      ///< about the mean stress
  double aic = 0.0;            ///< n ln(SSE/n) + 2 k with stresses in MPa and k parameters

  /// Parameters that the fit left at a bound: shape parameters at the end of their search, moduli kept from being negative.
  std::vector<std::string> at_bound;

  /// Interval that holds a parameter with 95 % if the law is right and errors are independent, in the order of parameters_of;
  /// nothing for parameters at a bound, which count as known. Empty if the test cannot tell the others apart. Where the law is
  /// wrong in shape the intervals are too narrow.
  std::vector<std::optional<std::pair<double, double>>> confidence_95;

  /// First stretch at which more strain takes less stress, by mode, looked for up to 10; nothing if there is none.
  std::optional<double> unstable_uniaxial;
  std::optional<double> unstable_equibiaxial;
  std::optional<double> unstable_planar;

  /// The stretch nearest to 1 at which, in compression in any of the three modes, more strain takes less stress, looked for down
  /// to 0.3; nothing if there is none.
  std::optional<double> unstable_compression;
  bool stable = false;              ///< none in compression, nor in tension up to the largest fitted stretch
  bool stable_with_margin = false;  ///< nor up to a quarter more than the largest fitted strain

  /// Whether terms of Ogden's law pull against each other (mu_p alpha_p of both signs): tension alone does not determine such
  /// laws.
  bool cancelling = false;

  std::optional<double> equibiaxial_ratio;  ///< to uniaxial stress, at a stretch of 1.5
  bool plausible = false;                   ///< that ratio is one of silicone, 1.1 to 1.7
};

/// Fits every law to a test by unweighted least squares of the nominal stress and ranks them in three groups: those fit for use,
/// then other stable ones, then the unstable. Within a group fits whose solver gave up come last; otherwise the smaller AIC comes
/// first.
///
/// Fit for use is a fit that is completed, stable with a margin, plausible and without cancelling terms, whose RMSE is at most 5
/// % of the largest stress, and whose parameters have intervals that do not hold 0 (a modulus kept from being negative may be 0).
/// Ogden laws of several terms of which one vanished are left out.
/// @throws io::InputError naming the range if it holds fewer than eight rows, or only rows without stress
std::vector<LawFit> fit_laws(const TensileTest& test, const StrainRange& range);

/// The first of the ranking if it is fit for use and its RMSE is at most three times that of the closest stable and plausible
/// fit, or 0.5 % of the largest stress; otherwise nothing: then no law of the list is to be used unseen.
const LawFit* recommended_fit(const std::vector<LawFit>& ranking);

}  // namespace menger::materials
