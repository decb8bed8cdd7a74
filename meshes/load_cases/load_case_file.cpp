#include "meshes/load_cases/load_case_file.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "io/text/number_text.h"

namespace menger::meshes {

namespace {

constexpr int most_cells = 1000;  ///< along an axis; more is a slip of the pen

void add_line(std::string& text, std::string_view key, const std::string& value) {
  text.append(key).append(" = ").append(value).append("\n");
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ", ").append(io::number_text(value));
  return "[" + text + "]";
}

const io::Words<bool>& chamber_words() {
  static const io::Words<bool> words{{"single", false}, {"per-phase", true}};
  return words;
}

}  // namespace

const io::Words<LoadCaseKind>& load_case_kind_words() {
  static const io::Words<LoadCaseKind> words{
      {"inflation", LoadCaseKind::inflation}, {"blocked", LoadCaseKind::blocked}, {"stretch", LoadCaseKind::stretch},
      {"shear", LoadCaseKind::shear},         {"bending", LoadCaseKind::bending}, {"torsion", LoadCaseKind::torsion},
      {"press", LoadCaseKind::press},         {"sag", LoadCaseKind::sag},         {"modes", LoadCaseKind::modes}};
  return words;
}

std::string imposed_key(LoadCaseKind kind) { return abscissa_count(kind) < 2 ? "" : response_columns(kind)[1]; }

std::string load_case_text(const LoadCase& load_case) {
  std::string text;
  add_line(text, "name", io::toml_quoted(load_case.name));
  add_line(text, "kind", io::toml_quoted(to_string(load_case.kind)));
  const auto& [nx, ny, nz] = load_case.cells;
  add_line(text, "cells", "[" + std::to_string(nx) + ", " + std::to_string(ny) + ", " + std::to_string(nz) + "]");
  add_line(text, "digits", io::toml_quoted(load_case.digits));
  add_line(text, "level", std::to_string(load_case.level));
  add_line(text, "chambers", io::toml_quoted(chamber_words()[load_case.per_phase ? 1 : 0].first));
  add_line(text, "cell_edge_m", io::number_text(load_case.cell_edge_m));
  add_line(text, "wall_thickness_m", io::number_text(load_case.wall_thickness_m));
  add_line(text, "pressures_Pa", list(load_case.pressures_Pa));
  if (const std::string key = imposed_key(load_case.kind); !key.empty()) add_line(text, key, list(load_case.imposed));
  return text;
}

std::string read_case_name(const io::TomlTable& table) {
  std::string name = table.text("name");
  const auto fits = [](char sign) { return std::isalnum(static_cast<unsigned char>(sign)) != 0 || sign == '-' || sign == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw table.error("name", "must be a name of letters, digits, \"-\" and \"_\"");
  return name;
}

void read_cells(const io::TomlTable& table, LoadCase& load_case) {
  const std::vector<double> cells = table.numbers("cells", io::within(1, most_cells));
  if (cells.size() != 3) throw table.error("cells", "must be three numbers, along x, y and z");
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    load_case.cells[axis] = static_cast<int>(cells[axis]);
    if (load_case.cells[axis] != cells[axis]) throw table.error("cells", "must be whole numbers", std::array{axis});
    count *= static_cast<std::size_t>(load_case.cells[axis]);
  }
  load_case.digits = table.text("digits");
  const std::string& digits = load_case.digits;
  if (digits.size() != count) throw table.error("digits", "must be one digit for each of " + std::to_string(count) + " cells");
  if (digits.find_first_not_of("012") != std::string::npos) throw table.error("digits", "must be of 0, 1 and 2");
  if (digits.find_first_of("12") == std::string::npos) throw table.error("digits", "leave the body without a cell");
}

LoadCase read_load_case(const io::TomlTable& table) {
  LoadCase load_case;
  load_case.name = read_case_name(table);
  load_case.kind = table.word("kind", load_case_kind_words());
  read_cells(table, load_case);
  load_case.level = table.integer("level", io::within(1, 10));
  load_case.per_phase = table.word("chambers", chamber_words());
  load_case.cell_edge_m = table.number("cell_edge_m", io::positive());
  load_case.wall_thickness_m = table.number("wall_thickness_m", io::positive());
  if (!(load_case.wall_thickness_m < 0.5 * load_case.cell_edge_m))
    throw table.error("wall_thickness_m", "must be less than half of cell_edge_m");
  load_case.pressures_Pa = table.numbers("pressures_Pa");
  if (load_case.pressures_Pa.empty()) throw table.error("pressures_Pa", "must hold at least one pressure");
  const std::string key = imposed_key(load_case.kind);
  if (key.empty()) return load_case;
  load_case.imposed = table.numbers(key);
  if (load_case.imposed.empty()) throw table.error(key, "must hold at least one value");
  return load_case;
}

}  // namespace menger::meshes
