#include "evolution/page/section_parts.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "evolution/outputs/report_numbers.h"
#include "io/text/csv_table.h"
#include "io/text/is_file.h"
#include "io/text/toml_document.h"

namespace menger::evolution {

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

std::vector<std::string> distinct(const io::CsvContents& table, const std::string& column) {
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const std::string name = text_in(table, row, column);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string percent_in(const io::CsvContents& table, std::size_t row, const std::string& column) {
  const auto fraction = number_in(table, row, column);
  return shown_number(fraction ? std::optional(100.0 * *fraction) : std::nullopt);
}

void show_percent(const io::CsvContents& table, const std::string& column, PageTable& shown) {
  const auto title = std::ranges::find(shown.columns, io::shown_column(column).title());
  if (title == shown.columns.end()) return;
  const auto place = static_cast<std::size_t>(title - shown.columns.begin());
  *title += " (%)";
  for (std::size_t row = 0; row < shown.rows.size(); ++row) shown.rows[row][place] = percent_in(table, row, column);
}

bool is_nought(const io::CsvContents& table, const std::string& column) {
  for (std::size_t row = 0; row < table.row_count(); ++row)
    if (number_in(table, row, column).value_or(0.0) != 0.0) return false;
  return true;
}

}  // namespace menger::evolution
