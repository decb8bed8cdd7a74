#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fem/inflation/field_output.h"
#include "fem/inflation/modes_run.h"
#include "fem/space/space.h"
#include "io/picture/picture.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// Returns the table modes.csv, with one row per mode of each state of the path. Columns: path_parameter, <plenum>_pressure_Pa
/// per plenum, rigid_modes (how many were left out), mode (from 1), frequency_Hz. A state without modes has one row with the last
/// two empty.
io::CsvTable modes_table(const ModesResult& result);

/// Returns a table with one row per frequency: frequency_Hz, and the real and imaginary part of every observable's amplitude per
/// Pa. Both parts are empty at an undamped resonance.
io::CsvTable frequency_response_table(const ModesResult& result);

/// Returns the text of result.toml: status, reason, counts, notes. Wall times are not included.
std::string modes_result_text(const ModesResult& result);

/// Plots the magnitudes of the amplitudes over frequency, with the natural frequencies marked: of the chambers' volume, and of
/// the displacements.
io::PictureOutcome draw_frequency_response(const std::filesystem::path& file, const ModesResult& result);

/// Writes `mode_01.vtu`, ... into a folder: the elements with the fields of the state (see FieldSeries), the point data "mode",
/// which is the shape of the mode scaled to a largest displacement of 1, and the field data frequency_Hz.
void write_mode_shapes(const std::filesystem::path& folder, const Space& space, std::span<const double> displacements,
                       const NodalFields& fields, const FieldStep& step, const VibrationReport& vibrations);

/// Removes the mode shapes that an earlier run left in a folder, and no other file.
void remove_mode_shapes(const std::filesystem::path& folder);

}  // namespace menger::fem
