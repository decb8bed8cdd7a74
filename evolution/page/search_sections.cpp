#include "evolution/page/search_sections.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "evolution/outputs/json_parts.h"
#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/search_tables.h"
#include "evolution/page/section_parts.h"
#include "evolution/page/shown_table.h"
#include "io/text/csv_table.h"

namespace menger::evolution {
namespace {

/// The columns of a table of a search that people need to know what came out; what is left out is for who studies searches.
std::vector<std::string> telling_columns(const io::CsvContents& table) {
  std::vector<std::string> columns = table.columns();
  constexpr std::array left_out{"hausdorff_dimension", "cached", "pruned", "outside_validity", "champion_outside_validity"};
  std::erase_if(columns, [&](const std::string& column) { return std::ranges::find(left_out, column) != left_out.end(); });
  return columns;
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

}  // namespace

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
  // The table lies beside its manifest: scores.csv beside scores.csv.manifest.json, earlier beside scores.manifest.json.
  const std::string name = output.manifest.filename().string();
  std::string table = name.substr(0, name.size() - std::min(name.size(), std::string_view(".manifest.json").size()));
  if (!has_file(output, table.c_str())) table += ".csv";
  const io::CsvContents scores = io::read_csv(output.folder / table);
  section.tables.push_back(
      shown_table("Robots as another study lets them walk", scores, scores.columns(), file_of(output, table)));
}

}  // namespace menger::evolution
