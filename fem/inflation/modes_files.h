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

/// One row per state and mode: s, <plenum>_pressure_Pa per plenum, rigid_modes, mode (from 1), frequency_Hz; a state without
/// modes has one row with the last two empty.
io::CsvTable modes_table(const ModesResult& result);

/// One row per frequency: frequency_Hz and the real and imaginary part of every observable's amplitude per Pa; both are empty at
/// an undamped resonance.
io::CsvTable frequency_response_table(const ModesResult& result);

/// The text of result.toml: status, reason, counts, notes. Wall times are left out of it.
std::string modes_result_text(const ModesResult& result);

/// Draws sizes of the amplitudes over frequency, natural frequencies marked: the chambers' volume, and the displacements.
io::PictureOutcome draw_frequency_response(const std::filesystem::path& file, const ModesResult& result);

/// Writes `mode_01.vtu`, ... into a folder: the elements with the fields of the state (see FieldSeries) and the point data
/// "mode", the shape of a mode scaled so that its largest displacement is 1; and the field data frequency_Hz.
void write_mode_shapes(const std::filesystem::path& folder, const Space& space, std::span<const double> displacements,
                       const NodalFields& fields, const FieldStep& step, const VibrationReport& vibrations);

/// Removes the shapes that an earlier run left in a folder, and no other file.
void remove_mode_shapes(const std::filesystem::path& folder);

}  // namespace menger::fem
