#include "evolution/evaluation/steady_displacement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace menger::evolution {

std::size_t whole_periods(double duration_s, double period_s) {
  constexpr double rounding = 1e-9;  // of a count of periods
  return static_cast<std::size_t>(std::floor(duration_s / period_s + rounding));
}

std::array<double, 3> steady_displacement_m(std::span<const std::array<double, 3>> periods) {
  assert(!periods.empty());
  if (periods.size() == 1) return periods.front();
  std::array<double, 3> steady{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> means;
    for (std::size_t n = 1; n < periods.size(); ++n) means.push_back(0.5 * (periods[n - 1].at(axis) + periods[n].at(axis)));
    std::ranges::sort(means);
    const double lower = means[(means.size() - 1) / 2];
    const double upper = means[means.size() / 2];
    steady.at(axis) = std::abs(lower) <= std::abs(upper) ? lower : upper;
  }
  return steady;
}

std::optional<std::array<double, 3>> steady_displacement_m(const PeriodDisplacements& all, const LastPeriods& last) {
  if (all.size() < last.count) return std::nullopt;
  return steady_displacement_m(std::span(all).last(last.count));
}

}  // namespace menger::evolution
