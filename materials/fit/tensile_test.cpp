#include "materials/fit/tensile_test.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/whole_file.h"

namespace menger::materials {

namespace {

constexpr std::string_view header_start = "Time (s);";
constexpr std::string_view database_header = "Time (s);True Strain;True Stress (MPa);Engineering Strain;Engineering Stress (MPa)";

std::vector<std::string_view> lines_of(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark, as spreadsheets write it
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t end = line.find(';');
    fields.push_back(line.substr(0, end));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line, const std::string& reason) {
  throw io::InputError(file.string() + ":" + std::to_string(line) + ": " + reason);
}

double read_number(std::string_view text, std::string_view column, const std::filesystem::path& file, std::size_t line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    refuse(file, line, std::string(column) + " = \"" + std::string(text) + "\": must be a finite number with a decimal point");
  return value;
}

double read_strain(double strain, const std::filesystem::path& file, std::size_t line) {
  if (!(strain > -1.0)) refuse(file, line, "strain = " + std::to_string(strain) + ": must be > -1");
  return strain;
}

TensileTest read_database_test(const std::vector<std::string_view>& lines, const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 5> columns{"Time (s)", "True Strain", "True Stress (MPa)", "Engineering Strain",
                                                    "Engineering Stress (MPa)"};
  TensileTest test;
  std::size_t row = 0;
  for (; !lines[row].starts_with(header_start); ++row) {
    const std::vector<std::string_view> fields = fields_of(lines[row]);
    if (fields.size() < 2) continue;
    if (fields[0] == "Material") test.material = fields[1];
    if (fields[0] == "Strain calculation") test.strain_source = fields[1];
  }
  if (lines[row] != database_header)
    refuse(file, row + 1, "the header must be \"" + std::string(database_header) + "\", units included");
  for (++row; row < lines.size(); ++row) {
    if (lines[row].empty()) continue;
    const std::vector<std::string_view> fields = fields_of(lines[row]);
    if (fields.size() != columns.size()) refuse(file, row + 1, "has " + std::to_string(fields.size()) + " fields, must have 5");
    std::array<double, columns.size()> values{};
    for (std::size_t i = 0; i < columns.size(); ++i) values[i] = read_number(fields[i], columns[i], file, row + 1);
    test.time_s.push_back(values[0]);
    test.strain.push_back(read_strain(values[3], file, row + 1));
    test.stress_Pa.push_back(1e6 * values[4]);
  }
  return test;
}

/// Normalises the name of a column: "Stress (kPa)" and "stress_kPa" are the same column.
std::string plain_name(std::string_view column) {
  std::string name;
  for (const char letter : column) {
    if (letter == ' ' || letter == '(' || letter == '[' || letter == '_') {
      if (!name.empty() && name.back() != '_') name += '_';
    } else if (letter == '%') {
      name += "percent";
    } else if (letter != ')' && letter != ']') {
      name += letter;
    }
  }
  if (name.starts_with("Str")) name[0] = 's';
  return name;
}

/// Conversion from the unit of a column to SI units: value = scale * (x - origin).
struct Column {
  std::string_view name;
  double scale = 1.0;
  double origin = 0.0;
};

constexpr std::array<Column, 4> strain_columns{{{"strain"}, {"strain_-"}, {"strain_percent", 0.01}, {"stretch", 1.0, 1.0}}};
constexpr std::array<Column, 4> stress_columns{
    {{"stress_Pa"}, {"stress_kPa", 1e3}, {"stress_MPa", 1e6}, {"stress_psi", 6894.757293168}}};

/// Returns the column of the file that has one of these names, and its name in the file.
std::pair<std::string, Column> find_column(const io::CsvContents& table, const std::array<Column, 4>& known,
                                           const std::string& demand, const std::filesystem::path& file) {
  for (const std::string& name : table.columns()) {
    const auto* const found =
        std::find_if(known.begin(), known.end(), [&](const Column& c) { return c.name == plain_name(name); });
    if (found != known.end()) return {name, *found};
  }
  std::string header;
  for (const std::string& name : table.columns()) header.append(header.empty() ? "" : ",").append(name);
  throw io::InputError(file.string() + ":1: header = \"" + header + "\": one column must be " + demand);
}

/// Refuses a table of semicolons or tabs by its header, before its rows are refused for what they are not.
void require_commas(const std::vector<std::string_view>& lines, const std::filesystem::path& file) {
  const auto header = std::find_if(lines.begin(), lines.end(), [](std::string_view line) { return !line.empty(); });
  if (header == lines.end() || header->find(',') != std::string_view::npos) return;
  if (header->find_first_of(";\t") == std::string_view::npos) return;
  refuse(file, static_cast<std::size_t>(header - lines.begin()) + 1,
         "header = \"" + std::string(*header) + "\": columns must be separated by commas, and numbers have a decimal point");
}

TensileTest read_plain_test(const std::string& text, const std::vector<std::string_view>& lines,
                            const std::filesystem::path& file) {
  require_commas(lines, file);
  const io::CsvContents table = io::parse_csv(text, file);
  const auto [strain_name, strain] = find_column(table, strain_columns, "strain, strain_percent or stretch", file);
  const auto [stress_name, stress] = find_column(table, stress_columns, "stress_Pa, stress_kPa, stress_MPa or stress_psi", file);
  if (table.columns().size() != 2) throw io::InputError(file.string() + ":1: must have two columns, strain and stress");
  const io::Range above_rupture{.lowest = strain.origin - 1.0 / strain.scale, .lowest_excluded = true};
  TensileTest test;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    test.strain.push_back(strain.scale * (table.number(row, strain_name, above_rupture) - strain.origin));
    test.stress_Pa.push_back(stress.scale * (table.number(row, stress_name) - stress.origin));
  }
  return test;
}

}  // namespace

TensileTest read_tensile_test(const std::filesystem::path& file) {
  const std::string text = io::read_whole(file);
  const std::vector<std::string_view> lines = lines_of(text);
  const bool is_database = std::any_of(lines.begin(), lines.end(), [](auto line) { return line.starts_with(header_start); });
  TensileTest test = is_database ? read_database_test(lines, file) : read_plain_test(text, lines, file);
  if (test.material.empty()) test.material = file.stem().string();
  if (test.strain.size() < 2) throw io::InputError(file.string() + ": must hold at least two rows of data");
  return test;
}

}  // namespace menger::materials
