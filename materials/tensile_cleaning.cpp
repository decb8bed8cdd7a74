#include "materials/tensile_cleaning.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "io/number_text.h"

namespace menger::materials {

namespace {

constexpr double negligible_fall = 1e-3;  // of the highest stress
constexpr double negligible_zero = 5e-3;  // of the stress at the end of zero_range
constexpr double zero_range = 0.5;        // strain up to which the zero of the load is looked for
constexpr std::size_t fewest_for_zero = 6;

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
  notes.push_back("time is corrupt after " + seconds(last_good) + ": counted anew at " + seconds(step) + " a row");
}

void cut_tail(TensileTest& test, std::vector<std::string>& notes) {
  const auto highest = std::max_element(test.stress_Pa.begin(), test.stress_Pa.end());
  const auto count = static_cast<std::size_t>(highest - test.stress_Pa.begin()) + 1;
  const std::size_t tail = test.strain.size() - count;
  if (tail == 0) return;
  keep_rows(test, count);
  notes.push_back("failure tail: " + std::to_string(tail) + " rows after the highest stress, at a strain of " +
                  percent(test.strain.back()) + ", are left out");
}

void cut_drop_outs(TensileTest& test, std::vector<std::string>& notes) {
  if (test.stress_Pa.size() < 4) return;
  const std::vector<double> steps = differences(test.stress_Pa);
  std::vector<double> bends = differences(steps);
  for (double& bend : bends) bend = std::abs(bend);
  const double threshold_Pa = std::max(negligible_fall * test.stress_Pa.back(), 5.0 * median(bends));
  const auto drop = std::find_if(steps.begin(), steps.end(), [&](double step) { return step < -threshold_Pa; });
  if (drop == steps.end()) return;
  const auto count = static_cast<std::size_t>(drop - steps.begin()) + 1;
  const std::size_t lost = test.strain.size() - count;
  keep_rows(test, count);
  notes.push_back("drop-out: the stress falls by " + kilopascals(-*drop) + " at a strain of " + percent(test.strain.back()) +
                  ": " + std::to_string(lost) + " rows from there on are left out");
}

void correct_zero(TensileTest& test, std::vector<std::string>& notes) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < test.strain.size(); ++i)
    if (test.strain[i] <= zero_range) rows.push_back(i);
  if (rows.size() < fewest_for_zero) return;
  Eigen::MatrixX3d columns(rows.size(), 3);
  Eigen::VectorXd stress(rows.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const double stretch = 1.0 + test.strain[rows[n]];
    const double neo_hookean = stretch - 1.0 / (stretch * stretch);
    columns.row(static_cast<Eigen::Index>(n)) << 1.0, neo_hookean, neo_hookean / stretch;
    stress[static_cast<Eigen::Index>(n)] = test.stress_Pa[rows[n]];
  }
  const double offset_Pa = columns.colPivHouseholderQr().solve(stress)[0];
  if (std::abs(offset_Pa) <= negligible_zero * std::abs(test.stress_Pa[rows.back()])) return;
  for (double& value : test.stress_Pa) value -= offset_Pa;
  notes.push_back("zero of the load: " + kilopascals(offset_Pa) + " at no strain, taken off");
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
  return "strain of the crosshead divided by " + io::number_text(factor) + " for the shoulders of the specimen, an estimate";
}

}  // namespace menger::materials
