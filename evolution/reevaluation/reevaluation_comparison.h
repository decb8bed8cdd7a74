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

/// A chosen design and its results in both models: that which is compared, voxels or the search's own finite elements, and the
/// finite elements of the re-evaluation.
struct ReevaluatedDesign {
  ChosenDesign design;
  SurrogateWalk surrogate;  ///< in the model that is compared
  LocomotionRun elements;
  bool is_balanced = true;  ///< see is_balanced(); if false, it falls over by itself
};

/// Returns the word for the model that is compared: "surrogate", or "search" for the finite elements of the search.
std::string model_of_search(const ReevaluationStudy& study);

/// The displacement of a body as distance, direction and speed.
struct Motion {
  double horizontal_m = 0.0;            ///< horizontal distance
  std::optional<double> direction_deg;  ///< from +x towards +y, (-180, 180]; none if it moved less than least_body_lengths
  double body_lengths = 0.0;
  double body_lengths_per_minute = 0.0;
};
Motion motion_of(const ReevaluationStudy& study, const std::array<double, 3>& displacement_m);

/// Returns the angle between the horizontal parts of two displacements, 0 ... 180 degrees; none if either is shorter than
/// `least_m`.
std::optional<double> angle_between_deg(const std::array<double, 3>& a, const std::array<double, 3>& b, double least_m);

/// Returns the length of the horizontal part of b - a divided by that of a; none if that of a is shorter than `least_m`.
std::optional<double> relative_change(const std::array<double, 3>& a, const std::array<double, 3>& b, double least_m);

/// The difference between the displacements of a design in both models.
struct ModelGap {
  std::optional<double> ratio;           ///< distance on finite elements / distance on the surrogate
  std::optional<double> angle_deg;       ///< between both, see angle_between_deg
  std::optional<double> relative_error;  ///< of the surrogate relative to finite elements, see relative_change
};
ModelGap gap_of(const ReevaluationStudy& study, const ReevaluatedDesign& design);

/// How well the surrogate ranks a set of designs by their distances. Designs that did not complete in both models are left out.
/// Distances below least_body_lengths count as equal, since rounding would decide their order.
struct Ranking {
  std::string name;           ///< of the set: "sample", "top", "balanced" or "all"
  std::size_t evaluated = 0;  ///< number of designs in the set
  std::size_t compared = 0;   ///< number of these that have a displacement in both models
  std::optional<RankCorrelation> spearman;
  std::optional<RankCorrelation> kendall;
  std::optional<Share> within_45_deg;  ///< share of the designs with a direction in both models for which these agree so well
  std::optional<Share> within_90_deg;  ///< likewise
  std::optional<TopRegret> best;       ///< for the surrogate's best design alone, body lengths per minute; none if none is ranked
  std::optional<TopRegret> best_of_k;  ///< for the k best; none if there are no more than k
  std::size_t k = 1;
};

/// Ranks a set of designs. @param k of Ranking::best_of_k, >= 1
Ranking rank_designs(const ReevaluationStudy& study, const std::string& name, std::span<const ReevaluatedDesign* const> designs,
                     std::size_t k);

/// Ranks every set that has at least two designs. With a sample, the sample and then the top designs come first, because both
/// together do not represent any population. If some designs are not balanced, the set of those that are follows. The set of all
/// designs is the last.
std::vector<Ranking> rank_all(const ReevaluationStudy& study, const std::vector<ReevaluatedDesign>& designs);

}  // namespace menger::evolution
