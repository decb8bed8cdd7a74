#pragma once

#include <filesystem>
#include <string>

#include "fem/stall_map/stall_map.h"

namespace menger::fem {

/// Reads a study of `menger stall-map`:
///
///     [plenum]                    # what hangs on the piston's line
///     curve = "module_curve.csv"  # columns pressure_Pa (strictly increasing) and volume_m3 (> 0, never decreasing)
///     count = 9                   # equal bodies with this curve (1)
///     [piston]                    # bore_m, dead_volume_m3 (0), fill_pressure_Pa (0), cylinder_length_m (that of the stroke)
///     [line]                      # may be missing: length_m: each resistance is that of a round tube; or volume_m3 (0): laminar
///     [gas]                       # may be missing: exponent (1), ambient_pressure_Pa (standard atmosphere)
///     [map]
///     frequencies_Hz = [1.2, 3]
///     resistances_Pa_s_per_m3 = { lowest = 1e5, highest = 1e9, count = 17 }  # evenly by their logarithms, count >= 2
///     strokes_m = { longest = 0.06, count = 24 }                             # evenly from longest / count
///     isobars_Pa = [2000, 4000]
///     steps_per_period, most_periods, settled                                # see StallMapStudy
///     [travel]                    # may be missing: a robot that walks at some points, see StallWalker
///     design, level (1), parameters, static_friction (1), kinetic_friction (0.5), periods (6), every_resistance (1),
///     every_stroke (1)
///     [[mark]]                    # any number: label, pressure_Pa, frequency_Hz
///
/// @throws io::InputError with file, key and value for what lies outside its range, strokes beyond the cylinder or without room
/// for air, fill pressures outside the curve, and marks at frequencies that are not on the map
StallMapStudy read_stall_map_study(const std::filesystem::path& file);

/// The study with every value spelled out, defaults and the plenum's curve included.
std::string resolved_text(const StallMapStudy& study);

}  // namespace menger::fem
