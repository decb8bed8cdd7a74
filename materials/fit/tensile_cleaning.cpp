#include "materials/fit/tensile_cleaning.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
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
constexpr double start_end = 0.1;         // strain up to which grips may still settle
constexpr double late_range = 1.0;        // strain up to which the rows behind the start are used
constexpr double same_misfit = 2.0;       // times the misfit over zero_range: the law still holds up to late_range
constexpr double likely = 2.0;            // standard errors by which two estimates may differ

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

void drop_first_rows(TensileTest& test, std::size_t count) {
  const auto end = static_cast<std::ptrdiff_t>(count);
  if (!test.time_s.empty()) test.time_s.erase(test.time_s.begin(), test.time_s.begin() + end);
  test.strain.erase(test.strain.begin(), test.strain.begin() + end);
  test.stress_Pa.erase(test.stress_Pa.begin(), test.stress_Pa.begin() + end);
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

/// Returns the median of the steps around a step, itself included: the usual rise there.
double median_around(const std::vector<double>& steps, std::size_t at) {
  constexpr std::size_t reach = 5;
  const std::size_t begin = at < reach ? 0 : at - reach;
  const std::size_t end = std::min(at + reach + 1, steps.size());
  return median({steps.begin() + static_cast<std::ptrdiff_t>(begin), steps.begin() + static_cast<std::ptrdiff_t>(end)});
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
    // What is missing is the fall and the rise that the neighbours show there.
    const double lost_Pa = median_around(steps, i) - steps[i];
    const bool falls = steps[i] < -negligible_Pa && lost_Pa > std::max(negligible_Pa, 5.0 * noise_Pa);
    if (!falls && std::abs(jump_at(steps, i)) <= std::max(negligible_Pa, 20.0 * noise_Pa)) continue;
    const std::size_t up_to_here = i + 1;
    const std::string fault = std::string("the stress ") + (steps[i] < 0.0 ? "falls" : "jumps") + " by " +
                              kilopascals(std::abs(steps[i])) + " at a strain of " + percent(test.strain[i]);
    // While the grips settle the load falls and jumps although the specimen is whole.
    if (std::abs(test.strain[i]) <= start_end && 4 * up_to_here <= test.strain.size()) {
      drop_first_rows(test, up_to_here);
      notes.push_back("first rows: " + fault + ": " + std::to_string(up_to_here) + " rows up to there are left out");
      return cut_drop_outs(test, notes);
    }
    notes.push_back("drop-out: " + fault + ": " + std::to_string(test.strain.size() - up_to_here) +
                    " rows from there on are left out");
    keep_rows(test, up_to_here);
    return;
  }
}

/// A constant offset of the load.
struct Zero {
  double offset_Pa;
  double error_Pa;   ///< standard error
  double misfit_Pa;  ///< standard deviation of the rows from the law
};

/// Estimates the offset from the rows between two strains (in absolute value); nothing if there are too few rows.
/// @param width 4: constant, Mooney-Rivlin and the second term of Yeoh; 5: also the third
std::optional<Zero> zero_of_load(const TensileTest& test, double from, double to, Eigen::Index width) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < test.strain.size(); ++i) {
    if (const double strain = std::abs(test.strain[i]); strain >= from && strain <= to * (1.0 + 1e-9)) rows.push_back(i);
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count <= width) return std::nullopt;
  Eigen::MatrixXd columns(count, width);
  Eigen::VectorXd stress(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    const std::size_t row = rows[static_cast<std::size_t>(n)];
    const double stretch = 1.0 + test.strain[row];
    const double neo_hookean = stretch - 1.0 / (stretch * stretch);
    const double excess = stretch * stretch + 2.0 / stretch - 3.0;
    const std::array all{1.0, neo_hookean, neo_hookean / stretch, neo_hookean * excess, neo_hookean * excess * excess};
    for (Eigen::Index c = 0; c < width; ++c) columns(n, c) = all.at(static_cast<std::size_t>(c));
    stress[n] = test.stress_Pa[row];
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (qr.rank() < width) return std::nullopt;
  const Eigen::VectorXd found = qr.solve(stress);
  const double square = (columns * found - stress).squaredNorm() / static_cast<double>(count - width);
  const Eigen::MatrixXd inverse =
      qr.matrixR().topLeftCorner(width, width).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(width, width));
  const Eigen::VectorXd deviations = qr.colsPermutation() * inverse.rowwise().norm();
  return Zero{found[0], std::sqrt(square) * deviations[0], std::sqrt(square)};
}

/// Whether two estimates differ by more than their errors and by more than a fifth.
bool differ(const Zero& a, const Zero& b) {
  const double apart_Pa = std::abs(a.offset_Pa - b.offset_Pa);
  return apart_Pa > likely * std::hypot(a.error_Pa, b.error_Pa) && apart_Pa > agreement * std::abs(a.offset_Pa);
}

