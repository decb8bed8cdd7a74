#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/text/toml_document.h"

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

/// Reads the columns time_s and pressure_Pa of a CSV file. @throws io::InputError with file, line and value, also for times that
/// run backwards or stand still
PressureTable read_pressure_table(const std::filesystem::path& file);

/// Reads the schedule of one table: the keys below but for the plenum's name. @throws io::InputError for values outside the
/// ranges
PlenumSchedule read_plenum_schedule(const io::TomlTable& table);

/// Place of the plenum that a table names. @throws io::InputError listing the plena if there is none of that name
std::size_t named_plenum(const io::TomlTable& table, std::span<const std::string> plenum_names);

/// Reads one table per plenum: `plenum = "..."`, `schedule = "constant" | "sine" | "square" | "table"`, the members above as keys
/// (`file` for a table) and `ramp_s`. Plena that no table names stay at 0 Pa.
/// @param plenum_names of the mesh @return one schedule per plenum
/// @throws io::InputError for a plenum that is unknown or named twice, and for values outside the ranges above
std::vector<PlenumSchedule> read_plenum_schedules(std::span<const io::TomlTable> tables,
                                                  std::span<const std::string> plenum_names);

/// @throws io::InputError naming the plenum if a schedule has fewer than 20 steps in a period, or 2 in a rise, in a ramp or
/// between two points of a table
void check_resolved(std::span<const PlenumSchedule> schedules, std::span<const std::string> plenum_names, double step_s);

}  // namespace menger::fem
