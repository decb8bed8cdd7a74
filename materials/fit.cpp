#include "materials/fit.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "io/input_error.h"
#include "io/number_text.h"
#include "materials/law_family.h"
#include "materials/law_parameters.h"
#include "materials/separable_fit.h"
#include "materials/stability.h"

namespace menger::materials {

namespace {

constexpr std::size_t fewest_rows = 8;  // six parameters of Ogden's three terms and two to judge them by
constexpr double search_stretch = 10.0;
constexpr double smallest_stretch = 0.3;
constexpr double strain_margin = 1.25;
constexpr double ratio_stretch = 1.5;
constexpr double lowest_ratio = 1.1;
constexpr double highest_ratio = 1.7;

struct Rows {
  std::vector<double> stretch;
  std::vector<double> stress_Pa;
};

Rows rows_in(const TensileTest& test, const StrainRange& range) {
  Rows rows;
  for (std::size_t i = 0; i < test.strain.size(); ++i) {
    if (test.strain[i] < range.lowest || test.strain[i] > range.highest) continue;
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

double uniaxial_Pa(const HyperelasticLaw& law, double stretch) {
  return nominal_stress(law, LoadingMode::uniaxial, stretch).stress_Pa;
}

void judge_residuals(LawFit& fit, const Rows& rows) {
  const auto n = static_cast<double>(rows.stretch.size());
  const double mean = std::accumulate(rows.stress_Pa.begin(), rows.stress_Pa.end(), 0.0) / n;
  double square = 0.0;
  double variation = 0.0;
  for (std::size_t i = 0; i < rows.stretch.size(); ++i) {
    square += std::pow(uniaxial_Pa(fit.law, rows.stretch[i]) - rows.stress_Pa[i], 2);
    variation += std::pow(rows.stress_Pa[i] - mean, 2);
  }
  // Residuals below rounding error, as of a curve made by a law, would let the logarithm run away.
  const double least_square = n * std::pow(1e-12 * std::sqrt(variation / n), 2) + std::numeric_limits<double>::min();
  fit.rmse_Pa = std::sqrt(square / n);
  fit.r_squared = variation > 0.0 ? 1.0 - square / variation : 0.0;
  const auto parameters = static_cast<double>(parameters_of(fit.law).size());
  fit.aic = n * std::log(std::max(square, least_square) / n * 1e-12) + 2.0 * parameters;
}

/// Quantile 0.975 of Student's t by its expansion about the normal one, to 0.1 % for five degrees of freedom and more; below that
/// too small by up to one half.
double student_quantile(double freedom) {
  const double z = 1.959963984540054;
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  return z + (z3 + z) / (4.0 * freedom) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom);
}

void set_confidence(LawFit& fit, const Rows& rows) {
  const auto parameters = parameters_of(fit.law);
  const std::size_t k = parameters.size();
  std::vector<double> values;
  values.reserve(k);
  for (const auto& [name, value] : parameters) values.push_back(value);
  Eigen::MatrixXd jacobian(rows.stretch.size(), k);  // of stress by the logarithm of a parameter
  for (std::size_t p = 0; p < k; ++p) {
    if (values[p] == 0.0) return;  // held there by the bound
    const double step = 1e-5;
    std::vector<double> above = values;
    std::vector<double> below = values;
    above[p] *= 1.0 + step;
    below[p] *= 1.0 - step;
    const HyperelasticLaw upper = with_parameters(fit.law, above);
    const HyperelasticLaw lower = with_parameters(fit.law, below);
    for (std::size_t i = 0; i < rows.stretch.size(); ++i) {
      jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p)) =
          (uniaxial_Pa(upper, rows.stretch[i]) - uniaxial_Pa(lower, rows.stretch[i])) / (2.0 * step);
    }
  }
  if (!jacobian.allFinite()) return;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian.rows(), jacobian.cols());
  qr.setThreshold(1e-7);  // differences know the columns no better
  qr.compute(jacobian);
  const auto width = static_cast<Eigen::Index>(k);
  if (qr.rank() < width) return;
  const Eigen::MatrixXd inverse =
      qr.matrixR().topLeftCorner(width, width).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(width, width));
  const Eigen::VectorXd deviations = qr.colsPermutation() * inverse.rowwise().norm();
  const auto n = static_cast<double>(rows.stretch.size());
  const double freedom = n - static_cast<double>(k);
  const double spread_Pa = fit.rmse_Pa * std::sqrt(n / freedom);
  for (std::size_t p = 0; p < k; ++p) {
    const double relative = student_quantile(freedom) * spread_Pa * deviations[static_cast<Eigen::Index>(p)];
    const double half = std::abs(values[p]) * relative;
    fit.confidence_95.emplace_back(values[p] - half, values[p] + half);
  }
}

