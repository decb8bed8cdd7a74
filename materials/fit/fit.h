#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/text/run_status.h"
#include "materials/fit/tensile_test.h"
#include "materials/laws/homogeneous_deformations.h"

namespace menger::materials {

/// The range of engineering strains in which a law is fitted, ends included.
struct StrainRange {
  double lowest = 0.0;
  double highest = 1.0;

  [[nodiscard]] bool holds(double strain) const { return lowest <= strain && strain <= highest; }
};

/// The rows of a test that lie in a range of strains.
struct FittedRows {
  std::size_t count = 0;
  double lowest_strain = 0.0;   ///< the smallest strain of these rows; 0 without rows
  double highest_strain = 0.0;  ///< the largest one
};

/// Returns which rows of a test a fit to this range takes.
FittedRows fitted_rows(const TensileTest& test, const StrainRange& range);

/// A law fitted to a tensile test, and how reliable the fit is.
struct LawFit {
  /// Name of the law, with "_non_negative" if its moduli were not allowed to be negative.
  std::string name;
  HyperelasticLaw law;
  io::RunStatus status = io::RunStatus::completed;  ///< completed or not_converged

  double rmse_Pa = 0.0;
  double relative_rmse = 0.0;  ///< RMSE divided by the largest stress
  double r_squared = 0.0;      ///< relative to the variation about the mean stress
  double aic = 0.0;            ///< n ln(SSE/n) + 2 k with stresses in MPa and k parameters

  /// Parameters at a bound: shape parameters at an end of their search range, and moduli that were held at zero because they may
  /// not be negative.
  std::vector<std::string> at_bound;

  /// The 95 % confidence interval of each parameter, in the order of parameters_of. It holds if the law is right and the errors
  /// are independent.
  ///
  /// A parameter at a bound counts as known and has no interval. The list is empty if the test cannot determine the other
  /// parameters. If the law has the wrong shape, the intervals are too narrow.
  std::vector<std::optional<std::pair<double, double>>> confidence_95;

  /// For each mode: the first stretch above 1 at which more strain needs less stress, searched up to 10; nothing if there is
  /// none.
  std::optional<double> unstable_uniaxial;
  std::optional<double> unstable_equibiaxial;
  std::optional<double> unstable_planar;

  /// The stretch below 1 and nearest to 1 at which, in any of the three modes, more strain needs less stress, searched down to
  /// 0.3; nothing if there is none.
  std::optional<double> unstable_compression;
  bool stable = false;              ///< stable in compression, and in tension up to the largest fitted stretch
  bool stable_with_margin = false;  ///< also stable in tension up to 1.25 times the largest fitted strain

  /// How many times more terms of opposite signs (mu_p alpha_p > 0 and < 0) of Ogden's law take from each other at rest than they
  /// leave, see cancelled_part; 0 if there are none. A tensile test alone does not determine such laws.
  double cancelled = 0.0;
  /// Whether more is cancelled than left (cancelled > 1). An error of one modulus is then found more than once over in the law,
  /// so that the freedom to cancel, and not the silicone, may be what brings it close to the test.
  bool cancelling = false;
  /// Closer fits of this law that were left out, because their terms cancel beyond most_cancelled.
  std::size_t skipped_count = 0;

  std::optional<double> equibiaxial_ratio;  ///< equibiaxial divided by uniaxial stress, at a stretch of 1.5
  bool plausible = false;                   ///< whether that ratio is in the range of silicone, 1.1 to 1.7
};

/// Fits every law to a test by unweighted least squares of the nominal stress, and ranks the fits.
///
/// There are three groups: first the usable fits, then the other stable ones, then the unstable ones. Within a group, fits whose
/// solver did not converge come last; otherwise the fit with the smaller AIC comes first.
///
/// A fit is usable if all of the following hold:
/// - it is completed, stable with a margin and plausible, and has no terms of opposite signs;
/// - its RMSE is at most 5 % of the largest stress;
/// - every parameter has a confidence interval that does not contain 0. A modulus that may not be negative may be 0.
///
/// Ogden laws of several terms are left out if the modulus of a term is zero.
/// @param progress called with the part of the work that is done, 0 to 1, and the name of the law; may be empty
/// @throws io::InputError naming the range if it contains fewer than eight rows, only rows without strain or only rows without
/// stress
std::vector<LawFit> fit_laws(const TensileTest& test, const StrainRange& range,
                             const std::function<void(double done, std::string_view law)>& progress = {});

/// Says why a fit is not usable, one reason each; empty if it is usable (see fit_laws).
std::vector<std::string> shortcomings_of(const LawFit& fit);

/// Says which fits were left out or do not count because their terms cancel, one sentence each.
std::vector<std::string> cancelling_notes(const std::vector<LawFit>& ranking);

/// Returns the first fit of a ranking if it is usable and close enough to the test; otherwise nullptr. In that case check a law
/// of the list yourself before you use it. Close enough: its RMSE is at most three times that of the closest stable and plausible
/// fit that is not cancelling, or at most 0.5 % of the largest stress.
const LawFit* recommended_fit(const std::vector<LawFit>& ranking);

}  // namespace menger::materials
