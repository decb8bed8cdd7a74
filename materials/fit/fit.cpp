#include "materials/fit/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/number_text.h"
#include "materials/fit/fit_confidence.h"
#include "materials/fit/law_family.h"
#include "materials/fit/separable_fit.h"
#include "materials/laws/law_parameters.h"
#include "materials/laws/stability.h"

namespace menger::materials {

namespace {

constexpr std::size_t fewest_rows = 8;  // six parameters of Ogden's three terms and two rows more, to estimate the error
constexpr double search_stretch = 10.0;
constexpr double smallest_stretch = 0.3;
constexpr double strain_margin = 1.25;
constexpr double ratio_stretch = 1.5;
constexpr double lowest_ratio = 1.1;
constexpr double highest_ratio = 1.7;
constexpr double close_enough = 0.05;       // of the largest stress
constexpr double as_close_as_best = 3.0;    // times the RMSE of the closest stable and plausible fit
constexpr double closer_than_tests = 5e-3;  // of the largest stress: no test resolves less

struct Rows {
  std::vector<double> stretch;
  std::vector<double> stress_Pa;
};

Rows rows_in(const TensileTest& test, const StrainRange& range) {
  Rows rows;
  for (std::size_t i = 0; i < test.strain.size(); ++i) {
    if (!range.holds(test.strain[i])) continue;
    rows.stretch.push_back(1.0 + test.strain[i]);
    rows.stress_Pa.push_back(test.stress_Pa[i]);
  }
  const std::string words = "strain range " + io::number_text(range.lowest) + " to " + io::number_text(range.highest);
  if (rows.stretch.size() < fewest_rows) {
    throw io::InputError(words + ": holds " + std::to_string(rows.stretch.size()) + " rows of the test, at least " +
                         std::to_string(fewest_rows) + " are needed");
  }
  const bool pulls = std::any_of(rows.stretch.begin(), rows.stretch.end(), [](double stretch) { return stretch != 1.0; });
  const bool resists = std::any_of(rows.stress_Pa.begin(), rows.stress_Pa.end(), [](double stress) { return stress != 0.0; });
  if (!pulls || !resists) throw io::InputError(words + ": holds no rows with strain and stress");
  return rows;
}

void assess_residuals(LawFit& fit, const Rows& rows) {
  const auto n = static_cast<double>(rows.stretch.size());
  const double mean = std::accumulate(rows.stress_Pa.begin(), rows.stress_Pa.end(), 0.0) / n;
  double square = 0.0;
  double variation = 0.0;
  for (std::size_t i = 0; i < rows.stretch.size(); ++i) {
    const double stress_Pa = nominal_stress(fit.law, LoadingMode::uniaxial, rows.stretch[i]).stress_Pa;
    square += std::pow(stress_Pa - rows.stress_Pa[i], 2);
    variation += std::pow(rows.stress_Pa[i] - mean, 2);
  }
  // Residuals below rounding error, such as those of a curve computed from a law, would make the logarithm diverge.
  const double least_square = n * std::pow(1e-12 * std::sqrt(variation / n), 2) + std::numeric_limits<double>::min();
  fit.rmse_Pa = std::sqrt(square / n);
  const double largest_Pa = std::abs(*std::max_element(rows.stress_Pa.begin(), rows.stress_Pa.end(),
                                                       [](double a, double b) { return std::abs(a) < std::abs(b); }));
  fit.relative_rmse = fit.rmse_Pa / largest_Pa;
  fit.r_squared = variation > 0.0 ? 1.0 - square / variation : 0.0;
  const auto parameters = static_cast<double>(parameters_of(fit.law).size());
  fit.aic = n * std::log(std::max(square, least_square) / n * 1e-12) + 2.0 * parameters;
}

constexpr std::array modes{LoadingMode::uniaxial, LoadingMode::equibiaxial, LoadingMode::planar};

bool is_stable_in_tension(const HyperelasticLaw& law, double largest_stretch) {
  return std::none_of(modes.begin(), modes.end(),
                      [&](LoadingMode mode) { return first_unstable_stretch(law, mode, std::max(1.0, largest_stretch)); });
}

/// Returns the first unstable stretch in compression in any mode, the one nearest to 1.
std::optional<double> first_unstable_compression(const HyperelasticLaw& law) {
  std::optional<double> first;
  for (const LoadingMode mode : modes) {
    const std::optional<double> stretch = first_unstable_stretch(law, mode, smallest_stretch);
    if (stretch && (!first || *stretch > *first)) first = stretch;
  }
  return first;
}

void assess_law(LawFit& fit, double largest_stretch) {
  fit.unstable_uniaxial = first_unstable_stretch(fit.law, LoadingMode::uniaxial, search_stretch);
  fit.unstable_equibiaxial = first_unstable_stretch(fit.law, LoadingMode::equibiaxial, search_stretch);
  fit.unstable_planar = first_unstable_stretch(fit.law, LoadingMode::planar, search_stretch);
  fit.unstable_compression = first_unstable_compression(fit.law);
  fit.stable = !fit.unstable_compression && is_stable_in_tension(fit.law, largest_stretch);
  fit.stable_with_margin = fit.stable && is_stable_in_tension(fit.law, 1.0 + strain_margin * (largest_stretch - 1.0));
  fit.cancelled = cancelled_part(fit.law);
  fit.cancelling = fit.cancelled > 1.0;
  fit.equibiaxial_ratio = equibiaxial_ratio(fit.law, ratio_stretch);
  fit.plausible = fit.equibiaxial_ratio && *fit.equibiaxial_ratio >= lowest_ratio && *fit.equibiaxial_ratio <= highest_ratio;
}

/// Says which parameters the test does not determine. No parameter may be at a bound of its search range, and no interval may be
/// missing or contain 0. A modulus held at zero is allowed: it only makes the law a simpler one.
std::vector<std::string> undetermined_parts(const LawFit& fit) {
  const auto parameters = parameters_of(fit.law);
  if (fit.confidence_95.size() != parameters.size()) return {"the test does not determine its parameters"};
  std::vector<std::string> parts;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto& [name, value] = parameters[p];
    const auto& interval = fit.confidence_95[p];
    if (!interval && value != 0.0) parts.push_back(name + " is at a bound of its search");
    if (interval && interval->first <= 0.0 && interval->second >= 0.0) parts.push_back("the interval of " + name + " contains 0");
  }
  return parts;
}

bool is_usable(const LawFit& fit) { return shortcomings_of(fit).empty(); }

/// Returns the key by which fits are ranked; smaller is better.
std::array<double, 3> rank_of(const LawFit& fit) {
  const double group = !fit.stable ? 2.0 : is_usable(fit) ? 0.0 : 1.0;
  return {group, fit.status == io::RunStatus::completed ? 0.0 : 1.0, fit.aic};
}

/// Returns the parameters at a bound: shape parameters at an end of their search range, and moduli held at zero.
std::vector<std::string> parameters_at_bound(const LawFamily& family, const SeparableFit& found) {
  std::vector<std::string> names = found.shape_at_bound;
  for (const auto& [name, value] : parameters_of(found.law)) {
    if (family.non_negative && value == 0.0) names.push_back(name);
  }
  return names;
}

/// Whether a term of an Ogden law of several terms has no modulus. Such a law has in effect fewer terms and is fitted anyway.
bool has_empty_term(const HyperelasticLaw& law) {
  const auto empty_in = [](const auto& ogden) {
    return std::any_of(ogden.terms.begin(), ogden.terms.end(), [](const OgdenTerm& term) { return term.modulus_Pa == 0.0; });
  };
  if (const auto* two = std::get_if<Ogden<2>>(&law)) return empty_in(*two);
  if (const auto* three = std::get_if<Ogden<3>>(&law)) return empty_in(*three);
  return false;
}

}  // namespace

