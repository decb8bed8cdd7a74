#pragma once

#include <string>

#include "fem/inflation_run.h"
#include "io/csv_table.h"

namespace menger::fem {

/// A name as part of a column or key: spaces and other signs become underscores.
std::string column_part(const std::string& name);

/// One row per point of the path: step, s; <plenum>_pressure_Pa and <plenum>_volume_m3 per plenum; <chamber>_volume_m3 per
/// chamber; <point>_displacement_x_m, _y_m, _z_m and <point>_largest_stretch per named point; strain_energy_J, work_J (of the
/// pressures, by trapezoids), dead_load_work_J, smallest_gap_m (empty where none was looked for), ground_force_N,
/// smallest_volume_ratio, negative_pivots, newton_iterations, seconds. Volumes are of the modelled part.
io::CsvTable curves_table(const InflationResult& result);

/// The text of result.toml: status, reason, counts, notes, limit points. `accepted_newton_iterations` are those of the searches
/// that found the points of the path, `rejected_steps` counts the other searches. Wall times are left out of it.
std::string result_text(const InflationResult& result);

}  // namespace menger::fem
