#include "materials/fit/tensile_cleaning.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "io/text/number_text.h"

namespace menger::materials {

namespace {

constexpr double negligible_fall = 1e-3;  // of the highest stress
constexpr double negligible_zero = 5e-3;  // of the stress at the end of zero_range
constexpr double zero_range = 0.3;        // strain up to which the zero of the load is determined
constexpr double latest_start = 0.1;      // strain above which the curve does not show its zero
constexpr double certain = 5.0;           // standard errors
constexpr double agreement = 0.2;         // of estimates over the range and over half of it

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> result;
  for (std::size_t i = 1; i < values.size(); ++i) result.push_back(values[i] - values[i - 1]);
  return result;
}

std::string seconds(double time_s) { return io::number_text(std::round(time_s * 1e6) / 1e6) + " s"; }

std::string kilopascals(double stress_Pa) { return io::number_text(std::round(stress_Pa / 10.0) / 100.0) + " kPa"; }

std::string percent(double strain) { return io::number_text(std::round(strain * 1000.0) / 10.0) + " %"; }

void keep_rows(TensileTest& test, std::size_t count) {
  if (!test.time_s.empty()) test.time_s.resize(count);
  test.strain.resize(count);
  test.stress_Pa.resize(count);
}

void repair_clock(TensileTest& test, std::vector<std::string>& notes) {
  if (test.time_s.size() < 3) return;
  const std::vector<double> steps = differences(test.time_s);
  const double step = median(steps);
  const auto wrong =
      std::find_if(steps.begin(), steps.end(), [&](double s) { return std::abs(s - step) > 0.5 * std::abs(step); });
  if (!(step > 0.0) || wrong == steps.end()) return;
  const double last_good = test.time_s[static_cast<std::size_t>(wrong - steps.begin())];
  for (std::size_t i = 1; i < test.time_s.size(); ++i) test.time_s[i] = test.time_s[0] + static_cast<double>(i) * step;
  notes.push_back("time is corrupt after " + seconds(last_good) + ": replaced by steps of " + seconds(step) + " per row");
}

void cut_tail(TensileTest& test, std::vector<std::string>& notes) {
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto largest = std::max_element(test.stress_Pa.begin(), test.stress_Pa.end(), smaller);
  const auto count = static_cast<std::size_t>(largest - test.stress_Pa.begin()) + 1;
  const std::size_t tail = test.strain.size() - count;
  if (tail == 0) return;
  keep_rows(test, count);
  notes.push_back("failure tail: " + std::to_string(tail) + " rows after the largest stress, at a strain of " +
                  percent(test.strain.back()) + ", are left out");
}

/// Returns by how much a step lies above (or, negative, below) all of the three steps before and after it. Returns 0 if it lies
/// among them, as on every smooth curve whose slope rises or falls, and at the ends.
double jump_at(const std::vector<double>& steps, std::size_t at) {
  constexpr std::size_t reach = 3;
  if (at < reach || at + reach >= steps.size()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(at);
  const auto before = std::minmax_element(middle - reach, middle);
  const auto after = std::minmax_element(middle + 1, middle + 1 + reach);
  if (const double above = *middle - std::max(*before.second, *after.second); above > 0.0) return above;
  return std::min(0.0, *middle - std::min(*before.first, *after.first));
}

void cut_drop_outs(TensileTest& test, std::vector<std::string>& notes) {
  if (test.stress_Pa.size() < 4) return;
  std::vector<double> steps = differences(test.stress_Pa);
  const double largest_Pa = test.stress_Pa.back();
  if (largest_Pa < 0.0)
    for (double& step : steps) step = -step;  // compression
  std::vector<double> bends = differences(steps);
  for (double& bend : bends) bend = std::abs(bend);
  const double noise_Pa = median(bends);
  const double negligible_Pa = negligible_fall * std::abs(largest_Pa);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool falls = steps[i] < -std::max(negligible_Pa, 5.0 * noise_Pa);
    if (!falls && std::abs(jump_at(steps, i)) <= std::max(negligible_Pa, 20.0 * noise_Pa)) continue;
    const std::size_t lost = test.strain.size() - (i + 1);
    keep_rows(test, i + 1);
    notes.push_back("drop-out: the stress " + std::string(steps[i] < 0.0 ? "falls" : "jumps") + " by " +
                    kilopascals(std::abs(steps[i])) + " at a strain of " + percent(test.strain.back()) + ": " +
                    std::to_string(lost) + " rows from there on are left out");
    return;
  }
}

/// A constant offset of the load.
struct Zero {
  double offset_Pa;
  double error_Pa;  ///< standard error
};

/// Estimates the offset from the rows up to a strain (in absolute value); nothing if there are too few rows.
std::optional<Zero> zero_of_load(const TensileTest& test, double range) {
  constexpr Eigen::Index width = 4;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < test.strain.size(); ++i)
    if (std::abs(test.strain[i]) <= range * (1.0 + 1e-9)) rows.push_back(i);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count <= width) return std::nullopt;
  Eigen::MatrixXd columns(count, width);
  Eigen::VectorXd stress(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    const std::size_t row = rows[static_cast<std::size_t>(n)];
    const double stretch = 1.0 + test.strain[row];
    const double neo_hookean = stretch - 1.0 / (stretch * stretch);
    const double excess = stretch * stretch + 2.0 / stretch - 3.0;
    columns.row(n) << 1.0, neo_hookean, neo_hookean / stretch, neo_hookean * excess;
    stress[n] = test.stress_Pa[row];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (qr.rank() < width) return std::nullopt;
  const Eigen::VectorXd found = qr.solve(stress);
  const double square = (columns * found - stress).squaredNorm() / static_cast<double>(count - width);
  const Eigen::MatrixXd inverse =
      qr.matrixR().topLeftCorner(width, width).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(width, width));
  const Eigen::VectorXd deviations = qr.colsPermutation() * inverse.rowwise().norm();
  return Zero{found[0], std::sqrt(square) * deviations[0]};
}

