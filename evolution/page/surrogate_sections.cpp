#include "evolution/page/surrogate_sections.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/result_facts.h"
#include "evolution/page/section_parts.h"
#include "evolution/page/shown_table.h"
#include "io/shown/shown_quantity.h"
#include "io/text/csv_table.h"
#include "io/text/toml_document.h"
#include "meshes/load_cases/limit_pressure.h"

namespace menger::evolution {
namespace {

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

}  // namespace

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

}  // namespace menger::evolution
