#include "evolution/page/equilibrium_sections.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/result_facts.h"
#include "evolution/page/chamber_names.h"
#include "evolution/page/chart_points.h"
#include "evolution/page/section_parts.h"
#include "evolution/page/shown_table.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/is_file.h"
#include "io/text/toml_document.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

/// A pressure at which the path of an inflation turns.
struct TurningPoint {
  std::string plenum;
  double pressure_Pa = 0.0;
  std::optional<double> volume_m3{};
  bool is_limit = true;  ///< the first of its plenum: beyond it the body has ballooned or buckled already
};

std::vector<TurningPoint> turning_points_in(const io::TomlTable& result) {
  std::vector<TurningPoint> points;
  std::set<std::string> known;
  for (const io::TomlTable& limit : result.optional_tables("limit_points")) {
    TurningPoint point{.plenum = limit.text_or("plenum", "the chamber"), .pressure_Pa = limit.number("pressure_Pa")};
    point.volume_m3 = limit.optional_number("volume_m3");
    point.is_limit = known.insert(point.plenum + (point.pressure_Pa > 0.0 ? "" : " in vacuum")).second;
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace

void add_inflation(const CommandOutput& output, PageSection& section) {
  const io::CsvContents curves = io::read_csv(output.folder / "curves.csv");
  const io::TomlTable result = io::read_toml(output.folder / "result.toml");
  PageChart chart{.title = "Pressure against volume: " + heading_of(output),
                  .x = {.title = "volume of the chamber (cm\u00b3)"},
                  .y = {.title = "gauge pressure (kPa)"},
                  .series = {},
                  .note = "From " + file_of(output, "curves.csv") + "."};
  const std::vector<std::string> pressures = ending_with(curves, "_pressure_Pa");
  const ChamberNames chambers(output);
  for (const std::string& pressure : pressures) {
    const std::string plenum = pressure.substr(0, pressure.size() - std::string_view("_pressure_Pa").size());
    chart.series.push_back({.name = pressures.size() == 1 ? "the chamber" : chambers.name_of(plenum),
                            .x = column_of(curves, plenum + "_volume_m3", 1e6),
                            .y = column_of(curves, pressure, 1e-3),
                            .marks = PageMarks::line_and_points,
                            .material = chambers.material_of(plenum)});
  }
  join_equal_series(chart);
  // Some chambers have nearly the same curve: the one below shows through the gaps.
  for (std::size_t n = 1; n < chart.series.size(); n += 2) chart.series[n].dashed = true;
  const std::vector<TurningPoint> turning_points = turning_points_in(result);
  for (const TurningPoint& point : turning_points) {
    chart.markers.push_back(
        {.vertical = false,
         .at = 1e-3 * point.pressure_Pa,
         .label = (point.is_limit ? "limit pressure " : "later turning point ") + io::kilopascals(point.pressure_Pa)});
  }
  section.charts.push_back(std::move(chart));
  PageTable table{.title = heading_of(output),
                  .columns = {"quantity", "value"},
                  .rows = {},
                  .note = "From " + file_of(output, "result.toml") + "."};
  const auto add = [&](const std::string& name, const std::string& value) { table.rows.push_back({name, value}); };
  add("status", result.text("status"));
  if (result.has("reason")) add("reason", result.text("reason"));
  add("elements", shown_number(result.optional_number("elements")));
  add("unknowns", io::formatted("%.0f", result.optional_number("unknowns").value_or(0.0)));
  add("size of an element (mm)", shown_number(1e3 * result.optional_number("element_size_m").value_or(0.0)));
  if (const auto bend = bend_of(output))
    add("the middle of its far end moves sideways, seen from the near one (mm)", shown_number(1e3 * bend->sideways_m));
  for (const TurningPoint& point : turning_points) {
    const std::string of = pressures.size() == 1 ? "" : " of the " + chambers.name_of(point.plenum);
    add((point.is_limit ? "limit pressure" : "later turning point") + of, io::kilopascals(point.pressure_Pa));
    if (point.volume_m3) add("volume there (cm\u00b3)", shown_number(1e6 * *point.volume_m3));
  }
  section.tables.push_back(std::move(table));
  add_notes_of(result, section.words);
}

void add_modes(const CommandOutput& output, PageSection& section) {
  const io::CsvContents modes = io::read_csv(output.folder / "modes.csv");
  section.tables.push_back(
      shown_table("Natural frequencies: " + heading_of(output), modes, modes.columns(), file_of(output, "modes.csv")));
  PageChart chart{.title = "Natural frequencies under pressure: " + heading_of(output),
                  .x = {.title = "path parameter"},
                  .y = {.title = "frequency (Hz)"},
                  .series = {}};
  const std::vector<std::string> pressures = ending_with(modes, "_pressure_Pa");
  const std::string abscissa = pressures.size() == 1 ? pressures.front() : "path_parameter";
  if (pressures.size() == 1) chart.x.title = "gauge pressure (kPa)";
  for (const std::string& mode : distinct(modes, "mode")) {
    PageSeries series{.name = "mode " + mode, .x = {}, .y = {}, .marks = PageMarks::line_and_points};
    for (std::size_t row = 0; row < modes.row_count(); ++row) {
      const auto x = number_in(modes, row, abscissa);
      const auto y = number_in(modes, row, "frequency_Hz");
      if (text_in(modes, row, "mode") != mode || !x || !y) continue;
      series.x.push_back(*x * (pressures.size() == 1 ? 1e-3 : 1.0));
      series.y.push_back(*y);
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  if (!chart.series.empty()) section.charts.push_back(std::move(chart));
}

void add_load_cases(const CommandOutput& output, PageSection& section) {
  PageTable table{.title = "Load cases: " + heading_of(output),
                  .columns = {"case", "kind", "status", "reason", "states"},
                  .rows = {},
                  .note = "One .toml and one .csv per case in " + file_of(output, "") + "."};
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(output.folder, ignored))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const io::TomlTable curve = io::read_toml(file);
    const auto load_case = curve.optional_table("case");
    if (!load_case || !curve.has("status")) continue;
    const fs::path rows = fs::path(file).replace_extension(".csv");
    const bool has_rows = io::is_file(rows);
    table.rows.push_back({load_case->text_or("name", file.stem().string()), load_case->text_or("kind", ""), curve.text("status"),
                          curve.text_or("reason", ""), has_rows ? std::to_string(io::read_csv(rows).row_count()) : "0"});
  }
  if (!table.rows.empty()) section.tables.push_back(std::move(table));
}

}  // namespace menger::evolution
