#include "meshes/load_cases/response_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "io/text/content_hash.h"
#include "io/text/csv_table.h"
#include "io/text/input_error.h"
#include "io/text/joined_text.h"
#include "io/text/number_text.h"
#include "io/text/run_status_words.h"
#include "io/text/toml_document.h"
#include "io/text/toml_text.h"
#include "io/text/whole_file.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::meshes {

namespace {

namespace fs = std::filesystem;

/// Checks whether values are strictly monotone. @return the position of the first value that is not; nothing if there is none
std::optional<std::size_t> first_turn(const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    const bool moves = values[i] != values[i - 1];
    const bool turns = i > 1 && (values[i] > values[i - 1]) != (values[1] > values[0]);
    if (!moves || turns) return i;
  }
  return std::nullopt;
}

/// Checks the abscissae of a table. @throws io::InputError if they are not valid for a curve
void check_abscissae(const ResponseCurve& curve, const fs::path& file) {
  const std::size_t abscissae = abscissa_count(curve.provenance.load_case.kind);
  const auto fault = [&](std::size_t column, std::size_t row) {
    return io::InputError(file.string() + ": " + curve.columns[column] + " = " + io::number_text(curve.values[column][row]) +
                          " in row " + std::to_string(row + 1) + ": must be strictly monotone" +
                          (column > 0 ? " at equal " + curve.columns[0] : ""));
  };
  const std::vector<double>& outer = curve.values.front();
  std::vector<std::size_t> starts;  // of the runs of equal first abscissae
  for (std::size_t row = 0; row < outer.size(); ++row)
    if (row == 0 || abscissae == 1 || outer[row] != outer[row - 1]) starts.push_back(row);
  std::vector<double> distinct;
  distinct.reserve(starts.size());
  for (const std::size_t start : starts) distinct.push_back(outer[start]);
  if (const auto turn = first_turn(distinct)) throw fault(0, starts[*turn]);
  if (abscissae == 1) return;
  for (std::size_t run = 0; run < starts.size(); ++run) {
    const std::size_t end = run + 1 < starts.size() ? starts[run + 1] : outer.size();
    const auto& inner = curve.values[1];
    const std::vector<double> values(inner.begin() + static_cast<std::ptrdiff_t>(starts[run]),
                                     inner.begin() + static_cast<std::ptrdiff_t>(end));
    if (const auto turn = first_turn(values)) throw fault(1, starts[run] + *turn);
  }
}

void check(const ResponseCurve& curve, const fs::path& file) {
  const std::vector<std::string> wanted = response_columns(curve.provenance.load_case);
  if (curve.columns != wanted) {
    throw io::InputError(file.string() + ": the columns of a curve of kind \"" +
                         std::string(to_string(curve.provenance.load_case.kind)) + "\" must be " + io::joined(wanted) + ", not " +
                         io::joined(curve.columns));
  }
  const bool is_table = curve.values.size() == curve.columns.size() &&
                        std::all_of(curve.values.begin(), curve.values.end(),
                                    [&](const auto& values) { return values.size() == curve.row_count(); });
  if (!is_table || curve.row_count() == 0) throw io::InputError(file.string() + ": a curve needs at least one row");
  for (std::size_t column = 0; column < curve.columns.size(); ++column) {
    if (!std::all_of(curve.values[column].begin(), curve.values[column].end(), [](double value) { return std::isfinite(value); }))
      throw io::InputError(file.string() + ": " + curve.columns[column] + " must be finite");
  }
  check_abscissae(curve, file);
}

std::string provenance_text(const CurveProvenance& provenance, const std::string& table_hash) {
  io::TomlText text;
  text.add("table_hash", table_hash)
      .add("model", provenance.model)
      .add("silicone", provenance.silicone)
      .add("law", provenance.law)
      .add("shear_modulus_Pa", provenance.shear_modulus_Pa)
      .add("density_kg_per_m3", provenance.density_kg_m3)
      .add("relative_uncertainty", provenance.relative_uncertainty)
      .add("status", io::to_string(provenance.status));
  if (!provenance.reason.empty()) text.add("reason", provenance.reason);
  if (provenance.limit_pressure_Pa) text.add("limit_pressure_Pa", *provenance.limit_pressure_Pa);
  if (provenance.contact_pressure_Pa) text.add("contact_pressure_Pa", *provenance.contact_pressure_Pa);
  text.table("case").lines(load_case_text(provenance.load_case));
  for (const auto& [name, hash] : provenance.inputs) text.entry("inputs").add("file", name).add("content_hash", hash);
  return text.text();
}

