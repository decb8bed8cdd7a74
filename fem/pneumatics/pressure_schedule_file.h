#pragma once

#include <filesystem>
#include <optional>

#include "fem/pneumatics/pressure_schedule.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Reads the columns time_s and pressure_Pa of a CSV file. @throws io::InputError with file, line and value, also if times do not
/// increase
PressureTable read_pressure_table(const std::filesystem::path& file);

/// Names the keys of a schedule: its kind, the members of that kind, and ramp_s. The points of a table are given in the study or
/// in a file; texts contain the points themselves.
/// @param file the named file, which a reader reads; nothing if none was named
void describe(io::StudyVisitor& visitor, PlenumSchedule& schedule, std::optional<std::filesystem::path>& file);

}  // namespace menger::fem
