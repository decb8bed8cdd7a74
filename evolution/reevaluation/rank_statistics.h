#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace menger::evolution {

/// A range that holds a value with a confidence of 95 %.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A rank correlation, -1 ... 1.
struct RankCorrelation {
  double value = 0.0;

  /// By Fisher's z, that is tanh(artanh(value) -+ 1.96 s); none for too few pairs, and at -1 and 1, where z is infinite. For
  /// independent pairs; designs chosen because they are good tell less of all designs than the interval says.
  std::optional<Interval> interval;
};

/// Ranks from 1, the smallest value first; equal values share the mean of their ranks.
std::vector<double> mid_ranks(std::span<const double> values);

/// Spearman's rho: the correlation of the mid-ranks. Interval with s^2 = (1 + rho^2 / 2) / (n - 3), for n >= 4.
/// @return nothing for fewer than two pairs or if all values of one side are equal @cite bonett2000sample
/// Precondition: as many x as y, all finite.
std::optional<RankCorrelation> spearman_correlation(std::span<const double> x, std::span<const double> y);

/// Kendall's tau-b: (concordant - discordant pairs) / sqrt(pairs untied in x times pairs untied in y). Interval with
/// s^2 = 0.437 / (n - 4), for n >= 5. @return, precondition as spearman_correlation @cite bonett2000sample
std::optional<RankCorrelation> kendall_correlation(std::span<const double> x, std::span<const double> y);

/// A part of a whole with Wilson's score interval.
struct Share {
  std::size_t count = 0;
  std::size_t of = 0;
  double value = 0.0;
  Interval interval;
};

/// @return nothing for a part of nothing. Precondition: count <= of
std::optional<Share> share(std::size_t count, std::size_t of);

/// What is lost by looking only at the k designs that a surrogate thinks best.
struct TopRegret {
  double best = 0.0;         ///< of all, by the judge
  double best_of_top = 0.0;  ///< of the k that are best by the surrogate
  double regret = 0.0;       ///< best - best_of_top >= 0
  std::size_t shared = 0;    ///< of the k best by the judge, how many are among the k best by the surrogate
};

/// Of equals on either side the first counts as the better. @return nothing if there are fewer than k designs
/// @param surrogate, judge larger is better, one entry per design @param k >= 1
std::optional<TopRegret> top_regret(std::span<const double> surrogate, std::span<const double> judge, std::size_t k);

}  // namespace menger::evolution
