#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace menger::fem {

/// The same gauge pressure at all times.
struct ConstantPressure {
  double pressure_Pa = 0.0;
};

/// A cosine with its lowest value at phase 0: p = low + (high - low) (1 - cos(2 pi (f t + phase))) / 2.
struct SinePressure {
  double low_Pa = 0.0;
  double high_Pa = 0.0;
  double frequency_Hz = 1.0;  ///< > 0
  double phase = 0.0;         ///< fraction of a period
};

/// A square wave with straight flanks. It rises from low to high at phase 0, stays there, falls in the same way, and stays low
/// for the rest of the period.
struct SquarePressure {
  double low_Pa = 0.0;
  double high_Pa = 0.0;
  double frequency_Hz = 1.0;  ///< > 0
  double phase = 0.0;         ///< fraction of a period
  double duty = 0.5;          ///< fraction of a period from the start of the rise to the start of the fall, in (0, 1)
  double rise_s = 0.0;        ///< duration of rise and of fall; at most duty and 1 - duty of a period
};

/// Straight lines between given points. Before the first and after the last point the pressure is constant.
struct PressureTable {
  std::vector<double> times_s;  ///< strictly increasing, at least one
  std::vector<double> pressures_Pa;
};

/// The gauge pressure of a plenum as a function of time.
using PressureSchedule = std::variant<ConstantPressure, SinePressure, SquarePressure, PressureTable>;

/// A schedule that is faded in: its pressure is multiplied by t / ramp up to the time `ramp`.
struct PlenumSchedule {
  PressureSchedule schedule;
  double ramp_s = 0.0;  ///< >= 0
};

/// Returns the gauge pressure at a time, Pa.
double pressure_Pa(const PlenumSchedule& plenum, double time_s);

/// Returns the first time after another one at which the pressure or its slope jumps, s; nothing if there is none.
std::optional<double> next_corner_s(const PlenumSchedule& plenum, double after_s);

/// Returns the lowest gauge pressure at any time, Pa; with a ramp it is at most 0.
double lowest_pressure_Pa(const PlenumSchedule& plenum);

/// Checks that a time step resolves all schedules.
/// @throws io::InputError naming the plenum if a schedule has fewer than 20 steps in a period, or fewer than 2 in a rise, in a
/// ramp or between two points of a table
void check_resolved(std::span<const PlenumSchedule> schedules, std::span<const std::string> plenum_names, double step_s);

}  // namespace menger::fem
