#pragma once

#include <filesystem>
#include <optional>

#include "fem/pneumatics/pressure_schedule.h"
#include "io/study/study_visitor.h"

namespace menger::fem {

/// Reads the columns time_s and pressure_Pa of a CSV file. @throws io::InputError with file, line and value, also for times that
/// run backwards or stand still
PressureTable read_pressure_table(const std::filesystem::path& file);

/// The keys of a schedule: its kind, the members of that kind, and ramp_s. The points of a table stand in the study or in a file;
/// texts have the points themselves.
/// @param file that was named, for a reader, which reads it; nothing otherwise
void describe(io::StudyVisitor& visitor, PlenumSchedule& schedule, std::optional<std::filesystem::path>& file);

}  // namespace menger::fem
