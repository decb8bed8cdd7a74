#include "fem/implicit/implicit_scheme.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace menger::fem {

GeneralisedAlpha generalised_alpha(double spectral_radius) {
  GeneralisedAlpha scheme{};
  scheme.alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0);
  scheme.alpha_f = spectral_radius / (spectral_radius + 1.0);
  const double shift = scheme.alpha_m - scheme.alpha_f;
  scheme.beta = 0.25 * (1.0 - shift) * (1.0 - shift);
  scheme.gamma = 0.5 - shift;
  scheme.error_constant = scheme.beta + 0.5 * shift - 1.0 / 6.0;
  return scheme;
}

double next_step_s(double step_s, double error, double wanted_s) {
  constexpr double growth = 1.5;
  if (error <= 0.0) return growth * wanted_s;
  const double factor = std::max(0.8 * std::pow(error, -1.0 / 3.0), 0.2);
  if (factor >= growth) return std::min(growth * wanted_s, factor * step_s);
  return std::min(factor, 1.0) * step_s;
}

std::optional<double> longest_step_s(std::span<const PlenumSchedule> schedules) {
  std::optional<double> longest;
  const auto limit = [&](double step_s) { longest = std::min(step_s, longest.value_or(step_s)); };
  for (const PlenumSchedule& plenum : schedules) {
    if (plenum.ramp_s > 0.0) limit(0.5 * plenum.ramp_s);
    if (const auto* sine = std::get_if<SinePressure>(&plenum.schedule)) limit(0.05 / sine->frequency_Hz);
    if (const auto* square = std::get_if<SquarePressure>(&plenum.schedule)) {
      limit(0.05 / square->frequency_Hz);
      if (square->rise_s > 0.0) limit(0.5 * square->rise_s);
    }
    if (const auto* table = std::get_if<PressureTable>(&plenum.schedule)) {
      for (std::size_t row = 1; row < table->times_s.size(); ++row) limit(0.5 * (table->times_s[row] - table->times_s[row - 1]));
    }
  }
  return longest;
}

}  // namespace menger::fem