std::string read_filled(const io::TomlTable& table, std::string_view key) {
  std::string text = table.text(key);
  if (text.empty()) throw table.error(key, "must not be empty");
  return text;
}

CurveProvenance read_provenance(const io::TomlTable& top) {
  CurveProvenance provenance;
  provenance.model = read_filled(top, "model");
  provenance.silicone = read_filled(top, "silicone");
  provenance.law = read_filled(top, "law");
  provenance.shear_modulus_Pa = top.number("shear_modulus_Pa", io::positive());
  // Earlier versions wrote density_kg_m3.
  provenance.density_kg_m3 = top.number(top.has("density_kg_m3") ? "density_kg_m3" : "density_kg_per_m3", io::positive());
  provenance.relative_uncertainty = top.number("relative_uncertainty", io::positive());
  provenance.status = top.word("status", io::run_status_words());
  provenance.reason = top.text_or("reason", "");
  provenance.limit_pressure_Pa = top.optional_number("limit_pressure_Pa", io::positive());
  provenance.contact_pressure_Pa = top.optional_number("contact_pressure_Pa", {.highest = 0.0, .highest_excluded = true});
  provenance.load_case = read_load_case(top.table("case"));
  for (const io::TomlTable& input : top.optional_tables("inputs")) {
    if (!provenance.inputs.emplace(read_filled(input, "file"), read_filled(input, "content_hash")).second)
      throw input.error("file", "is given twice");
  }
  return provenance;
}

fs::path table_beside(const fs::path& provenance_file) { return fs::path(provenance_file).replace_extension(".csv"); }

}  // namespace

const std::vector<double>& ResponseCurve::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::out_of_range("no column \"" + name + "\" among " + io::joined(columns));
  return values[static_cast<std::size_t>(found - columns.begin())];
}

void write_response_curve(const fs::path& folder, const ResponseCurve& curve) {
  const fs::path provenance_file = folder / (curve.provenance.load_case.name + ".toml");
  const fs::path table_file = table_beside(provenance_file);
  check(curve, table_file);
  io::CsvTable table(curve.columns);
  for (std::size_t row = 0; row < curve.row_count(); ++row) {
    std::vector<io::CsvCell> cells;
    for (const std::vector<double>& values : curve.values) cells.push_back(io::cell(values[row]));
    table.add_cells(cells);
  }
  table.write(table_file);
  // The provenance is written last: a table without the provenance that was written for it is refused.
  io::write_whole(provenance_file, provenance_text(curve.provenance, io::content_hash(table.text())));
}

ResponseCurve read_response_curve(const fs::path& provenance_file) {
  std::error_code ignored;
  if (provenance_file.extension() != ".toml" || !fs::exists(provenance_file, ignored)) {
    throw io::InputError(
        provenance_file.string() +
        ": is not the provenance of a response curve: a table is used only with the .toml file that was written for it");
  }
  const io::TomlTable top = io::read_toml(provenance_file);
  ResponseCurve curve;
  curve.provenance = read_provenance(top);
  const fs::path table_file = table_beside(provenance_file);
  const std::string text = io::read_whole(table_file);
  if (top.text("table_hash") != io::content_hash(text))
    throw top.error("table_hash", "the table " + table_file.string() + " is not the one for which this provenance was written");
  top.finish();

  const io::CsvContents table = io::parse_csv(text, table_file);
  curve.columns = table.columns();
  if (curve.columns == response_columns(curve.provenance.load_case)) {
    for (const std::string& column : curve.columns) curve.values.push_back(table.numbers(column));
  }
  check(curve, table_file);
  return curve;
}

}  // namespace menger::meshes
