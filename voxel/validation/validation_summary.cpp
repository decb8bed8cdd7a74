#include "voxel/validation/validation_summary.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "meshes/load_cases/shape_agreement.h"

namespace menger::voxel {

namespace {

double difference_of(const ObservableError& error) { return std::abs(error.surrogate - error.reference); }

/// The longest side of the body of a curve at rest, m.
double length_of(const CurveComparison& comparison) {
  const meshes::LoadCase& load_case = comparison.load_case();
  const int cells = meshes::longest_side_cells(load_case.cells, load_case.digits);
  return load_case.cell_edge_m * cells * meshes::longest_side_modules(cells, load_case.level);
}

/// Errors of a kind on one side of the range of validity.
struct Sample {
  std::vector<double> magnitudes;
  std::vector<double> pointwise;
  std::vector<double> differences_m;
  double largest_share = -1.0;
  ErrorSummary summary;

  void add(const std::vector<CurveComparison>& comparisons, const ErrorPlace& place) {
    const CurveComparison& comparison = comparisons[place.comparison];
    const ObservableError& error = comparison.errors[place.error];
    const bool is_length = error.kind == ObservableKind::displacement;
    const double magnitude = std::abs(error.error);
    if (!summary.worst || magnitude > *summary.worst) {
      summary.worst = magnitude;
      summary.worst_body = comparison.body;
      summary.worst_case = comparison.load_case().name;
      summary.worst_observable = error.observable;
      if (is_length) summary.worst_m = difference_of(error);
    }
    if (is_length) {
      differences_m.push_back(difference_of(error));
      const double share = difference_of(error) / length_of(comparison);
      if (share > largest_share) {
        largest_share = share;
        summary.furthest = place;
      }
    }
    magnitudes.push_back(magnitude);
    if (error.pointwise_error) pointwise.push_back(std::abs(*error.pointwise_error));
  }

