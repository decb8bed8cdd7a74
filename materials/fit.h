#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/run_status.h"
#include "materials/homogeneous_deformations.h"
#include "materials/tensile_test.h"

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
  double r_squared = 0.0;  ///< about the mean stress
  double aic = 0.0;        ///< n ln(SSE/n) + 2 k with stresses in MPa and k parameters

  /// Interval that holds a parameter with 95 % if the law is right and errors are independent, in the order of parameters_of.
  /// Empty if the test cannot tell the parameters apart. Where the law is wrong in shape the intervals are too narrow.
  std::vector<std::pair<double, double>> confidence_95;

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

/// Fits every law to a test by unweighted least squares of the nominal stress and ranks them: stable and plausible ones first,
/// then stable ones, then the others, in each group by AIC. Fits whose solver gave up come last in their group.
/// @throws io::InputError naming the range if it holds fewer than eight rows, or only rows without stress
std::vector<LawFit> fit_laws(const TensileTest& test, const StrainRange& range);

/// The first of the ranking if it is plausible, stable with a margin and without cancelling terms, otherwise nothing: then no law
/// of the list is to be used unseen.
const LawFit* recommended_fit(const std::vector<LawFit>& ranking);

}  // namespace menger::materials