bool has_cancelling_terms(const HyperelasticLaw& law) {
  bool adds = false;
  bool takes = false;
  const auto note = [&](const OgdenTerm& term) {
    adds = adds || term.part_of_shear_modulus_Pa() > 0.0;
    takes = takes || term.part_of_shear_modulus_Pa() < 0.0;
  };
  if (const auto* two = std::get_if<Ogden<2>>(&law)) std::for_each(two->terms.begin(), two->terms.end(), note);
  if (const auto* three = std::get_if<Ogden<3>>(&law)) std::for_each(three->terms.begin(), three->terms.end(), note);
  return adds && takes;
}

constexpr std::array modes{LoadingMode::uniaxial, LoadingMode::equibiaxial, LoadingMode::planar};

bool is_stable_in_tension(const HyperelasticLaw& law, double largest_stretch) {
  return std::none_of(modes.begin(), modes.end(),
                      [&](LoadingMode mode) { return first_unstable_stretch(law, mode, std::max(1.0, largest_stretch)); });
}

/// In any mode, the one nearest to 1.
std::optional<double> first_unstable_compression(const HyperelasticLaw& law) {
  std::optional<double> first;
  for (const LoadingMode mode : modes) {
    const std::optional<double> stretch = first_unstable_stretch(law, mode, smallest_stretch);
    if (stretch && (!first || *stretch > *first)) first = stretch;
  }
  return first;
}

void judge_law(LawFit& fit, double largest_stretch) {
  fit.unstable_uniaxial = first_unstable_stretch(fit.law, LoadingMode::uniaxial, search_stretch);
  fit.unstable_equibiaxial = first_unstable_stretch(fit.law, LoadingMode::equibiaxial, search_stretch);
  fit.unstable_planar = first_unstable_stretch(fit.law, LoadingMode::planar, search_stretch);
  fit.unstable_compression = first_unstable_compression(fit.law);
  fit.stable = !fit.unstable_compression && is_stable_in_tension(fit.law, largest_stretch);
  fit.stable_with_margin = fit.stable && is_stable_in_tension(fit.law, 1.0 + strain_margin * (largest_stretch - 1.0));
  fit.cancelling = has_cancelling_terms(fit.law);
  fit.equibiaxial_ratio = equibiaxial_ratio(fit.law, ratio_stretch);
  fit.plausible = fit.equibiaxial_ratio && *fit.equibiaxial_ratio >= lowest_ratio && *fit.equibiaxial_ratio <= highest_ratio;
}

bool is_usable(const LawFit& fit) { return fit.stable_with_margin && fit.plausible && !fit.cancelling; }

/// Smaller is better.
std::array<double, 3> rank_of(const LawFit& fit) {
  const double group = !fit.stable ? 2.0 : is_usable(fit) ? 0.0 : 1.0;
  return {group, fit.status == io::RunStatus::completed ? 0.0 : 1.0, fit.aic};
}

}  // namespace

std::vector<LawFit> fit_laws(const TensileTest& test, const StrainRange& range) {
  const Rows rows = rows_in(test, range);
  const auto [smallest, largest] = std::minmax_element(rows.stretch.begin(), rows.stretch.end());
  const auto excess = [](double l) { return l * l + 2.0 / l - 3.0; };
  std::vector<LawFit> fits;
  for (const LawFamily& family : law_families(std::max(excess(*smallest), excess(*largest)))) {
    const std::optional<SeparableFit> found = fit_family(family, rows.stretch, rows.stress_Pa);
    if (!found) continue;
    LawFit fit;
    fit.name = family.name;
    fit.law = found->law;
    fit.status = found->status;
    judge_residuals(fit, rows);
    set_confidence(fit, rows);
    judge_law(fit, *largest);
    fits.push_back(std::move(fit));
  }
  std::stable_sort(fits.begin(), fits.end(), [](const LawFit& a, const LawFit& b) { return rank_of(a) < rank_of(b); });
  return fits;
}

const LawFit* recommended_fit(const std::vector<LawFit>& ranking) {
  return !ranking.empty() && is_usable(ranking.front()) ? ranking.data() : nullptr;
}

}  // namespace menger::materials
