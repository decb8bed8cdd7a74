#include "evolution/reevaluation/rank_statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace menger::evolution {
namespace {

constexpr double normal_quantile = 1.959963984540054;  ///< of 0.975

/// Returns positions in ascending order of the values; of equals the first one first.
std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  return order;
}

/// Returns the positions of the k largest values; of equals the first ones.
std::vector<std::size_t> largest(std::span<const double> values, std::size_t k) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return values[i]; });
  order.resize(k);
  return order;
}

std::optional<Interval> fisher_interval(double value, double variance) {
  if (!(std::abs(value) < 1.0)) return std::nullopt;
  const double z = std::atanh(value);
  const double half = normal_quantile * std::sqrt(variance);
  return Interval{std::tanh(z - half), std::tanh(z + half)};
}

/// Returns exactly -1 or 1 for a correlation that differs from it by rounding only.
double in_range(double correlation) {
  constexpr double rounding = 1e-12;
  if (std::abs(correlation) > 1.0 - rounding) return correlation > 0.0 ? 1.0 : -1.0;
  return correlation;
}

int sign(double value) { return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0); }

}  // namespace

std::vector<double> mid_ranks(std::span<const double> values) {
  const std::vector<std::size_t> order = ascending(values);
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);  // mean of begin + 1 ... end
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = rank;
    begin = end;
  }
  return ranks;
}

std::optional<RankCorrelation> spearman_correlation(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  const auto n = static_cast<double>(x.size());
  const std::vector<double> a = mid_ranks(x);
  const std::vector<double> b = mid_ranks(y);
  const double mean = 0.5 * (n + 1.0);
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
    ab += (a[i] - mean) * (b[i] - mean);
  }
  if (aa == 0.0 || bb == 0.0) return std::nullopt;
  RankCorrelation found{.value = in_range(ab / std::sqrt(aa * bb)), .interval = {}};
  if (x.size() >= 4) found.interval = fisher_interval(found.value, (1.0 + 0.5 * found.value * found.value) / (n - 3.0));
  return found;
}

std::optional<RankCorrelation> kendall_correlation(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  long long balance = 0;
  long long untied_x = 0;
  long long untied_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const long long dx = sign(x[i] - x[j]);
      const long long dy = sign(y[i] - y[j]);
      balance += dx * dy;
      untied_x += dx * dx;
      untied_y += dy * dy;
    }
  }
  if (untied_x == 0 || untied_y == 0) return std::nullopt;
  const double pairs = std::sqrt(static_cast<double>(untied_x) * static_cast<double>(untied_y));
  RankCorrelation found{.value = in_range(static_cast<double>(balance) / pairs), .interval = {}};
  if (x.size() >= 5) found.interval = fisher_interval(found.value, 0.437 / (static_cast<double>(x.size()) - 4.0));
  return found;
}

std::optional<Share> share(std::size_t count, std::size_t of) {
  assert(count <= of);
  if (of == 0) return std::nullopt;
  const auto n = static_cast<double>(of);
  const double p = static_cast<double>(count) / n;
  const double square = normal_quantile * normal_quantile / n;
  const double middle = (p + 0.5 * square) / (1.0 + square);
  const double half = std::sqrt(square * (p * (1.0 - p) + 0.25 * square)) / (1.0 + square);
  return Share{.count = count,
               .of = of,
               .value = p,
               .interval = {.low = count == 0 ? 0.0 : middle - half, .high = count == of ? 1.0 : middle + half}};
}

std::optional<TopRegret> top_regret(std::span<const double> surrogate, std::span<const double> reference, std::size_t k) {
  assert(surrogate.size() == reference.size() && k >= 1);
  if (reference.size() < k) return std::nullopt;
  const std::vector<std::size_t> thought_best = largest(surrogate, k);
  const std::vector<std::size_t> best = largest(reference, k);
  TopRegret found{.best = reference[best.front()], .best_of_top = reference[thought_best.front()], .regret = 0.0, .shared = 0};
  for (const std::size_t i : thought_best) {
    found.best_of_top = std::max(found.best_of_top, reference[i]);
    if (std::ranges::find(best, i) != best.end()) ++found.shared;
  }
  found.regret = found.best - found.best_of_top;
  return found;
}

}  // namespace menger::evolution
