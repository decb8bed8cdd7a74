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

/// A cosine that is lowest at phase 0: p = low + (high - low) (1 - cos(2 pi (f t + phase))) / 2.
struct SinePressure {
  double low_Pa = 0.0;
  double high_Pa = 0.0;
  double frequency_Hz = 1.0;  ///< > 0
  double phase = 0.0;         ///< fraction of a period
};

/// Rises from low to high in a straight line at phase 0, stays there, falls in the same way, and stays low for the rest.
struct SquarePressure {
  double low_Pa = 0.0;
  double high_Pa = 0.0;
  double frequency_Hz = 1.0;  ///< > 0
  double phase = 0.0;         ///< fraction of a period
  double duty = 0.5;          ///< fraction of a period from the start of the rise to the start of the fall, in (0, 1)
  double rise_s = 0.0;        ///< of rise and of fall; at most duty and 1 - duty of a period
};

/// Straight lines between given points; the first and last pressure hold before and after.
struct PressureTable {
  std::vector<double> times_s;  ///< strictly increasing, at least one
  std::vector<double> pressures_Pa;
};

/// Gauge pressure of a plenum as function of time.
using PressureSchedule = std::variant<ConstantPressure, SinePressure, SquarePressure, PressureTable>;

/// A schedule that is faded in: its pressure times t / ramp up to the time ramp.
struct PlenumSchedule {
  PressureSchedule schedule;
  double ramp_s = 0.0;  ///< >= 0
};

/// Gauge pressure at a time, Pa.
double pressure_Pa(const PlenumSchedule& plenum, double time_s);

/// First time after another at which the pressure jumps or its slope does, s; nothing if there is none.
std::optional<double> next_corner_s(const PlenumSchedule& plenum, double after_s);

/// Lowest gauge pressure at any time, Pa; at most 0 where there is a ramp.
double lowest_pressure_Pa(const PlenumSchedule& plenum);

/// @throws io::InputError naming the plenum if a schedule has fewer than 20 steps in a period, or 2 in a rise, in a ramp or
/// between two points of a table
void check_resolved(std::span<const PlenumSchedule> schedules, std::span<const std::string> plenum_names, double step_s);

}  // namespace menger::fem
