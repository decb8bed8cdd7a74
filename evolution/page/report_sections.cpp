#include "evolution/page/report_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "evolution/outputs/json_parts.h"
#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/result_facts.h"
#include "evolution/outputs/search_tables.h"
#include "evolution/page/chamber_names.h"
#include "evolution/page/chart_points.h"
#include "evolution/page/shown_table.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/formatted.h"
#include "io/text/input_error.h"
#include "io/text/is_file.h"
#include "io/text/joined_text.h"
#include "io/text/toml_document.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/limit_pressure.h"
#include "meshes/load_cases/walk_agreement.h"

namespace menger::evolution {
namespace {

namespace fs = std::filesystem;

using Notes = std::vector<std::string>;

bool has_file(const CommandOutput& output, const char* file) { return io::is_file(output.folder / file); }

std::string heading_of(const CommandOutput& output) {
  if (output.body_name.empty()) return body_or_place(output);
  return output.body_name + (output.name.empty() || output.name == output.body_name ? "" : " (" + output.name + ")");
}

std::vector<std::string> ending_with(const io::CsvContents& table, std::string_view ending) {
  std::vector<std::string> columns;
  for (const std::string& column : table.columns())
    if (column.ends_with(ending)) columns.push_back(column);
  return columns;
}

void add_notes_of(const io::TomlTable& table, std::vector<std::string>& words) {
  if (!table.has("notes")) return;
  for (const std::string& note : table.texts("notes")) words.push_back(with_rounded_numbers(note) + ".");
}

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

/// Pressure against volume of every plenum, with the limit pressures.
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

bool is_walk(const CommandOutput& output) {
  return (command_of(output) == "locomote" || command_of(output) == "simulate") && has_file(output, "trajectory.csv");
}

std::string model_of(const CommandOutput& output) {
  if (command_of(output) == "locomote") return "finite elements";
  return output.is_calibrated ? "surrogate" : "voxels";
}

/// The file with the outcome of a walk.
const char* outcome_file(const CommandOutput& output) {
  return command_of(output) == "locomote" ? "locomotion.toml" : "result.toml";
}

/// A direction along which progress counts, and the walk that goes there.
struct CommonDirection {
  std::array<double, 2> along{};  ///< of length 1
  std::string walk{};             ///< for people: where its results are, with its direction
};

/// The direction along which the progress of all walks of a body counts, so that walks which go opposite ways look so: that of
/// its walk on the finest finite elements, or else of any, which walks at all. Nothing if none does.
std::optional<CommonDirection> common_direction(const CommandOutput& of, const std::vector<CommandOutput>& outputs) {
  std::optional<CommonDirection> direction;
  double most_elements = -1.0;
  for (const CommandOutput& other : outputs) {
    if (!is_walk(other) || (&other != &of && !are_of_one_body(other.stated, of.stated))) continue;
    try {
      const io::TomlTable result = io::read_toml(other.folder / outcome_file(other));
      const double elements = command_of(other) == "locomote" ? result.optional_number("elements").value_or(0.0) : -0.5;
      const auto lengths = result.optional_number("horizontal_displacement_body_lengths");
      if (elements <= most_elements || !result.has("displacement_m")) continue;
      const std::vector<double> moved_m = result.numbers("displacement_m");
      const double way_m = moved_m.size() == 3 ? std::hypot(moved_m[0], moved_m[1]) : 0.0;
      if (!(way_m > 0.0) || lengths.value_or(1.0) < meshes::walk_limits::least_body_lengths) continue;
      most_elements = elements;
      direction = {.along = {moved_m[0] / way_m, moved_m[1] / way_m},
                   .walk = (other.name.empty() ? heading_of(other) : other.name) + " (" + model_of(other) + ", " +
                           io::degrees(meshes::direction_deg(moved_m[0], moved_m[1])) + " from x)"};
    } catch (const io::InputError&) {
      continue;  // told where its own walk is shown
    }
  }
  return direction;
}

/// What is drawn of a walk in the chart of progress.
enum class DrawnProgress { of_walk, of_what_is_no_walk, distance };

/// Says in a chart of progress along which directions it counts, what is no walk, and of which series it is the distance from the
/// start: of what is no walk and has no walk of its body beside it. @param drawn by series
void tell_what_is_drawn(const std::vector<DrawnProgress>& drawn, const std::vector<std::string>& directions,
                        PageChart& progress) {
  const auto has = [&](DrawnProgress one) { return std::ranges::find(drawn, one) != drawn.end(); };
  const std::string distance = "the horizontal distance from its start, since the line to its end is chance.";
  if (directions.empty()) {
    progress.title = "Distance from the start over time";
    progress.y.title = "distance of the centre of mass from its start (mm)";
    progress.note = "What ends within " + io::percents(meshes::walk_limits::least_body_lengths) +
                    " of its length from its start is no walk: drawn is " + distance;
    return;
  }
  progress.note =
      "Along one direction for all walks of a body, that of its walk on the finest finite elements, or else in voxels: " +
      io::joined(directions, "; ") +
      ". A curve falls where the body goes back, and one that ends below 0 went the other way. Where a walk goes to "
      "and fro, distance and direction depend on when one looks.";
  if (has(DrawnProgress::of_what_is_no_walk))
    progress.note += " What ends within " + io::percents(meshes::walk_limits::least_body_lengths) +
                     " of its length from its start is no walk, and gives no direction.";
  if (has(DrawnProgress::distance)) progress.note += " Of what is no walk, and of a body without any, it is " + distance;
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    if (drawn[n] == DrawnProgress::of_what_is_no_walk) progress.series[n].name += " (no walk)";
    if (drawn[n] == DrawnProgress::distance) progress.series[n].name += " (no walk: distance from its start)";
  }
}

/// All walks in one chart of progress over time, one of paths seen from above, and one table.
PageSection walk_section(const std::vector<CommandOutput>& outputs, Notes& notes) {
  PageSection section{.title = "Walks", .id = "walks"};
  PageChart progress{.title = "Progress over time",
                     .x = {.title = "time (s)"},
                     .y = {.title = "progress of the centre of mass (mm)"},
                     .series = {}};
  std::vector<DrawnProgress> drawn;  // by series
  std::vector<std::string> directions;
  PageChart path{.title = "Paths seen from above",
                 .x = {.title = "x (mm)"},
                 .y = {.title = "y (mm)"},
                 .series = {},
                 .equal_scale = true,
                 .note = "Every path begins at 0, 0."};
  PageChart energy{.title = "Energy that finite elements lose or gain by numerical error",
                   .x = {.title = "time (s)"},
                   .y = {.title = "imbalance of energy (mJ)"},
                   .series = {}};
  PageTable table{
      .title = "Walks, from start to end",
      .columns = {"model", "distance (mm)", "distance (body lengths)", "speed (body lengths / min)", "direction (degrees from x)",
                  "time (s)", "status", "body", "from"},
      .rows = {},
      .note = "Distance, speed and direction are those of the centre of mass from the start to the end of each walk."};
  for (const CommandOutput& output : outputs) {
    if (!is_walk(output)) continue;
    try {
      const io::CsvContents walk = io::read_csv(output.folder / "trajectory.csv");
      const std::string name = heading_of(output) + ", " + model_of(output);
      const bool dashed = command_of(output) == "simulate";
      const std::vector<double> time_s = column_of(walk, "time_s");
      std::vector<double> x_mm = column_of(walk, "centre_of_mass_x_m", 1e3);
      std::vector<double> y_mm = column_of(walk, "centre_of_mass_y_m", 1e3);
      for (std::vector<double>* values : {&x_mm, &y_mm})
        for (const double first = values->empty() ? 0.0 : values->front(); double& value : *values) value -= first;
      const char* file = outcome_file(output);
      const io::TomlTable result = io::read_toml(output.folder / file);
      const auto lengths = result.optional_number("horizontal_displacement_body_lengths");
      const bool goes_nowhere = lengths && *lengths < meshes::walk_limits::least_body_lengths;
      const auto direction_of_body = common_direction(output, outputs);
      // What ended early has no displacement, and may have a way all the same.
      const bool has_own_line = !direction_of_body && !goes_nowhere;
      std::vector<double> progress_mm = direction_of_body ? progress_of(walk, direction_of_body->along)
                                        : has_own_line    ? progress_of(walk)
                                                          : distance_from_start(walk);
      const std::string direction_words = direction_of_body ? direction_of_body->walk
                                          : has_own_line    ? name + " (the line to its own end)"
                                                            : "";
      if (!direction_words.empty() && std::ranges::find(directions, direction_words) == directions.end())
        directions.push_back(direction_words);
      for (double& value : progress_mm) value *= 1e3;
      progress.series.push_back({.name = name, .x = time_s, .y = std::move(progress_mm), .dashed = dashed});
      drawn.push_back(!goes_nowhere       ? DrawnProgress::of_walk
                      : direction_of_body ? DrawnProgress::of_what_is_no_walk
                                          : DrawnProgress::distance);
      path.series.push_back({.name = name, .x = x_mm, .y = y_mm, .dashed = dashed});
      if (walk.has("imbalance_J")) energy.series.push_back({.name = name, .x = time_s, .y = column_of(walk, "imbalance_J", 1e3)});
      const auto moved_m = result.optional_number("horizontal_displacement_m");
      const double end_s = result.number("time_s");
      std::string direction = shown_number(std::optional<double>());
      if (result.has("displacement_m") && !goes_nowhere) {
        const std::vector<double> vector_m = result.numbers("displacement_m");
        if (vector_m.size() == 3) direction = shown_whole(meshes::direction_deg(vector_m[0], vector_m[1]));
      }
      table.rows.push_back({model_of(output), shown_number(moved_m ? std::optional(1e3 * *moved_m) : std::nullopt),
                            shown_number(lengths),
                            shown_number(lengths && end_s > 0.0 ? std::optional(60.0 * *lengths / end_s) : std::nullopt),
                            direction, shown_number(end_s), result.text("status"), heading_of(output), file_of(output, file)});
      if (const std::string reason = result.text_or("reason", ""); !reason.empty())
        section.words.push_back(std::string(name).append(": ").append(reason).append("."));
    } catch (const io::InputError& error) {
      notes.emplace_back(error.what());
    }
  }
  if (table.rows.empty()) return section;
  tell_what_is_drawn(drawn, directions, progress);
  section.charts = {std::move(progress), std::move(path)};
  if (!energy.series.empty()) section.charts.push_back(std::move(energy));
  section.tables.push_back(std::move(table));
  return section;
}

/// The names of a column without repetition, in the order in which they appear.
std::vector<std::string> distinct(const io::CsvContents& table, const std::string& column) {
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string name = text_in(table, row, column);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

void add_calibration(const CommandOutput& output, PageSection& section) {
  const io::CsvContents residuals = io::read_csv(output.folder / "residuals.csv");
  PageChart chart{.title = "Residuals: " + file_of(output, "residuals.csv"),
                  .x = {.title = "number of the fitted quantity"},
                  .y = {.title = "root mean square error / largest value (%)"},
                  .series = {},
                  .note = "One point per curve and quantity. Point at one to see which. The order is that of the table below."};
  std::map<std::string, PageSeries> by_kind;
  for (std::size_t row = 0; row < residuals.row_count(); ++row) {
    const auto relative = number_in(residuals, row, "relative");
    if (!relative) continue;
    PageSeries& series = by_kind[text_in(residuals, row, "kind")];
    series.x.push_back(static_cast<double>(row + 1));
    series.y.push_back(100.0 * *relative);
    series.labels.push_back(text_in(residuals, row, "case") + ", " +
                            io::shown_column(text_in(residuals, row, "ordinate")).title());
  }
  for (auto& [kind, series] : by_kind) {
    series.name = kind;
    series.marks = PageMarks::points;
    chart.series.push_back(std::move(series));
  }
  section.charts.push_back(std::move(chart));
  if (has_file(output, "responses.csv")) {
    const io::CsvContents responses = io::read_csv(output.folder / "responses.csv");
    PageChart agreement{
        .title = "Fitted values: surrogate against finite elements",
        .x = {.title = "finite elements / largest value of the curve"},
        .y = {.title = "surrogate / largest value of the curve"},
        .series = {},
        .equal_scale = true,
        .diagonal = true,
        .note = "Both axes are divided by the largest value of finite elements in the curve of a case and quantity. From " +
                file_of(output, "responses.csv") + "."};
    std::map<std::pair<std::string, std::string>, double> largest;
    const auto key = [&](std::size_t row) {
      return std::pair(text_in(responses, row, "case"), text_in(responses, row, "ordinate"));
    };
    for (std::size_t row = 0; row < responses.row_count(); ++row)
      largest[key(row)] = std::max(largest[key(row)], std::abs(number_in(responses, row, "reference").value_or(0.0)));
    for (const std::string& kind : distinct(responses, "kind")) {
      PageSeries series{.name = kind, .x = {}, .y = {}, .marks = PageMarks::points};
      for (std::size_t row = 0; row < responses.row_count(); ++row) {
        const auto reference = number_in(responses, row, "reference");
        const auto surrogate = number_in(responses, row, "surrogate");
        const double scale = largest[key(row)];
        if (text_in(responses, row, "kind") != kind || !reference || !surrogate || !(scale > 0.0)) continue;
        series.x.push_back(*reference / scale);
        series.y.push_back(*surrogate / scale);
        series.labels.push_back(text_in(responses, row, "case") + ", " +
                                io::shown_column(text_in(responses, row, "ordinate")).title());
      }
      agreement.series.push_back(std::move(series));
    }
    section.charts.push_back(std::move(agreement));
  }
  section.tables.push_back(shown_table("Residuals", residuals,
                                       {"case", "kind", "body", "ordinate", "rms", "worst", "unit", "relative"},
                                       file_of(output, "residuals.csv")));
  if (has_file(output, "parameters.csv")) {
    section.tables.push_back(shown_table("Fitted parameters with 95 % intervals", io::read_csv(output.folder / "parameters.csv"),
                                         {"parameter", "value", "lowest_95", "highest_95", "classes", "determination"},
                                         file_of(output, "parameters.csv")));
  }
  if (const auto fit = io::read_toml(output.folder / "result.toml").optional_table("fit")) add_notes_of(*fit, section.words);
}

/// Returns a fraction of a table in per cent, for people.
std::string percent_in(const io::CsvContents& table, std::size_t row, const std::string& column) {
  const auto fraction = number_in(table, row, column);
  return shown_number(fraction ? std::optional(100.0 * *fraction) : std::nullopt);
}

/// Shows a column of fractions in per cent.
void show_percent(const io::CsvContents& table, const std::string& column, PageTable& shown) {
  const auto title = std::ranges::find(shown.columns, io::shown_column(column).title());
  if (title == shown.columns.end()) return;
  const auto place = static_cast<std::size_t>(title - shown.columns.begin());
  *title += " (%)";
  for (std::size_t row = 0; row < shown.rows.size(); ++row) shown.rows[row][place] = percent_in(table, row, column);
}

/// Whether all numbers of a column are 0 or missing.
bool is_nought(const io::CsvContents& table, const std::string& column) {
  for (std::size_t row = 0; row < table.row_count(); ++row)
    if (number_in(table, row, column).value_or(0.0) != 0.0) return false;
  return true;
}

/// How a body is called in the tables of a validation.
using BodyName = std::function<std::string(const std::string&)>;

/// Where the largest error of a row lies: "the extent along z", with the load case where there are several.
std::string worst_text(const io::CsvContents& summary, std::size_t row, bool has_cases) {
  const std::string observable = text_in(summary, row, "worst_observable");  // none in results of earlier versions
  std::string load_case = text_in(summary, row, "worst_case");
  if (observable.empty()) return load_case;
  const auto difference_m = number_in(summary, row, "worst_m");  // of displacements
  return io::displacement_words(observable) + (difference_m ? ", by " + io::millimetres(*difference_m) : "") +
         (has_cases ? ", " + load_case : "");
}

/// The errors of a validation in per cent. Of one body alone, the sums over all bodies repeat its own numbers, and are left out.
/// @param is_of_loop whether the finite elements are those of the stage validate of a loop
PageTable summary_table(const io::CsvContents& summary, const std::string& file, const BodyName& name_of, bool is_of_loop) {
  const std::vector<std::string> bodies = distinct(summary, "body");
  const bool is_one = std::ranges::count_if(bodies, [](const std::string& body) { return body != "all"; }) == 1;
  const bool has_cases = distinct(summary, "worst_case").size() > 1;
  PageTable table{
      .title = "Errors by body, of the largest value in a curve",
      .columns = {"body", "kind", "range of the fit", "numbers compared", "numbers where the surrogate has no equilibrium",
                  "median (%)", "nine in ten are below (%)", "worst (%)", "worst in"},
      .rows = {},
      .note =
          "An error is a difference from finite elements, as a share of the largest value in its curve: where that is small, a "
          "small difference is a large share. The height of the top is that of the middle of the body, seen from above, over its "
          "lowest faces. " +
          std::string(is_of_loop
                          ? "The finite elements are quadratic, one through a wall, and up to 16 % too large themselves where "
                            "walls span single cells (fem/README.md). "
                          : "") +
          "More columns: " + file + "."};
  const bool has_lengths = summary.has("furthest_m");  // not in results of earlier versions
  if (has_lengths) {
    table.columns.insert(table.columns.end(), {"furthest off by (mm)", "furthest off in"});
    table.note += " Furthest off, in mm, is the displacement whose difference is the largest share of the length of its body.";
  }
  constexpr std::size_t without_equilibrium = 4;
  for (std::size_t row = 0; row < summary.row_count(); ++row) {
    const std::string body = text_in(summary, row, "body");
    if (is_one && body == "all") continue;
    std::string worst = worst_text(summary, row, has_cases);
    if (body == "all") worst.insert(0, name_of(text_in(summary, row, "worst_body")) + ", ");
    table.rows.push_back({body == "all" ? body : name_of(body), text_in(summary, row, "kind"), text_in(summary, row, "range"),
                          text_in(summary, row, "count"), text_in(summary, row, "without_equilibrium"),
                          percent_in(summary, row, "median"), percent_in(summary, row, "percentile_90"),
                          percent_in(summary, row, "worst"), worst});
    if (!has_lengths) continue;
    const auto furthest_m = number_in(summary, row, "furthest_m");
    std::string furthest = io::displacement_words(text_in(summary, row, "furthest_observable"));
    if (body == "all" && furthest_m) furthest.insert(0, name_of(text_in(summary, row, "furthest_body")) + ", ");
    table.rows.back().push_back(shown_number(furthest_m ? std::optional(1e3 * *furthest_m) : std::nullopt));
    table.rows.back().push_back(furthest);
  }
  if (is_nought(summary, "without_equilibrium")) {
    table.columns.erase(table.columns.begin() + without_equilibrium);
    for (std::vector<std::string>& row : table.rows) row.erase(row.begin() + without_equilibrium);
  }
  return table;
}

void add_validation(const CommandOutput& output, const CommandOutput* loop, PageSection& section) {
  const BodyName name_of = [&](const std::string& body) { return name_in_validation(body, output, loop); };
  const io::CsvContents errors = io::read_csv(output.folder / "errors.csv");
  PageChart chart{.title = "Displacements in both models: " + file_of(output, "errors.csv"),
                  .x = {.title = "finite elements (mm)"},
                  .y = {.title = "surrogate (mm)"},
                  .series = {},
                  .equal_scale = true,
                  .diagonal = true,
                  .note = "Inside the range of the fit, one series per body."};
  bool has_inside = false;
  for (std::size_t row = 0; row < errors.row_count(); ++row)
    has_inside = has_inside || (text_in(errors, row, "validity") == "inside" && text_in(errors, row, "kind") == "displacement");
  if (!has_inside) chart.note = "All outside the range of the fit, one series per body.";
  for (const std::string& body : distinct(errors, "body")) {
    PageSeries series{.name = name_of(body), .x = {}, .y = {}, .marks = PageMarks::points};
    for (std::size_t row = 0; row < errors.row_count(); ++row) {
      const auto elements = number_in(errors, row, "finite_elements");
      const auto surrogate = number_in(errors, row, "surrogate");
      if (text_in(errors, row, "body") != body || text_in(errors, row, "kind") != "displacement" ||
          (has_inside && text_in(errors, row, "validity") != "inside") || !elements || !surrogate)
        continue;
      series.x.push_back(1e3 * *elements);
      series.y.push_back(1e3 * *surrogate);
      series.labels.push_back(text_in(errors, row, "case") + ", " + io::shown_column(text_in(errors, row, "observable")).title() +
                              " at " + io::kilopascals(number_in(errors, row, "pressure_Pa").value_or(0.0)));
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  if (!chart.series.empty()) section.charts.push_back(std::move(chart));
  section.tables.push_back(summary_table(io::read_csv(output.folder / "summary.csv"), file_of(output, "summary.csv"), name_of,
                                         loop != nullptr && output.place == "validate"));
  if (has_file(output, "volume_actuation.csv")) {
    const io::CsvContents actuation = io::read_csv(output.folder / "volume_actuation.csv");
    std::vector<std::string> columns{"body", "chamber_share", "highest_pressure_Pa", "change_at_highest", "limit_pressure_Pa"};
    const bool has_vacuum = !is_nought(actuation, "lowest_pressure_Pa");
    if (has_vacuum) columns.insert(columns.end(), {"lowest_pressure_Pa", "change_at_lowest", "contact_pressure_Pa"});
    section.tables.push_back(shown_table("Change of the outer volume of the body by pressure, on finite elements", actuation,
                                         columns, file_of(output, "volume_actuation.csv")));
    PageTable& table = section.tables.back();
    for (const char* fraction : {"chamber_share", "change_at_highest", "change_at_lowest"})
      show_percent(actuation, fraction, table);
    for (std::size_t row = 0; row < table.rows.size(); ++row) table.rows[row].front() = name_of(text_in(actuation, row, "body"));
    table.note += " The share of chambers is that of the whole body at rest.";
    if (has_vacuum)
      table.note += " Below 0 is vacuum, down to where walls touch (contact pressure); no drive from 0 upwards comes there.";
    table.note +=
        " These are finite elements of load cases. Those of an inflation may be others, and so may its limit pressure: thin-wall "
        "elements give limit pressures " +
        meshes::thin_wall_excess_text() + " higher than three-field elements.";
  }
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

/// The columns of a table of a search that people need to know what came out; what is left out is for who studies searches.
std::vector<std::string> telling_columns(const io::CsvContents& table) {
  std::vector<std::string> columns = table.columns();
  constexpr std::array left_out{"hausdorff_dimension", "cached", "pruned", "outside_validity", "champion_outside_validity"};
  std::erase_if(columns, [&](const std::string& column) { return std::ranges::find(left_out, column) != left_out.end(); });
  return columns;
}

void add_search(const CommandOutput& output, const std::vector<CommandOutput>& outputs, PageSection& section) {
  const SearchTables tables = read_search_tables(output, outputs);
  const std::string best = fitness_column(tables.generations);
  const std::string unit = fitness_unit(tables);
  const std::vector<double> generations = column_of(tables.generations, "generation");
  PageChart chart{.title = "Progress of the search: " + tables.source,
                  .x = {.title = "generation"},
                  .y = {.title = "fitness (" + unit + ")"},
                  .series = {}};
  chart.series.push_back({.name = "best of the generation",
                          .x = generations,
                          .y = column_of(tables.generations, best),
                          .marks = PageMarks::line_and_points});
  if (const auto means = std::ranges::find_if(tables.generations.columns(),
                                              [](const std::string& column) { return column.starts_with("mean_fitness_"); });
      means != tables.generations.columns().end())
    chart.series.push_back(
        {.name = "mean of the survivors", .x = generations, .y = column_of(tables.generations, *means), .dashed = true});
  section.charts.push_back(std::move(chart));
  section.tables.push_back(
      shown_table("Generations: " + tables.source, tables.generations, telling_columns(tables.generations), tables.source));
  if (!tables.lineage || tables.lineage->row_count() == 0) return;
  const io::CsvContents& lineage = *tables.lineage;
  const auto fitness =
      std::ranges::find_if(lineage.columns(), [](const std::string& column) { return column.starts_with("fitness_"); });
  if (fitness != lineage.columns().end()) {
    PageSeries line{.name = "ancestors of " + tables.lineage_of + ", the eldest first",
                    .x = column_of(lineage, "generation"),
                    .y = column_of(lineage, *fitness),
                    .marks = PageMarks::line_and_points};
    for (std::size_t row = 0; row < lineage.row_count(); ++row)
      line.labels.push_back("individual " + text_in(lineage, row, "individual") + ", " + text_in(lineage, row, "cells") +
                            " cells, " + text_in(lineage, row, "phenotype"));
    section.charts.push_back({.title = "Lineage of " + tables.lineage_of + ": " + tables.lineage_source,
                              .x = {.title = "generation of birth"},
                              .y = {.title = "fitness (" + unit + ")"},
                              .series = {std::move(line)},
                              .note = "Each point is the parent of the next."});
  }
  section.tables.push_back(shown_table("Lineage of " + tables.lineage_of + ": " + tables.lineage_source, lineage,
                                       telling_columns(lineage), tables.lineage_source));
}

/// What a re-evaluation compares, by its manifest.
struct ReevaluationWords {
  std::string search;  ///< the model that decided the search, or the one beside finite elements: "search (draft finite elements)"
  std::string elements = "finite elements";  ///< of the re-evaluation: "standard finite elements"
  std::string measure;                       ///< of distances and directions; empty if it is not known
};

/// "draft finite elements", by the table of elements of a study
std::string elements_words(const nlohmann::json* elements) {
  const std::string fidelity = elements == nullptr ? "" : text_of(*elements, "fidelity");
  return fidelity + (fidelity.empty() ? "" : " ") + "finite elements";
}

/// How a search measures its walks, for people; empty if it is not known.
std::string measure_words(const nlohmann::json& search) {
  const nlohmann::json* evaluation = object_of(search, "evaluation");
  const std::string measure = evaluation == nullptr ? "" : text_of(*evaluation, "measure");
  if (measure == "last_periods")
    return "in a period of the drive, by its last " + shown_number(number_of(*evaluation, "measure_periods"));
  if (measure != "net_displacement") return "";
  const nlohmann::json* time = object_of(search, "time");
  const double from_s = time == nullptr ? 0.0 : number_of(*time, "measure_from_s").value_or(0.0);
  return "from " + (from_s > 0.0 ? shown_number(from_s) + " s" : std::string("the start")) + " to the end";
}

ReevaluationWords reevaluation_words(const CommandOutput& output) {
  const nlohmann::json parameters = nlohmann::json::parse(output.parameters, nullptr, false);
  ReevaluationWords words{.search = "surrogate", .measure = {}};
  if (!parameters.is_object()) return words;
  words.elements = elements_words(object_of(parameters, "elements"));
  const nlohmann::json* search = object_of(parameters, "search");
  if (search == nullptr) return words;
  words.measure = measure_words(*search);
  // The file has one set of columns, called surrogate, for whatever model decided the search.
  if (compares_elements_of_search(parameters)) words.search = "search (" + elements_words(object_of(*search, "elements")) + ")";
  return words;
}

/// The heads of a table of robots in both models: each with its model.
void name_models(const ReevaluationWords& words, PageTable& robots) {
  constexpr std::string_view speed = " (body lengths / min)";
  for (std::string& title : robots.columns) {
    for (const auto& [model, name] : {std::pair<std::string_view, std::string>{"surrogate", words.search},
                                      std::pair<std::string_view, std::string>{"elements", words.elements}}) {
      if (title.starts_with(model)) title.replace(0, model.size(), name).insert(name.size(), ":");
    }
    if (title.ends_with(":" + std::string(speed))) title.insert(title.size() - speed.size(), " speed");
    if (title == "angle (degrees)") title = "angle between both (degrees)";
    if (title.ends_with(": relative error")) title = words.search + ": error of the displacement (share)";
  }
  if (!words.measure.empty()) {
    robots.title += ", " + words.measure;
    robots.note += " Speeds and directions are those " + words.measure +
                   "; those in the table of walks are from start to end, and may differ.";
  }
  if (words.search != "surrogate") robots.note += " Columns of the search are called surrogate in the file.";
}

/// What a row of ranking.csv is about, for people.
std::string ranking_words(const std::string& quantity) {
  if (quantity == "spearman") return "rank correlation of distances (Spearman)";
  if (quantity == "kendall") return "rank correlation of distances (Kendall)";
  constexpr std::string_view direction = "direction_within_";
  constexpr std::string_view top = "top_";
  const auto number_after = [&](std::string_view begin) {
    return quantity.substr(begin.size(), quantity.find('_', begin.size()) - begin.size());
  };
  if (quantity.starts_with(direction)) return "share of directions within " + number_after(direction) + " degrees";
  if (quantity.starts_with(top) && quantity.ends_with("_relative_regret"))
    return "that loss as a share of the best speed, with the search's best " + number_after(top);
  if (quantity.starts_with(top) && quantity.find("_regret_") != std::string::npos)
    return "speed lost if finite elements judge only the search's best " + number_after(top) + " (body lengths / min)";
  return io::shown_column(quantity).title();
}

/// How well a search ranks. Rows without a value are left out.
PageTable ranking_table(const io::CsvContents& ranking, const std::string& file) {
  PageTable table{.title = "How well the search ranks",
                  .columns = {"robots", "quantity", "value", "95 % from", "95 % to", "counted", "of"},
                  .rows = {},
                  .note = "How each is computed: " + file + "."};
  for (std::size_t row = 0; row < ranking.row_count(); ++row) {
    if (!number_in(ranking, row, "value")) continue;
    std::vector<std::string> cells{text_in(ranking, row, "designs"), ranking_words(text_in(ranking, row, "quantity"))};
    for (const char* column : {"value", "low_95", "high_95", "count", "of"})
      cells.push_back(shown_cell(ranking, row, io::shown_column(column)));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

void add_reevaluation(const CommandOutput& output, PageSection& section) {
  const io::CsvContents designs = io::read_csv(output.folder / "reevaluation.csv");
  const ReevaluationWords words = reevaluation_words(output);
  PageChart chart{.title = "Speeds of robots in both models" + (words.measure.empty() ? "" : ", " + words.measure),
                  .x = {.title = words.search + " (body lengths / min)"},
                  .y = {.title = words.elements + " (body lengths / min)"},
                  .series = {},
                  .diagonal = true,
                  .note = "A robot on the diagonal walks as fast in both. From " + file_of(output, "reevaluation.csv") + "."};
  for (const std::string& selection : distinct(designs, "selection")) {
    PageSeries series{
        .name = selection == "top" ? "best of the search" : selection, .x = {}, .y = {}, .marks = PageMarks::points};
    for (std::size_t row = 0; row < designs.row_count(); ++row) {
      const auto x = number_in(designs, row, "surrogate_body_lengths_per_minute");
      const auto y = number_in(designs, row, "elements_body_lengths_per_minute");
      if (text_in(designs, row, "selection") != selection || !x || !y) continue;
      series.x.push_back(*x);
      series.y.push_back(*y);
      series.labels.push_back("rank " + text_in(designs, row, "rank") + ", individual " + text_in(designs, row, "individual"));
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  if (!chart.series.empty()) section.charts.push_back(std::move(chart));
  PageTable robots =
      shown_table("Robots in both models", designs,
                  {"rank", "individual", "selection", "cells", "surrogate_status", "surrogate_body_lengths_per_minute",
                   "surrogate_direction_deg", "elements_status", "elements_body_lengths_per_minute", "elements_direction_deg",
                   "distance_ratio", "angle_deg", "surrogate_relative_error"},
                  file_of(output, "reevaluation.csv"));
  name_models(words, robots);
  section.tables.push_back(std::move(robots));
  if (has_file(output, "ranking.csv"))
    section.tables.push_back(ranking_table(io::read_csv(output.folder / "ranking.csv"), file_of(output, "ranking.csv")));
  if (has_file(output, "variants.csv")) {
    section.tables.push_back(shown_table(
        "How far the finite elements themselves can be known", io::read_csv(output.folder / "variants.csv"),
        {"rank", "variant", "kind", "status", "body_lengths_per_minute", "direction_deg", "relative_change", "change_angle_deg"},
        file_of(output, "variants.csv")));
  }
}

void add_confirmation(const CommandOutput& output, PageSection& section) {
  // The table lies beside its manifest: scores.csv beside scores.manifest.json.
  const std::string name = output.manifest.filename().string();
  const std::string table =
      name.substr(0, name.size() - std::min(name.size(), std::string_view(".manifest.json").size())) + ".csv";
  const io::CsvContents scores = io::read_csv(output.folder / table);
  section.tables.push_back(
      shown_table("Robots as another study lets them walk", scores, scores.columns(), file_of(output, table)));
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

void add_trade_off(const CommandOutput& output, PageSection& section) {
  if (has_file(output, "tradeoff.csv")) {
    const io::CsvContents rows = io::read_csv(output.folder / "tradeoff.csv");
    PageChart chart{.title = "Error against run time: " + heading_of(output),
                    .x = {.title = "processor time (s)", .logarithmic = true},
                    .y = {.title = "error (%)", .logarithmic = true},
                    .series = {},
                    .note = "From " + file_of(output, "tradeoff.csv") +
                            ". Settings without an error or with an error of 0, such as the reference, are left out."};
    for (const std::string& model : distinct(rows, "model")) {
      PageSeries series{.name = model, .x = {}, .y = {}, .marks = PageMarks::points};
      for (std::size_t row = 0; row < rows.row_count(); ++row) {
        const auto x = number_in(rows, row, "cpu_seconds");
        const auto y = number_in(rows, row, "relative_error");
        if (text_in(rows, row, "model") != model || !x || !y || !(*x > 0.0) || !(*y > 0.0)) continue;
        series.x.push_back(*x);
        series.y.push_back(100.0 * *y);
        series.labels.push_back(text_in(rows, row, "role") + " " + text_in(rows, row, "status"));
      }
      if (!series.x.empty()) chart.series.push_back(std::move(series));
    }
    if (!chart.series.empty()) section.charts.push_back(std::move(chart));
    section.tables.push_back(shown_table("All settings", rows, rows.columns(), file_of(output, "tradeoff.csv")));
  }
  if (!has_file(output, "recommendation.txt")) return;
  const std::string text = io::read_whole(output.folder / "recommendation.txt");
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) section.words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

PageSection provenance_section(const std::vector<CommandOutput>& outputs) {
  PageSection section{.title = "Where it comes from", .id = "provenance"};
  PageTable runs{.title = "Runs",
                 .columns = {"folder", "command", "version of menger", "wall time (s)", "seed", "input files"},
                 .rows = {},
                 .note = "From the manifest of each folder, which also has every parameter."};
  PageTable inputs{.title = "Input files", .columns = {"read by", "file", "SHA-256"}, .rows = {}};
  for (const CommandOutput& output : outputs) {
    runs.rows.push_back({output.place.empty() ? "." : output.place, command_of(output), output.version,
                         shown_number(output.seconds), output.seed ? std::to_string(*output.seed) : "\u2013",
                         std::to_string(output.inputs.size())});
    for (const auto& [file, hash] : output.inputs)
      inputs.rows.push_back({output.name.empty() ? "." : output.name, file, hash.substr(0, 16)});
    for (const std::string& note : output.notes)
      section.words.push_back((output.name.empty() ? command_of(output) : output.name) + ": " + with_rounded_numbers(note) + ".");
  }
  section.tables.push_back(std::move(runs));
  constexpr std::size_t most_inputs = 300;
  if (inputs.rows.size() > most_inputs) {
    inputs.note = "The first " + std::to_string(most_inputs) + " of " + std::to_string(inputs.rows.size()) + ". ";
    inputs.rows.resize(most_inputs);
  }
  inputs.note += "Of the hash, the first 16 of 64 digits.";
  if (!inputs.rows.empty()) section.tables.push_back(std::move(inputs));
  return section;
}

/// Words that repeat, as notes of several runs do, are shown once.
void keep_distinct(std::vector<std::string>& words) {
  std::set<std::string> known;
  std::erase_if(words, [&](const std::string& word) { return !known.insert(word).second; });
}

}  // namespace

std::vector<PageSection> report_sections(const std::vector<CommandOutput>& outputs, Notes& notes) {
  std::vector<PageSection> sections;
  const auto keep = [&](PageSection section) {
    keep_distinct(section.words);
    for (PageChart& chart : section.charts) {
      join_equal_series(chart);
      thin_series(chart);
    }
    if (!section.charts.empty() || !section.tables.empty() || !section.words.empty()) sections.push_back(std::move(section));
  };
  using Add = std::function<void(const CommandOutput&, PageSection&)>;
  const std::vector<const CommandOutput*> searches = searches_in(outputs);
  const auto add_searches = [&](const CommandOutput& output, PageSection& section) {
    if (std::ranges::find(searches, &output) != searches.end()) add_search(output, outputs, section);
  };
  const auto add_validations = [&](const CommandOutput& output, PageSection& section) {
    add_validation(output, loop_of(outputs), section);
  };
  const auto each = [&](const char* title, const char* id, const std::map<std::string, Add>& commands) {
    PageSection section{.title = title, .id = id};
    for (const CommandOutput& output : outputs) {
      const auto add = commands.find(command_of(output));
      if (add == commands.end()) continue;
      try {
        add->second(output, section);
      } catch (const io::InputError& error) {
        notes.emplace_back(error.what());
      }
    }
    keep(std::move(section));
  };
  each("Inflation", "inflation", {{"inflate", add_inflation}});
  keep(walk_section(outputs, notes));
  each("Shapes of the surrogate", "validation", {{"validate", add_validations}});
  each("Calibration", "calibration", {{"calibrate", add_calibration}});
  each("Search", "search", {{"evolve", add_searches}, {"export", add_searches}, {"confirm", add_confirmation}});
  each("Robots of the search on finite elements", "ranking", {{"reevaluate", add_reevaluation}});
  each("Natural frequencies", "modes", {{"modes", add_modes}});
  each("Error against cost", "tradeoff", {{"tradeoff", add_trade_off}});
  each("Load cases", "load-cases", {{"load-cases", add_load_cases}});
  keep(provenance_section(outputs));
  return sections;
}

}  // namespace menger::evolution