FittedRows fitted_rows(const TensileTest& test, const StrainRange& range) {
  FittedRows rows;
  for (const double strain : test.strain) {
    if (!range.holds(strain)) continue;
    rows.lowest_strain = rows.count == 0 ? strain : std::min(rows.lowest_strain, strain);
    rows.highest_strain = rows.count == 0 ? strain : std::max(rows.highest_strain, strain);
    ++rows.count;
  }
  return rows;
}

std::vector<std::string> shortcomings_of(const LawFit& fit) {
  std::vector<std::string> reasons;
  if (fit.status != io::RunStatus::completed) reasons.emplace_back("the solver did not converge");
  if (!fit.stable) reasons.emplace_back("unstable");
  if (fit.stable && !fit.stable_with_margin) reasons.emplace_back("unstable soon beyond the fitted strains");
  if (!fit.plausible) reasons.emplace_back("its equibiaxial stress is not that of a silicone");
  if (fit.cancelled != 0.0) reasons.emplace_back("it has terms of opposite signs");
  if (!(fit.relative_rmse <= close_enough)) {
    reasons.push_back("its RMSE is more than " + io::shown(100.0 * close_enough) + " % of the largest stress");
  }
  for (std::string& part : undetermined_parts(fit)) reasons.push_back(std::move(part));
  return reasons;
}

