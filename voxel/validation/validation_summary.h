#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "voxel/validation/validation.h"

namespace menger::voxel {

/// How errors of one kind of observable are spread. Errors are magnitudes, see ObservableError. Numbers without an answer count
/// as errors larger than any other.
struct ErrorSummary {
  ObservableKind kind = ObservableKind::displacement;
  bool inside = true;              ///< of the range of validity of the parameters; what lies outside is counted apart
  std::size_t count = 0;           ///< numbers compared
  std::size_t unanswered = 0;      ///< numbers without an answer
  std::optional<double> median{};  ///< none where it falls among the unanswered; so for the 90th percentile
  std::optional<double> percentile_90{};
  std::optional<double> worst{};             ///< of the answered
  std::optional<double> pointwise_median{};  ///< of the pointwise errors, where there are any
  std::string worst_body{};
  std::string worst_case{};
};

/// The p-quantile of values, 0 <= p <= 1, linear between the sorted values, of which the first is at p = 0 and the last at p = 1.
/// @param values not empty
double quantile(std::vector<double> values, double p);

/// The p-quantile of values of which some are known only to exceed all others.
/// @param values those that are known @param larger how many others there are, all of them larger
/// @return nothing if the quantile lies among the others, or if there is no value at all
std::optional<double> quantile(std::vector<double> values, double p, std::size_t larger);

/// One summary for each kind and side of the range of validity that has errors or numbers without an answer, inside first.
/// @param body only of that body
std::vector<ErrorSummary> summarise(const std::vector<CurveComparison>& comparisons,
                                    const std::optional<std::string>& body = std::nullopt);

/// The summary of a kind inside the range of validity; nullptr if there is none.
const ErrorSummary* find_summary(const std::vector<ErrorSummary>& summaries, ObservableKind kind);

/// Bodies of comparisons, each once, in the order of their first curve.
std::vector<std::string> bodies_of(const std::vector<CurveComparison>& comparisons);

/// Positions in a list of comparisons and in its errors.
struct ErrorPlace {
  std::size_t comparison = 0;
  std::size_t error = 0;
};

/// The largest error in displacement and volume inside the range of validity; if there is none in these inside, the largest there
/// is in them, and if there is none at all the largest of anything. Nothing without errors.
std::optional<ErrorPlace> worst_error(const std::vector<CurveComparison>& comparisons);

/// How far a body is from an aim.
struct AimOutcome {
  ObservableKind kind = ObservableKind::displacement;
  std::optional<double> median{};  ///< inside the range of validity; none if nothing was compared there, or half has no answer
  bool met = false;
  std::size_t count = 0;                     ///< numbers compared inside
  std::size_t unanswered_inside = 0;         ///< which count as missed
  std::size_t unanswered_outside = 0;        ///< of which nothing is claimed
  std::vector<std::string> bodies_beyond{};  ///< whose own median is larger than the aim or has no answer, the worst first
};

/// Compares median errors in displacement and volume with an aim.
std::vector<AimOutcome> judge(const std::vector<CurveComparison>& comparisons, double aim);

}  // namespace menger::voxel
