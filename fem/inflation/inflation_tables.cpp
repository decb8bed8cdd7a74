#include "fem/inflation/inflation_tables.h"

#include <cstdint>
#include <optional>

#include "io/text/formatted.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"

namespace menger::fem {
namespace {

std::vector<std::string> columns_of(const InflationResult& result) {
  std::vector<std::string> columns{"step", "path_parameter"};
  for (const std::string& plenum : result.plenum_names) {
    columns.push_back(io::column_part(plenum) + "_pressure_Pa");
    columns.push_back(io::column_part(plenum) + "_volume_m3");
  }
  for (const std::string& chamber : result.chamber_names) columns.push_back(io::column_part(chamber) + "_volume_m3");
  for (const std::string& plate : result.plate_names) {
    for (const char* axis : {"x", "y", "z"}) columns.push_back(io::column_part(plate) + "_force_" + axis + "_N");
    for (const char* axis : {"x", "y", "z"}) columns.push_back(io::column_part(plate) + "_moment_" + axis + "_N_m");
  }
  for (const std::string& point : result.point_names) {
    for (const char* axis : {"x", "y", "z"}) columns.push_back(io::column_part(point) + "_displacement_" + axis + "_m");
    columns.push_back(io::column_part(point) + "_largest_stretch");
  }
  for (const char* axis : {"x", "y", "z"}) columns.push_back(std::string("extent_change_") + axis + "_m");
  for (const char* name : {"strain_energy_J", "work_J", "dead_load_work_J", "smallest_gap_m", "ground_force_N",
                           "smallest_volume_ratio", "negative_pivots", "newton_iterations", "seconds"}) {
    columns.emplace_back(name);
  }
  return columns;
}

}  // namespace

io::CsvTable curves_table(const InflationResult& result) {
  io::CsvTable table(columns_of(result));
  for (std::size_t n = 0; n < result.path.points.size(); ++n) {
    const PathPoint& point = result.path.points[n];
    std::vector<io::CsvCell> row{io::cell(point.step), io::cell(point.s)};
    for (std::size_t p = 0; p < result.plenum_names.size(); ++p) {
      row.push_back(io::cell(point.pressures_Pa[p]));
      row.push_back(io::cell(point.plenum_volumes_m3[p]));
    }
    for (const double volume : point.chamber_volumes_m3) row.push_back(io::cell(volume));
    for (const PlateReaction& plate : point.plates) {
      for (const double component : plate.force_N) row.push_back(io::cell(component));
      for (const double component : plate.moment_N_m) row.push_back(io::cell(component));
    }
    for (const PointObservation& observation : result.observations[n]) {
      for (const double component : observation.displacement_m) row.push_back(io::cell(component));
      row.push_back(io::cell(observation.largest_stretch));
    }
    const std::optional<Point>& extents_m = result.extent_changes_m[n];
    for (std::size_t axis = 0; axis < 3; ++axis) row.push_back(extents_m ? io::cell((*extents_m)[axis]) : io::CsvCell{});
    row.push_back(io::cell(point.strain_energy_J));
    row.push_back(io::cell(point.work_J));
    row.push_back(io::cell(point.dead_load_work_J));
    row.push_back(io::cell(point.smallest_gap_m));
    row.push_back(io::cell(point.ground_force_N));
    row.push_back(io::cell(point.smallest_ratio));
    row.push_back(point.negative_pivots ? io::cell(*point.negative_pivots) : io::CsvCell{});
    row.push_back(io::cell(point.iterations));
    row.push_back(io::cell(point.seconds));
    table.add_cells(row);
  }
  return table;
}

std::string result_text(const InflationResult& result) {
  io::TomlText text;
  text.add("status", io::to_string(result.path.status));
  if (!result.path.reason.empty()) text.add("reason", result.path.reason);
  text.add("elements", result.elements);
  text.add("unknowns", result.unknowns);
  text.add("linear_solver", result.linear_solver);
  text.add("element_size_m", result.element_size_m);
  text.add("points", result.path.points.size());
  std::uint64_t iterations = 0;
  for (const PathPoint& point : result.path.points) iterations += static_cast<std::uint64_t>(point.iterations);
  text.add("accepted_newton_iterations", iterations);
  text.add("rejected_steps", result.path.rejected_steps);
  if (!result.path.points.empty()) text.add("path_parameter", result.path.points.back().s);
  text.line("notes = [");
  for (const std::string& note : result.notes) text.line("  " + io::toml_quoted(note) + ",");
  text.line("]");
  for (const LimitPoint& limit : result.path.limit_points) {
    text.line("")
        .entry("limit_points")
        .add("plenum", result.plenum_names[limit.plenum])
        .add("pressure_Pa", limit.pressure_Pa)
        .add("volume_m3", limit.volume_m3)
        .add("passed", limit.passed);
  }
  return text.text();
}

}  // namespace menger::fem
