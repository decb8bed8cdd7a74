#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "voxel/validation/validation.h"

namespace menger::voxel {

/// Position of an error: in a list of comparisons, and in the errors of one.
struct ErrorPlace {
  std::size_t comparison = 0;
  std::size_t error = 0;
};

/// The distribution of errors of one kind of observable. Errors are magnitudes, see ObservableError. A number without a response
/// counts as an error larger than any other.
struct ErrorSummary {
  ObservableKind kind = ObservableKind::displacement;
  bool inside = true;     ///< whether inside the range of validity of the parameters; numbers outside are counted separately
  std::size_t count = 0;  ///< numbers compared
  std::size_t without_equilibrium = 0;  ///< numbers without a response
  /// Nothing if it falls among the without_equilibrium numbers; likewise the 90th percentile.
  std::optional<double> median{};
  std::optional<double> percentile_90{};
  std::optional<double> worst{};             ///< of the numbers with a response
  std::optional<double> pointwise_median{};  ///< of the pointwise errors, if there are any
  std::string worst_body{};
  std::string worst_case{};
  std::string worst_observable{};
  /// Of displacements, which are lengths: |surrogate - reference|, m. A small error of a body can be a large one of a curve that
  /// hardly answers.
  std::optional<double> median_m{};
  std::optional<double> worst_m{};       ///< of the number with the worst error
  std::optional<ErrorPlace> furthest{};  ///< the largest difference over the length of its body
};

/// The p-quantile of values, 0 <= p <= 1. It is linear between the sorted values; the first is at p = 0, the last at p = 1.
/// @param values not empty
double quantile(std::vector<double> values, double p);

/// The p-quantile of values of which some are known only to be larger than all others.
/// @param values the known values @param larger number of the other, larger values
/// @return nothing if the quantile lies among the larger values, or if there is no value
std::optional<double> quantile(std::vector<double> values, double p, std::size_t larger);

/// Summarises errors: one summary for each kind and side of the range of validity with errors or numbers without a response,
/// inside first. @param body if given, only numbers of this body
std::vector<ErrorSummary> summarise(const std::vector<CurveComparison>& comparisons,
                                    const std::optional<std::string>& body = std::nullopt);

/// The summary of a kind inside the range of validity; nullptr if there is none.
const ErrorSummary* find_summary(const std::vector<ErrorSummary>& summaries, ObservableKind kind);

/// The bodies of comparisons, each once, in the order of their first curve.
std::vector<std::string> bodies_of(const std::vector<CurveComparison>& comparisons);

/// The largest error in displacement and volume inside the range of validity. If there is none inside, it is the largest of all
/// errors in displacement and volume; if there is none of these, the largest of all errors. Nothing without errors.
std::optional<ErrorPlace> worst_error(const std::vector<CurveComparison>& comparisons);

/// How far the surrogate is off where it takes a shape worst, in lengths that compare bodies and curves.
struct FurthestDisplacement {
  std::string body;
  std::string observable;
  double pressure_Pa = 0.0;
  double difference_m = 0.0;  ///< |surrogate - reference|
  double share = 0.0;         ///< of the length of the body: its longest side at rest
  double error = 0.0;         ///< the same as a magnitude of ObservableError::error
};

/// @param place of a displacement
FurthestDisplacement furthest_displacement(const std::vector<CurveComparison>& comparisons, const ErrorPlace& place);

/// Where the shape of a body is furthest off: the displacement with the largest difference over the length of its body, inside
/// the range of validity. If there is none inside, it is the largest of all displacements; without displacements the worst_error.
std::optional<ErrorPlace> furthest_off(const std::vector<CurveComparison>& comparisons);

/// How often the surrogate moves an observable of a body the wrong way.
struct SignCount {
  std::string body;
  std::string observable;
  std::size_t count = 0;  ///< numbers compared
  std::size_t wrong = 0;  ///< of these, with another sign than the reference
  bool inside = true;     ///< the range of validity

  bool operator==(const SignCount&) const = default;
};

/// Counts the displacements whose sign is wrong, inside the range of validity and outside. Only those count that the reference
/// moves by meshes::smallest_signed_m or more. One entry per body, observable and side of the range with any such number, in the
/// order of the curves.
std::vector<SignCount> count_signs(const std::vector<CurveComparison>& comparisons);

/// The errors of one kind of observable, over all bodies, compared with an aim.
struct AimOutcome {
  ObservableKind kind = ObservableKind::displacement;
  /// Inside the range of validity; nothing if no number was compared there, or if half have no response.
  std::optional<double> median{};
  bool met = false;
  std::size_t count = 0;                 ///< numbers compared inside the range of validity
  std::size_t undetermined_inside = 0;   ///< counted as errors above the aim
  std::size_t undetermined_outside = 0;  ///< the parameters claim nothing about these
  /// Bodies whose own median is larger than the aim or does not exist, worst first.
  std::vector<std::string> bodies_beyond{};
};

/// Compares median errors in displacement and volume with an aim.
std::vector<AimOutcome> assess(const std::vector<CurveComparison>& comparisons, double aim);

}  // namespace menger::voxel