std::vector<LawFit> fit_laws(const TensileTest& test, const StrainRange& range,
                             const std::function<void(double done, std::string_view law)>& progress) {
  const Rows rows = rows_in(test, range);
  const auto [smallest, largest] = std::minmax_element(rows.stretch.begin(), rows.stretch.end());
  const auto excess = [](double l) { return l * l + 2.0 / l - 3.0; };
  std::vector<LawFit> fits;
  const std::vector<LawFamily> families = law_families(std::max(excess(*smallest), excess(*largest)));
  // The work of a family grows with its starts and with the number of its moduli, on which each solution depends.
  const auto work_of = [](const LawFamily& family) {
    return static_cast<double>(family.starts.size() * (1 + family.shape_names.size()) * (family.non_negative ? 3 : 1));
  };
  double whole = 0.0;
  for (const LawFamily& family : families) whole += work_of(family);
  double done = 0.0;
  for (const LawFamily& family : families) {
    const auto tell = [&](double part) {
      if (progress) progress((done + part * work_of(family)) / whole, family.name);
    };
    const std::optional<SeparableFit> found = fit_family(family, rows.stretch, rows.stress_Pa, tell);
    done += work_of(family);
    if (!found || has_empty_term(found->law)) continue;
    LawFit fit;
    fit.name = family.name;
    fit.law = found->law;
    fit.status = found->status;
    fit.skipped_count = found->skipped_count;
    fit.at_bound = parameters_at_bound(family, *found);
    assess_residuals(fit, rows);
    set_confidence(fit, rows.stretch);
    assess_law(fit, *largest);
    fits.push_back(std::move(fit));
  }
  std::stable_sort(fits.begin(), fits.end(), [](const LawFit& a, const LawFit& b) { return rank_of(a) < rank_of(b); });
  return fits;
}

std::vector<std::string> cancelling_notes(const std::vector<LawFit>& ranking) {
  std::vector<std::string> notes;
  for (const LawFit& fit : ranking) {
    if (fit.skipped_count > 0) {
      notes.push_back(fit.name + ": " + std::to_string(fit.skipped_count) +
                      " closer fits are left out, whose terms cancel more than " + io::number_text(most_cancelled) +
                      " times what they leave, less than any test resolves");
    }
    if (fit.cancelling && fit.stable && fit.plausible) {
      notes.push_back(fit.name + ": its terms cancel " + io::shown(fit.cancelled, 2) +
                      " times what they leave, so it is not counted among the laws that are close to the test");
    }
  }
  return notes;
}

const LawFit* recommended_fit(const std::vector<LawFit>& ranking) {
  if (ranking.empty() || !is_usable(ranking.front())) return nullptr;
  double closest = ranking.front().relative_rmse;
  for (const LawFit& fit : ranking) {
    if (fit.stable && fit.plausible && !fit.cancelling) closest = std::min(closest, fit.relative_rmse);
  }
  const double limit = std::max(closer_than_tests, as_close_as_best * closest);
  return ranking.front().relative_rmse <= limit ? ranking.data() : nullptr;
}

}  // namespace menger::materials