/// Returns the estimate without the first rows, if the rows go far enough for it and a law still holds there.
std::optional<Zero> zero_behind_the_start(const TensileTest& test, const Zero& whole) {
  if (test.strain.empty() || std::abs(test.strain.back()) < late_range) return std::nullopt;
  const std::optional<Zero> late = zero_of_load(test, start_end, late_range, 5);
  return late && late->misfit_Pa <= same_misfit * whole.misfit_Pa ? late : std::nullopt;
}

/// Says what follows if the first rows alone make the estimate: the zero behind them is subtracted if it is certain, has the same
/// sign and is smaller, for such rows exaggerate it.
void correct_zero_behind_the_start(TensileTest& test, std::vector<std::string>& notes, const std::string& subject,
                                   const Zero& whole, const Zero& late, double negligible_Pa) {
  const bool is_certain = std::abs(late.offset_Pa) > std::max(certain * late.error_Pa, negligible_Pa);
  const bool is_part = late.offset_Pa * whole.offset_Pa > 0.0 && std::abs(late.offset_Pa) < std::abs(whole.offset_Pa);
  const std::string both = kilopascals(whole.offset_Pa) + " with the first rows and " + kilopascals(late.offset_Pa) +
                           " from the rows with strains of " + percent(start_end) + " to " + percent(late_range);
  if (!is_certain || !is_part) {
    notes.push_back(subject + both + ", so nothing is subtracted");
    return;
  }
  for (double& value : test.stress_Pa) value -= late.offset_Pa;
  notes.push_back(subject + both + ": the start is bent, and " + kilopascals(late.offset_Pa) + " is subtracted");
}

void correct_zero(TensileTest& test, std::vector<std::string>& notes) {
  const std::string subject = "zero of the load: ";
  const auto closest =
      std::min_element(test.strain.begin(), test.strain.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const std::optional<Zero> whole = zero_of_load(test, 0.0, zero_range, 4);
  const std::optional<Zero> half = zero_of_load(test, 0.0, 0.5 * zero_range, 4);
  if (std::abs(*closest) > latest_start || !whole || !half) {
    notes.push_back(subject + "not determined, because too few rows have strains up to " + percent(0.5 * zero_range));
    return;
  }
  double end_Pa = 0.0;
  for (std::size_t i = 0; i < test.strain.size(); ++i)
    if (std::abs(test.strain[i]) <= zero_range) end_Pa = std::max(end_Pa, std::abs(test.stress_Pa[i]));
  const double negligible_Pa = negligible_zero * end_Pa;
  if (std::abs(whole->offset_Pa) <= std::max(certain * whole->error_Pa, negligible_Pa)) return;
  if (const std::optional<Zero> late = zero_behind_the_start(test, *whole); late && differ(*whole, *late))
    return correct_zero_behind_the_start(test, notes, subject, *whole, *late, negligible_Pa);
  if (std::abs(half->offset_Pa - whole->offset_Pa) > agreement * std::abs(whole->offset_Pa)) {
    notes.push_back(subject + kilopascals(whole->offset_Pa) + " from the rows up to a strain of " + percent(zero_range) +
                    " but " + kilopascals(half->offset_Pa) + " from those up to " + percent(0.5 * zero_range) +
                    ", so nothing is subtracted");
    return;
  }
  for (double& value : test.stress_Pa) value -= whole->offset_Pa;
  notes.push_back(subject + kilopascals(whole->offset_Pa) + " at zero strain, subtracted");
}

/// Leaves out the first rows in which a pulled specimen seems to push, or a pressed one to pull.
void cut_wrong_signs(TensileTest& test, std::vector<std::string>& notes) {
  std::size_t wrong = 0;
  while (wrong < test.strain.size() && test.strain[wrong] * test.stress_Pa[wrong] < 0.0) ++wrong;
  // With the wrong sign nearly everywhere it is no fault of the first rows, and what is left would say nothing.
  if (wrong == 0 || 4 * wrong > test.strain.size()) return;
  notes.push_back("first rows: the stress has the wrong sign up to a strain of " + percent(test.strain[wrong - 1]) + " (" +
                  kilopascals(test.stress_Pa[wrong - 1]) + "): " + std::to_string(wrong) + " rows are left out");
  drop_first_rows(test, wrong);
}

}  // namespace

std::vector<std::string> clean(TensileTest& test) {
  std::vector<std::string> notes;
  repair_clock(test, notes);
  cut_tail(test, notes);
  cut_drop_outs(test, notes);
  correct_zero(test, notes);
  cut_wrong_signs(test, notes);
  return notes;
}

std::string correct_crosshead_strain(TensileTest& test, double factor) {
  for (double& strain : test.strain) strain /= factor;
  return "strain of the crosshead divided by " + io::number_text(factor) +
         " to correct for the shoulders of the specimen, an estimate";
}

}  // namespace menger::materials
