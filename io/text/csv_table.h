#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/text/input_error.h"
#include "io/text/range.h"

namespace menger::io {

/// A value of a table: nothing (an empty cell), a number, an integer or text.
using CsvCell = std::variant<std::monostate, double, std::int64_t, std::uint64_t, std::string>;

CsvCell cell(double value);
CsvCell cell(std::optional<double> value);
CsvCell cell(std::int64_t value);
CsvCell cell(std::uint64_t value);
CsvCell cell(int value);
CsvCell cell(std::string_view value);

/// A table of named columns, written as comma-separated values. The unit is in the name of the column (`time_s`).
///
/// Numbers are written with the fewest digits that read back as the same number, so equal tables are equal files. A number that
/// is not finite becomes an empty cell: no file of menger holds nan or inf. Text with a comma, quote or line break is quoted (RFC
/// 4180). Lines end in \n.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);

  /// Adds a row with one value per column (asserted).
  void add_cells(const std::vector<CsvCell>& cells);

  template <class... Values>
  void add_row(const Values&... values) {
    add_cells({cell(values)...});
  }

  [[nodiscard]] std::size_t row_count() const { return row_count_; }
  [[nodiscard]] const std::string& text() const { return text_; }

  /// Writes the table whole or not at all. @throws InputError naming path and reason
  void write(const std::filesystem::path& file) const;

 private:
  std::size_t column_count_;
  std::size_t row_count_ = 0;
  std::string text_;
};

/// A table read from a file: a header and rows of equal length. All cells are still text.
class CsvContents {
 public:
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
  [[nodiscard]] bool has(std::string_view column) const;

  /// @throws InputError if there is no such column
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;

  /// Returns a finite number. @throws InputError with file, line, column and value if the cell is empty, is not a number or lies
  /// outside `range`
  [[nodiscard]] double number(std::size_t row, std::string_view column, const Range& range = any_number()) const;

  /// Like number(), but returns nothing for an empty cell.
  [[nodiscard]] std::optional<double> optional_number(std::size_t row, std::string_view column,
                                                      const Range& range = any_number()) const;

  /// Returns a count: a whole number of at least 0. @throws InputError like number(), and above 2^53, where doubles have gaps
  [[nodiscard]] std::size_t count(std::size_t row, std::string_view column) const;

  /// Returns a whole column of numbers.
  [[nodiscard]] std::vector<double> numbers(std::string_view column, const Range& range = any_number()) const;

 private:
  friend CsvContents parse_csv(std::string_view text, const std::filesystem::path& file);
  [[nodiscard]] std::size_t column_index(std::string_view column) const;
  [[nodiscard]] InputError fault(std::size_t row, std::string_view column, const std::string& reason) const;

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::size_t> lines_;  ///< line of the file on which each row starts
};

/// Reads a table of comma-separated values whose first line names the columns. Cells stay text until they are asked for.
/// @throws InputError if the file cannot be read, is empty, or has a row with more or fewer cells than the header
CsvContents read_csv(const std::filesystem::path& file);

/// Reads a table from text in memory. @param file source of the text, for messages only
CsvContents parse_csv(std::string_view text, const std::filesystem::path& file);

}  // namespace menger::io
