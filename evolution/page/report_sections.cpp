#include "evolution/page/report_sections.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "evolution/outputs/search_tables.h"
#include "evolution/page/chart_points.h"
#include "evolution/page/equilibrium_sections.h"
#include "evolution/page/search_sections.h"
#include "evolution/page/section_parts.h"
#include "evolution/page/shown_table.h"
#include "evolution/page/surrogate_sections.h"
#include "evolution/page/walk_section.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::evolution {
namespace {

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

std::vector<PageSection> report_sections(const std::vector<CommandOutput>& outputs, std::vector<std::string>& notes) {
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
