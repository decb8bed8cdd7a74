#include "evolution/page/shown_table.h"

#include <algorithm>
#include <cstddef>

#include "evolution/outputs/report_numbers.h"

namespace menger::evolution {

PageTable shown_table(const std::string& title, const io::CsvContents& table, const std::vector<std::string>& columns,
                      const std::string& file) {
  constexpr std::size_t most_rows = 200;
  PageTable shown{.title = title, .columns = {}, .rows = {}};
  std::vector<io::ShownColumn> known;
  const auto is_empty = [&](const std::string& column) {
    for (std::size_t row = 0; row < table.row_count(); ++row)
      if (!table.text(row, column).empty()) return false;
    return table.row_count() > 0;
  };
  for (const std::string& column : columns) {
    if (!table.has(column) || is_empty(column)) continue;
    known.push_back(io::shown_column(column));
    shown.columns.push_back(known.back().title());
  }
  for (std::size_t row = 0; row < std::min(most_rows, table.row_count()); ++row) {
    std::vector<std::string> cells;
    cells.reserve(known.size());
    for (const io::ShownColumn& column : known) cells.push_back(shown_cell(table, row, column));
    shown.rows.push_back(std::move(cells));
  }
  shown.note = known.size() < table.columns().size() ? "More columns: " + file + "." : "From " + file + ".";
  if (table.row_count() > most_rows)
    shown.note += " The first " + std::to_string(most_rows) + " of " + std::to_string(table.row_count()) + " rows.";
  return shown;
}

}  // namespace menger::evolution