void correct_zero(TensileTest& test, std::vector<std::string>& notes) {
  const std::string subject = "zero of the load: ";
  const auto closest =
      std::min_element(test.strain.begin(), test.strain.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const std::optional<Zero> whole = zero_of_load(test, zero_range);
  const std::optional<Zero> half = zero_of_load(test, 0.5 * zero_range);
  if (std::abs(*closest) > latest_start || !whole || !half) {
    notes.push_back(subject + "not determined, because too few rows have strains up to " + percent(0.5 * zero_range));
    return;
  }
  double end_Pa = 0.0;
  for (std::size_t i = 0; i < test.strain.size(); ++i)
    if (std::abs(test.strain[i]) <= zero_range) end_Pa = std::max(end_Pa, std::abs(test.stress_Pa[i]));
  if (std::abs(whole->offset_Pa) <= std::max(certain * whole->error_Pa, negligible_zero * end_Pa)) return;
  if (std::abs(half->offset_Pa - whole->offset_Pa) > agreement * std::abs(whole->offset_Pa)) {
    notes.push_back(subject + kilopascals(whole->offset_Pa) + " from the rows up to a strain of " + percent(zero_range) +
                    " but " + kilopascals(half->offset_Pa) + " from those up to " + percent(0.5 * zero_range) +
                    ", so nothing is subtracted");
    return;
  }
  for (double& value : test.stress_Pa) value -= whole->offset_Pa;
  notes.push_back(subject + kilopascals(whole->offset_Pa) + " at zero strain, subtracted");
}

}  // namespace

std::vector<std::string> clean(TensileTest& test) {
  std::vector<std::string> notes;
  repair_clock(test, notes);
  cut_tail(test, notes);
  cut_drop_outs(test, notes);
  correct_zero(test, notes);
  return notes;
}

std::string correct_crosshead_strain(TensileTest& test, double factor) {
  for (double& strain : test.strain) strain /= factor;
  return "strain of the crosshead divided by " + io::number_text(factor) +
         " to correct for the shoulders of the specimen, an estimate";
}

}  // namespace menger::materials
