#pragma once

#include <string>

#include "fem/inflation/inflation_run.h"
#include "io/text/csv_table.h"

namespace menger::fem {

/// Returns the table of curves.csv, with one row per point of the path:
/// - step, s;
/// - <plenum>_pressure_Pa and <plenum>_volume_m3 per plenum;
/// - <chamber>_volume_m3 per chamber;
/// - <plate>_force_x_N, _y_N, _z_N and <plate>_moment_x_N_m, _y_N_m, _z_N_m per plate: the force and the moment of the plate on
///   the body, the moment about the present position of the plate's centre;
/// - <point>_displacement_x_m, _y_m, _z_m and <point>_largest_stretch per named point;
/// - extent_change_x_m, _y_m, _z_m: the growth of the distance between the mean positions of the end faces, which at rest lie in
///   the planes of the bounding box across the axis; for supports.kind "free" after the rotation of the body is removed; empty if
///   one of the planes holds no face;
/// - strain_energy_J, work_J (of the pressures, by trapezoids), dead_load_work_J;
/// - smallest_gap_m (empty where none was searched for), ground_force_N, smallest_volume_ratio, negative_pivots,
///   newton_iterations, seconds.
///
/// Volumes are those of the modelled part.
io::CsvTable curves_table(const InflationResult& result);

/// Returns the text of result.toml: status, reason, counts, notes, limit points. `accepted_newton_iterations` counts the
/// iterations of the searches that found the points of the path; `rejected_steps` counts the other searches. Wall times are not
/// included.
std::string result_text(const InflationResult& result);

}  // namespace menger::fem
