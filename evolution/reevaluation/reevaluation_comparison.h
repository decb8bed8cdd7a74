#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evolution/reevaluation/rank_statistics.h"
#include "evolution/reevaluation/reevaluation_selection.h"
#include "evolution/reference/reevaluation_runner.h"
#include "evolution/reference/reevaluation_surrogate.h"

namespace menger::evolution {

/// A chosen design in both models.
struct JudgedDesign {
  ChosenDesign design;
  SurrogateWalk surrogate;
  LocomotionRun elements;
  bool is_balanced = true;  ///< see is_balanced(): else it falls over by itself
};

/// How a body went.
struct Motion {
  double horizontal_m = 0.0;
  std::optional<double> direction_deg;  ///< from +x towards +y, (-180, 180]; nothing if it moved less than least_body_lengths
  double body_lengths = 0.0;
  double body_lengths_per_minute = 0.0;
};
Motion motion_of(const ReevaluationStudy& study, const std::array<double, 3>& displacement_m);

/// Angle between the horizontal parts of two displacements, 0 ... 180 degrees; nothing if either moved less than `least_m`.
std::optional<double> angle_between_deg(const std::array<double, 3>& a, const std::array<double, 3>& b, double least_m);

/// Length of the horizontal part of b - a by that of a; nothing if a moved less than `least_m`.
std::optional<double> relative_change(const std::array<double, 3>& a, const std::array<double, 3>& b, double least_m);

/// Two displacements of a design against each other.
struct ModelGap {
  std::optional<double> ratio;           ///< of the distances, finite elements by surrogate
  std::optional<double> angle_deg;       ///< see angle_between_deg
  std::optional<double> relative_error;  ///< of the surrogate, by finite elements, see relative_change
};
ModelGap gap_of(const ReevaluationStudy& study, const JudgedDesign& design);

/// How well the surrogate ranks a set of designs, by their distances. Designs that did not complete in both models are left out.
/// Distances below least_body_lengths are equal: their order would be that of rounding.
struct Ranking {
  std::string name;          ///< of the set: "sample", "top", "balanced" or "all"
  std::size_t judged = 0;    ///< designs of the set
  std::size_t compared = 0;  ///< of which both models have a displacement
  std::optional<RankCorrelation> spearman;
  std::optional<RankCorrelation> kendall;
  std::optional<Share> within_45_deg;  ///< of the designs that have a direction in both
  std::optional<Share> within_90_deg;
  std::optional<TopRegret> best;       ///< of the surrogate's best alone, body lengths per minute
  std::optional<TopRegret> best_of_k;  ///< of the k best; nothing where these are all there are
  std::size_t k = 1;
};

/// @param k of the regret, >= 1
Ranking rank_designs(const ReevaluationStudy& study, const std::string& name, std::span<const JudgedDesign* const> designs,
                     std::size_t k);

/// The sets that have at least two designs. Where there is a sample both parts come first, the sample before all, since the best
/// and a sample of the others together stand for no population; where some designs are not balanced, then those that are.
std::vector<Ranking> rank_all(const ReevaluationStudy& study, const std::vector<JudgedDesign>& designs);

}  // namespace menger::evolution
