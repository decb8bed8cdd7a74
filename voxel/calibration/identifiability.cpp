#include "voxel/calibration/identifiability.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <random>

namespace menger::voxel {
namespace {

constexpr double claim = 0.95;

/// Replaces the references of curves by the responses of the true parameters; nothing if there is no equilibrium.
std::optional<std::vector<FittedCurve>> exact_curves(std::vector<FittedCurve> curves, const SurrogateParameters& truth,
                                                     const Responder& responder) {
  for (FittedCurve& curve : curves) {
    const auto responses = responses_of(curve, responder(truth, curve.load_case, curve.states));
    if (!responses) return std::nullopt;
    curve.reference = *responses;
  }
  return curves;
}

void add_noise(std::vector<FittedCurve>& curves, std::mt19937_64& stream) {
  std::normal_distribution<double> normal;
  for (FittedCurve& curve : curves) {
    for (std::size_t o = 0; o < curve.ordinates.size(); ++o) {
      for (double& value : curve.reference[o]) value += curve.sigma[o] * normal(stream);
    }
  }
}

bool is_softening(Quantity quantity) {
  return quantity == Quantity::extension_pressure_softening || quantity == Quantity::extension_vacuum_softening ||
         quantity == Quantity::bulge_pressure_softening || quantity == Quantity::bulge_vacuum_softening;
}

SurrogateParameters far_start(const SurrogateParameters& truth, const std::vector<FittedParameter>& parameters, double factor,
                              std::mt19937_64& stream) {
  SurrogateParameters start = truth;
  std::bernoulli_distribution is_up;
  for (const FittedParameter& parameter : parameters) {
    const double value = value_in(truth, parameter) * (is_up(stream) ? factor : 1.0 / factor);
    const double begin = is_softening(parameter.quantity) ? 0.0 : value;
    set_value(start, parameter, std::clamp(begin, parameter.bounds.lowest, parameter.bounds.highest));
  }
  return start;
}

}  // namespace

Identifiability identifiability(const std::vector<FittedCurve>& curves, const std::vector<FittedParameter>& parameters,
                                const SurrogateParameters& truth, const Responder& responder,
                                const IdentifiabilityOptions& options) {
  Identifiability result;
  for (const FittedParameter& parameter : parameters)
    result.coverage.push_back({.name = parameter.name, .truth = value_in(truth, parameter)});
  const auto exact = exact_curves(curves, truth, responder);
  if (!exact) return result;
  for (int n = 0; n < options.fit_count; ++n) {
    std::mt19937_64 stream(options.seed + static_cast<std::uint64_t>(n));
    std::vector<FittedCurve> noisy = *exact;
    add_noise(noisy, stream);
    const SurrogateParameters start = far_start(truth, parameters, options.start_factor, stream);
    const CalibrationFit fit = fit_parameters(noisy, parameters, start, responder, {.stop = options.stop});
    if (fit.status == io::RunStatus::stopped) break;
    ++result.fit_count;
    if (options.progress) options.progress(result.fit_count);
    if (fit.status != io::RunStatus::completed) {
      ++result.failed_count;
      continue;
    }
    for (const FittedValue& value : fit.values) {
      Coverage& coverage = *std::find_if(result.coverage.begin(), result.coverage.end(),
                                         [&](const Coverage& known) { return known.name == value.parameter.name; });
      coverage.mean += value.value;
      if (!value.confidence_95) continue;
      ++coverage.interval_count;
      if (value.confidence_95->first <= coverage.truth && coverage.truth <= value.confidence_95->second) ++coverage.hit_count;
    }
  }
  const int counted = result.fit_count - result.failed_count;
  for (Coverage& coverage : result.coverage) coverage.mean /= std::max(counted, 1);
  return result;
}

std::vector<FittedParameter> claimed_parameters(const CalibrationFit& fit) {
  std::vector<FittedParameter> claimed;
  for (const FittedValue& value : fit.values) {
    if (value.confidence_95) claimed.push_back(value.parameter);
  }
  return claimed;
}

std::pair<int, int> likely_hits(int n, double probability) {
  using boost::math::policies::discrete_quantile;
  using Upwards = boost::math::policies::policy<discrete_quantile<boost::math::policies::integer_round_up>>;
  constexpr double tail = 0.005;
  const boost::math::binomial_distribution<double, Upwards> hits(n, probability);
  return {static_cast<int>(quantile(hits, tail)), static_cast<int>(quantile(complement(hits, tail)))};
}

io::CsvTable identifiability_table(const Identifiability& result) {
  io::CsvTable table({"parameter", "truth", "mean", "intervals", "hits", "lowest_likely_hits", "highest_likely_hits"});
  for (const Coverage& coverage : result.coverage) {
    const auto [lowest, highest] = likely_hits(coverage.interval_count, claim);
    table.add_row(coverage.name, coverage.truth, coverage.mean, coverage.interval_count, coverage.hit_count, lowest, highest);
  }
  return table;
}

}  // namespace menger::voxel
