#include "fem/pneumatics/pressure_schedule.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/input_error.h"
#include "io/text/number_text.h"

namespace menger::fem {
namespace {

double fraction_of_period(double frequency_Hz, double phase, double time_s) {
  const double periods = frequency_Hz * time_s + phase;
  return periods - std::floor(periods);
}

double pressure_at(const ConstantPressure& schedule, double) { return schedule.pressure_Pa; }

double pressure_at(const SinePressure& schedule, double time_s) {
  const double angle = 2.0 * std::numbers::pi * fraction_of_period(schedule.frequency_Hz, schedule.phase, time_s);
  return schedule.low_Pa + 0.5 * (schedule.high_Pa - schedule.low_Pa) * (1.0 - std::cos(angle));
}

double pressure_at(const SquarePressure& schedule, double time_s) {
  const double at = fraction_of_period(schedule.frequency_Hz, schedule.phase, time_s);
  const double rise = schedule.rise_s * schedule.frequency_Hz;
  const bool falls = at >= schedule.duty;
  const double since = falls ? at - schedule.duty : at;
  const double changed = since >= rise ? 1.0 : since / rise;
  return schedule.low_Pa + (schedule.high_Pa - schedule.low_Pa) * (falls ? 1.0 - changed : changed);
}

double pressure_at(const PressureTable& table, double time_s) {
  const auto after = std::upper_bound(table.times_s.begin(), table.times_s.end(), time_s);
  if (after == table.times_s.begin()) return table.pressures_Pa.front();
  if (after == table.times_s.end()) return table.pressures_Pa.back();
  const auto n = static_cast<std::size_t>(after - table.times_s.begin());
  const double part = (time_s - table.times_s[n - 1]) / (table.times_s[n] - table.times_s[n - 1]);
  return std::lerp(table.pressures_Pa[n - 1], table.pressures_Pa[n], part);
}

/// The next corner of a square wave: the start or end of its rise or of its fall.
std::optional<double> corner_after(const SquarePressure& square, double after_s) {
  const double rise = square.rise_s * square.frequency_Hz;
  const double whole = std::floor(square.frequency_Hz * after_s + square.phase);
  std::optional<double> first;
  for (const double period : {whole, whole + 1.0}) {
    for (const double part : {0.0, rise, square.duty, square.duty + rise}) {
      const double corner = (period + part - square.phase) / square.frequency_Hz;
      if (corner > after_s && (!first || corner < *first)) first = corner;
    }
  }
  return first;
}

std::optional<double> corner_after(const PressureTable& table, double after_s) {
  const auto next = std::upper_bound(table.times_s.begin(), table.times_s.end(), after_s);
  return next == table.times_s.end() ? std::nullopt : std::optional(*next);
}

template <class Smooth>
std::optional<double> corner_after(const Smooth&, double) {
  return std::nullopt;
}

/// A part of a schedule that steps must resolve, with the number of steps that it needs.
struct Detail {
  double duration_s;
  double steps;
  std::string_view name;
};

std::vector<Detail> details_of(const PlenumSchedule& plenum) {
  std::vector<Detail> details;
  if (plenum.ramp_s > 0.0) details.push_back({plenum.ramp_s, 2.0, "ramp"});
  if (const auto* sine = std::get_if<SinePressure>(&plenum.schedule))
    details.push_back({1.0 / sine->frequency_Hz, 20.0, "period"});
  if (const auto* square = std::get_if<SquarePressure>(&plenum.schedule)) {
    details.push_back({1.0 / square->frequency_Hz, 20.0, "period"});
    if (square->rise_s > 0.0) details.push_back({square->rise_s, 2.0, "rise"});
  }
  if (const auto* table = std::get_if<PressureTable>(&plenum.schedule)) {
    for (std::size_t row = 1; row < table->times_s.size(); ++row)
      details.push_back({table->times_s[row] - table->times_s[row - 1], 2.0, "line of a table"});
  }
  return details;
}

}  // namespace

double pressure_Pa(const PlenumSchedule& plenum, double time_s) {
  const double pressure = std::visit([&](const auto& schedule) { return pressure_at(schedule, time_s); }, plenum.schedule);
  return time_s < plenum.ramp_s ? pressure * time_s / plenum.ramp_s : pressure;
}

std::optional<double> next_corner_s(const PlenumSchedule& plenum, double after_s) {
  const std::optional<double> corner =
      std::visit([&](const auto& schedule) { return corner_after(schedule, after_s); }, plenum.schedule);
  return plenum.ramp_s > after_s ? std::min(plenum.ramp_s, corner.value_or(plenum.ramp_s)) : corner;
}

double lowest_pressure_Pa(const PlenumSchedule& plenum) {
  struct Lowest {
    double operator()(const ConstantPressure& constant) const { return constant.pressure_Pa; }
    double operator()(const SinePressure& sine) const { return std::min(sine.low_Pa, sine.high_Pa); }
    double operator()(const SquarePressure& square) const { return std::min(square.low_Pa, square.high_Pa); }
    double operator()(const PressureTable& table) const { return *std::ranges::min_element(table.pressures_Pa); }
  };
  const double lowest = std::visit(Lowest{}, plenum.schedule);
  return plenum.ramp_s > 0.0 ? std::min(0.0, lowest) : lowest;
}

void check_resolved(std::span<const PlenumSchedule> schedules, std::span<const std::string> plenum_names, double step_s) {
  for (std::size_t p = 0; p < schedules.size(); ++p) {
    for (const Detail& detail : details_of(schedules[p])) {
      if (detail.duration_s >= detail.steps * step_s) continue;
      throw io::InputError("plenum \"" + plenum_names[p] + "\": a " + std::string(detail.name) + " of " +
                           io::number_text(detail.duration_s) + " s is too short for steps of " + io::number_text(step_s) + " s");
    }
  }
}

}  // namespace menger::fem