  [[nodiscard]] ErrorSummary summarised() const {
    ErrorSummary result = summary;
    result.count = magnitudes.size();
    result.median = quantile(magnitudes, 0.5, summary.without_equilibrium);
    result.percentile_90 = quantile(magnitudes, 0.9, summary.without_equilibrium);
    if (!pointwise.empty()) result.pointwise_median = quantile(pointwise, 0.5);
    result.median_m = quantile(differences_m, 0.5, summary.without_equilibrium);  // nothing without any
    return result;
  }
};

/// 0 inside the range of validity, 1 outside.
std::size_t side_of(Validity validity) { return validity == Validity::inside ? 0 : 1; }

std::optional<ErrorPlace> largest_error(const std::vector<CurveComparison>& comparisons,
                                        const std::function<bool(const ObservableError&)>& counts) {
  std::optional<ErrorPlace> place;
  double magnitude = -1.0;
  for (std::size_t c = 0; c < comparisons.size(); ++c) {
    for (std::size_t e = 0; e < comparisons[c].errors.size(); ++e) {
      const ObservableError& error = comparisons[c].errors[e];
      if (!counts(error) || !(std::abs(error.error) > magnitude)) continue;
      magnitude = std::abs(error.error);
      place = ErrorPlace{c, e};
    }
  }
  return place;
}

}  // namespace

double quantile(std::vector<double> values, double p) {
  assert(!values.empty() && p >= 0.0 && p <= 1.0);
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

std::optional<double> quantile(std::vector<double> values, double p, std::size_t larger) {
  const std::size_t known = values.size();
  if (known == 0) return std::nullopt;
  values.resize(known + larger, std::numeric_limits<double>::max());
  const double at = p * static_cast<double>(values.size() - 1);
  if (at > static_cast<double>(known - 1)) return std::nullopt;
  return quantile(std::move(values), p);
}

std::vector<ErrorSummary> summarise(const std::vector<CurveComparison>& comparisons, const std::optional<std::string>& body) {
  std::array<std::array<Sample, observable_kind_count>, 2> samples;
  for (std::size_t c = 0; c < comparisons.size(); ++c) {
    const CurveComparison& comparison = comparisons[c];
    if (body && comparison.body != *body) continue;
    for (std::size_t e = 0; e < comparison.errors.size(); ++e) {
      const ObservableError& error = comparison.errors[e];
      samples.at(side_of(error.validity)).at(static_cast<std::size_t>(error.kind)).add(comparisons, {c, e});
    }
    for (const UndeterminedNumber& number : comparison.without_equilibrium)
      ++samples.at(side_of(number.validity)).at(static_cast<std::size_t>(number.kind)).summary.without_equilibrium;
  }
  std::vector<ErrorSummary> summaries;
  for (std::size_t side = 0; side < samples.size(); ++side) {
    for (std::size_t kind = 0; kind < observable_kind_count; ++kind) {
      const Sample& sample = samples.at(side).at(kind);
      if (sample.magnitudes.empty() && sample.summary.without_equilibrium == 0) continue;
      summaries.push_back(sample.summarised());
      summaries.back().kind = static_cast<ObservableKind>(kind);
      summaries.back().inside = side == 0;
    }
  }
  return summaries;
}

const ErrorSummary* find_summary(const std::vector<ErrorSummary>& summaries, ObservableKind kind) {
  const auto found = std::find_if(summaries.begin(), summaries.end(),
                                  [&](const ErrorSummary& summary) { return summary.inside && summary.kind == kind; });
  return found == summaries.end() ? nullptr : &*found;
}

std::vector<std::string> bodies_of(const std::vector<CurveComparison>& comparisons) {
  std::vector<std::string> bodies;
  for (const CurveComparison& comparison : comparisons) {
    if (std::find(bodies.begin(), bodies.end(), comparison.body) == bodies.end()) bodies.push_back(comparison.body);
  }
  return bodies;
}

std::optional<ErrorPlace> worst_error(const std::vector<CurveComparison>& comparisons) {
  auto place = largest_error(
      comparisons, [](const ObservableError& error) { return is_aimed_at(error.kind) && error.validity == Validity::inside; });
  if (!place) place = largest_error(comparisons, [](const ObservableError& error) { return is_aimed_at(error.kind); });
  if (!place) place = largest_error(comparisons, [](const ObservableError&) { return true; });
  return place;
}

FurthestDisplacement furthest_displacement(const std::vector<CurveComparison>& comparisons, const ErrorPlace& place) {
  const CurveComparison& comparison = comparisons[place.comparison];
  const ObservableError& error = comparison.errors[place.error];
  assert(error.kind == ObservableKind::displacement);
  return {.body = comparison.body,
          .observable = error.observable,
          .pressure_Pa = error.pressure_Pa,
          .difference_m = difference_of(error),
          .share = difference_of(error) / length_of(comparison),
          .error = std::abs(error.error)};
}

std::optional<ErrorPlace> furthest_off(const std::vector<CurveComparison>& comparisons) {
  for (const ErrorSummary& summary : summarise(comparisons)) {  // inside first
    if (summary.furthest) return summary.furthest;
  }
  return worst_error(comparisons);
}

std::vector<SignCount> count_signs(const std::vector<CurveComparison>& comparisons) {
  std::vector<SignCount> counts;
  for (const CurveComparison& comparison : comparisons) {
    for (const ObservableError& error : comparison.errors) {
      if (error.kind != ObservableKind::displacement || std::abs(error.reference) < meshes::smallest_signed_m) continue;
      const bool inside = error.validity == Validity::inside;
      auto at = std::ranges::find_if(counts, [&](const SignCount& count) {
        return count.body == comparison.body && count.observable == error.observable && count.inside == inside;
      });
      if (at == counts.end()) at = counts.insert(at, {.body = comparison.body, .observable = error.observable, .inside = inside});
      ++at->count;
      at->wrong += error.surrogate * error.reference > 0.0 ? 0 : 1;
    }
  }
  return counts;
}

std::vector<AimOutcome> assess(const std::vector<CurveComparison>& comparisons, double aim) {
  std::vector<AimOutcome> outcomes;
  for (const ObservableKind kind : {ObservableKind::displacement, ObservableKind::volume}) {
    AimOutcome outcome{.kind = kind};
    const std::vector<ErrorSummary> all = summarise(comparisons);
    for (const ErrorSummary& summary : all) {
      if (summary.kind == kind && !summary.inside) outcome.undetermined_outside = summary.without_equilibrium;
    }
    if (const ErrorSummary* summary = find_summary(all, kind)) {
      outcome.count = summary->count;
      outcome.undetermined_inside = summary->without_equilibrium;
      outcome.median = summary->median;
      outcome.met = summary->median.has_value() && *summary->median <= aim;
    }
    std::vector<std::pair<double, std::string>> beyond;
    for (const std::string& body : bodies_of(comparisons)) {
      const std::vector<ErrorSummary> of_body = summarise(comparisons, body);
      const ErrorSummary* summary = find_summary(of_body, kind);
      if (summary == nullptr) continue;
      const double median = summary->median.value_or(std::numeric_limits<double>::max());
      if (median > aim) beyond.emplace_back(-median, body);
    }
    std::stable_sort(beyond.begin(), beyond.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [median, body] : beyond) outcome.bodies_beyond.push_back(body);
    outcomes.push_back(outcome);
  }
  return outcomes;
}

}  // namespace menger::voxel
