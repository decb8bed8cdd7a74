#include "io/text/csv_table.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <new>
#include <utility>

#include "io/text/number_text.h"
#include "io/text/toml_document.h"
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

struct Record {
  std::size_t line = 0;
  std::vector<std::string> cells;
};

/// Splits comma-separated text into records. Quoted cells may hold commas, doubled quotes and line breaks. Empty lines are
/// skipped.
class RecordReader {
 public:
  RecordReader(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;  // a byte order mark, as spreadsheets write it
  }

  std::vector<Record> records() {
    std::vector<Record> all;
    while (position_ < text_.size()) {
      Record record = next();
      if (record.cells.size() > 1 || !record.cells.front().empty()) all.push_back(std::move(record));
    }
    return all;
  }

 private:
  Record next() {
    Record record{.line = line_, .cells = {}};
    while (true) {
      record.cells.push_back(position_ < text_.size() && text_[position_] == '"' ? quoted_cell() : plain_cell());
      if (position_ >= text_.size()) return record;
      const char separator = text_[position_++];
      if (separator == ',') continue;
      if (separator == '\r' && position_ < text_.size() && text_[position_] == '\n') ++position_;
      ++line_;
      return record;
    }
  }

  std::string plain_cell() {
    const std::size_t end = std::min(text_.find_first_of(",\r\n", position_), text_.size());
    const std::string_view whole = text_.substr(position_, end - position_);
    position_ = end;
    const std::size_t first = whole.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return std::string(whole.substr(first, whole.find_last_not_of(" \t") - first + 1));
  }

  std::string quoted_cell() {
    const std::size_t opening_line = line_;
    std::string content;
    for (++position_; position_ < text_.size(); ++position_) {
      const char character = text_[position_];
      if (character == '\n') ++line_;
      if (character == '"') {
        if (position_ + 1 == text_.size() || text_[position_ + 1] != '"') break;
        ++position_;
      }
      content += character;
    }
    if (position_ >= text_.size())
      throw InputError(file_.string() + ":" + std::to_string(opening_line) + ": a quote is not closed");
    ++position_;
    if (position_ < text_.size() && std::string_view(",\r\n").find(text_[position_]) == std::string_view::npos) {
      throw InputError(file_.string() + ":" + std::to_string(line_) + ": text after a closing quote");
    }
    return content;
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

/// Returns a cell for a message, on one line.
std::string shown_cell(const std::string& text) {
  return text.find_first_of("\n\r") == std::string::npos ? text : toml_quoted(text);
}

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

CsvContents read_csv(const std::filesystem::path& file) { return parse_csv(read_whole(file), file); }

CsvContents parse_csv(std::string_view text, const std::filesystem::path& file) {
  std::vector<Record> records;
  try {
    records = RecordReader(text, file).records();
  } catch (const std::bad_alloc&) {
    throw InputError(file.string() + ": does not fit into memory");
  }
  if (records.empty()) throw InputError(file.string() + ": is empty: a header of column names is needed");
  CsvContents contents;
  contents.file_ = file;
  contents.columns_ = std::move(records.front().cells);
  for (std::size_t i = 1; i < records.size(); ++i) {
    Record& record = records[i];
    if (record.cells.size() != contents.columns_.size()) {
      throw InputError(file.string() + ":" + std::to_string(record.line) + ": " + std::to_string(record.cells.size()) +
                       " cells where the header has " + std::to_string(contents.columns_.size()));
    }
    contents.rows_.push_back(std::move(record.cells));
    contents.lines_.push_back(record.line);
  }
  return contents;
}

bool CsvContents::has(std::string_view column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::size_t CsvContents::column_index(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) throw InputError(file_.string() + ": no column " + std::string(column));
  return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& CsvContents::text(std::size_t row, std::string_view column) const {
  return rows_.at(row)[column_index(column)];
}

InputError CsvContents::fault(std::size_t row, std::string_view column, const std::string& reason) const {
  return InputError(file_.string() + ":" + std::to_string(lines_[row]) + ": " + std::string(column) + " = " +
                    shown_cell(text(row, column)) + ": " + reason);
}

std::optional<double> CsvContents::optional_number(std::size_t row, std::string_view column, const Range& range) const {
  const std::string& text = this->text(row, column);
  if (text.empty()) return std::nullopt;
  double value = 0.0;
  const bool has_plus = text.front() == '+' && !text.starts_with("+-");  // from_chars knows no plus
  const char* first = text.data() + (has_plus ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto result = std::from_chars(first, last, value);
  if (result.ec != std::errc{} || result.ptr != last || !std::isfinite(value))
    throw fault(row, column, "must be a finite number");
  if (!range.contains(value)) throw fault(row, column, range.demand());
  return value;
}

double CsvContents::number(std::size_t row, std::string_view column, const Range& range) const {
  const std::optional<double> value = optional_number(row, column, range);
  if (!value)
    throw InputError(file_.string() + ":" + std::to_string(lines_[row]) + ": " + std::string(column) + ": a number is missing");
  return *value;
}

std::size_t CsvContents::count(std::size_t row, std::string_view column) const {
  const double value = number(row, column, within(0.0, 0x1p53));
  if (value != std::floor(value)) throw fault(row, column, "must be a whole number");
  return static_cast<std::size_t>(value);
}

std::vector<double> CsvContents::numbers(std::string_view column, const Range& range) const {
  std::vector<double> values;
  values.reserve(rows_.size());
  for (std::size_t row = 0; row < rows_.size(); ++row) values.push_back(number(row, column, range));
  return values;
}

}  // namespace menger::io
