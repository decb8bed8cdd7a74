#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace menger::evolution {

/// A confidence interval of 95 %.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A rank correlation, -1 ... 1.
struct RankCorrelation {
  double value = 0.0;

  /// The confidence interval by Fisher's z: tanh(artanh(value) -+ 1.96 s). None for too few pairs, and at -1 and 1, where z is
  /// infinite. It holds for independent pairs. If designs were chosen because they are good, the correlation over all designs is
  /// less certain than the interval.
  std::optional<Interval> interval;
};

/// Returns the ranks of values: 1 for the smallest. Equal values share the mean of their ranks.
std::vector<double> mid_ranks(std::span<const double> values);

/// Computes Spearman's rho, the correlation of the mid-ranks. The interval has s^2 = (1 + rho^2 / 2) / (n - 3), for n >= 4 pairs.
/// @cite bonett2000sample
/// Precondition: as many x as y, all finite.
/// @return nothing for fewer than two pairs, or if all x or all y are equal
std::optional<RankCorrelation> spearman_correlation(std::span<const double> x, std::span<const double> y);

/// Computes Kendall's tau-b: (concordant - discordant pairs) / sqrt(pairs untied in x times pairs untied in y). The interval has
/// s^2 = 0.437 / (n - 4), for n >= 5. @cite bonett2000sample
/// Precondition and return as for spearman_correlation.
std::optional<RankCorrelation> kendall_correlation(std::span<const double> x, std::span<const double> y);

/// A proportion, with Wilson's score interval.
struct Share {
  std::size_t count = 0;
  std::size_t of = 0;
  double value = 0.0;
  Interval interval;
};

/// Computes count / of. @return nothing if `of` is 0. Precondition: count <= of
std::optional<Share> share(std::size_t count, std::size_t of);

/// The loss if one evaluates only the k designs that are best by a surrogate. All values are by the reference evaluator.
struct TopRegret {
  double best = 0.0;         ///< the best value of all designs
  double best_of_top = 0.0;  ///< the best value of the k designs that are best by the surrogate
  double regret = 0.0;       ///< best - best_of_top >= 0
  std::size_t shared = 0;    ///< number of designs that are among the k best of both
};

/// Computes the regret. Of equal values the first counts as the better.
/// @param surrogate, reference values by both evaluators, one per design; larger is better
/// @param k >= 1
/// @return nothing if there are fewer than k designs
std::optional<TopRegret> top_regret(std::span<const double> surrogate, std::span<const double> reference, std::size_t k);

}  // namespace menger::evolution
