#include "io/text/csv_table.h"

#include <cassert>
#include <cmath>

#include "io/text/number_text.h"
#include "io/text/whole_file.h"

namespace menger::io {

namespace {

std::string quoted_where_needed(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

struct CellText {
  std::string operator()(std::monostate /*nothing*/) const { return {}; }
  std::string operator()(double value) const { return std::isfinite(value) ? number_text(value) : std::string(); }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(std::uint64_t value) const { return std::to_string(value); }
  std::string operator()(const std::string& value) const { return quoted_where_needed(value); }
};

}  // namespace

CsvCell cell(double value) { return value; }
CsvCell cell(std::optional<double> value) { return value ? CsvCell(*value) : CsvCell(); }
CsvCell cell(std::int64_t value) { return value; }
CsvCell cell(std::uint64_t value) { return value; }
CsvCell cell(int value) { return std::int64_t{value}; }
CsvCell cell(std::string_view value) { return std::string(value); }

CsvTable::CsvTable(const std::vector<std::string>& columns) : column_count_(columns.size()) {
  assert(!columns.empty());
  for (const std::string& column : columns) text_.append(text_.empty() ? "" : ",").append(quoted_where_needed(column));
  text_ += '\n';
}

void CsvTable::add_cells(const std::vector<CsvCell>& cells) {
  assert(cells.size() == column_count_);
  for (std::size_t i = 0; i < cells.size(); ++i) text_.append(i == 0 ? "" : ",").append(std::visit(CellText{}, cells[i]));
  text_ += '\n';
  ++row_count_;
}

void CsvTable::write(const std::filesystem::path& file) const { write_whole(file, text_); }

}  // namespace menger::io
