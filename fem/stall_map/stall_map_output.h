#pragma once

#include <filesystem>
#include <vector>

#include "fem/stall_map/stall_map.h"
#include "fem/stall_map/stall_travel.h"
#include "io/picture/picture.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// Returns a table with one row per point: frequency_Hz, resistance_Pa_s_per_m3, stroke_m, swept_volume_m3, status,
/// peak_pressure_Pa, lowest_pressure_Pa, piston_peak_pressure_Pa, smallest_volume_m3, largest_volume_m3, largest_flow_m3_per_s
/// (of free air), diameter_m of the tube and reynolds_number of that flow (both empty for lines without length), periods.
io::CsvTable stall_map_table(const StallMapStudy& study, const StallMap& map);

/// Returns the table of isobars and marks: measure (peak or swing), frequency_Hz, pressure_Pa, label (of a mark),
/// resistance_Pa_s_per_m3, stroke_m and swept_volume_m3 (both empty if no stroke of the map reaches the pressure).
io::CsvTable isobars_table(const StallMapStudy& study, const StallMap& map);

/// Draws two panels per frequency, of peak and of swing: the swept volume that reaches each pressure over the resistance of the
/// line. Marks are dashed. With walks there is a third panel: their speed over the swept volume, one line per resistance.
io::PictureOutcome draw_stall_map(const std::filesystem::path& file, const StallMapStudy& study, const StallMap& map,
                                  const std::vector<StallTravel>& travels = {});

}  // namespace menger::fem
