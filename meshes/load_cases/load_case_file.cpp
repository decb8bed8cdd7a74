#include "meshes/load_cases/load_case_file.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "io/study/study_reader.h"
#include "io/study/study_text.h"

namespace menger::meshes {

namespace {

constexpr int most_cells = 1000;  ///< along an axis; a larger number is a typing error

/// Returns the fault of digits for a number of cells; empty if there is none.
std::string fault_of(const std::string& digits, const std::array<int, 3>& cells) {
  std::size_t count = 1;
  for (const int along : cells) count *= static_cast<std::size_t>(along);
  if (digits.size() != count) return "must be one digit for each of " + std::to_string(count) + " cells";
  if (digits.find_first_not_of("012") != std::string::npos) return "must contain only 0, 1 and 2";
  return digits.find_first_of("12") == std::string::npos ? "the body is empty: at least one digit must be 1 or 2" : "";
}

/// Returns the kinds that impose values under a key, for people: `kind = "bending" or "torsion"`.
std::string kinds_with(std::string_view key) {
  std::string kinds;
  for (const auto& [word, kind] : load_case_kind_words()) {
    if (imposed_key(kind) == key) kinds.append(kinds.empty() ? "kind = " : " or ").append(io::toml_quoted(word));
  }
  return kinds;
}

}  // namespace

const io::Words<LoadCaseKind>& load_case_kind_words() {
  static const io::Words<LoadCaseKind> words{
      {"inflation", LoadCaseKind::inflation}, {"blocked", LoadCaseKind::blocked}, {"stretch", LoadCaseKind::stretch},
      {"shear", LoadCaseKind::shear},         {"bending", LoadCaseKind::bending}, {"torsion", LoadCaseKind::torsion},
      {"press", LoadCaseKind::press},         {"sag", LoadCaseKind::sag},         {"modes", LoadCaseKind::modes}};
  return words;
}

const io::Words<bool>& case_chamber_words() {
  static const io::Words<bool> words{{"single", false}, {"per-phase", true}};
  return words;
}

std::string imposed_key(LoadCaseKind kind) { return abscissa_count(kind) < 2 ? "" : response_columns(kind)[1]; }

void describe_name(io::StudyVisitor& visitor, LoadCase& load_case) {
  std::string& name = load_case.name;
  visitor.text({"name", "Name of the case and of its files: letters, digits, - and _.", "\"inflation\""}, name);
  const auto fits = [](char sign) { return std::isalnum(static_cast<unsigned char>(sign)) != 0 || sign == '-' || sign == '_'; };
  visitor.check(!name.empty() && std::all_of(name.begin(), name.end(), fits), "name",
                "must be a name of letters, digits, \"-\" and \"_\"");
}

void describe_cells(io::StudyVisitor& visitor, LoadCase& load_case) {
  std::vector<int> cells(load_case.cells.begin(), load_case.cells.end());
  visitor.integers({"cells", "Cells of the body along x, y and z.", "[1, 1, 1]"}, cells, io::within(1, most_cells),
                   {.fewest = 3, .most = 3});
  if (cells.size() == 3) std::copy(cells.begin(), cells.end(), load_case.cells.begin());
  visitor.text({"digits", "One digit for each cell: x varies fastest, then y, then z. 0 is empty, 1 and 2 are phases.", "\"1\""},
               load_case.digits);
  const std::string fault = fault_of(load_case.digits, load_case.cells);
  visitor.check(fault.empty(), "digits", fault);
}

void describe_imposed(io::StudyVisitor& visitor, LoadCase& load_case) {
  const auto add = [&](const io::Key& key) {
    const bool is_imposed = imposed_key(load_case.kind) == key.name;
    std::vector<double> values;
    if (is_imposed) values = load_case.imposed;
    visitor.only_if(is_imposed, kinds_with(key.name), [&] { visitor.numbers(key, values, io::any_number(), {.fewest = 1}); });
    if (is_imposed) load_case.imposed = values;
  };
  add({"displacement_m", "Imposed displacements of the tip or the top.", "[0.001]"});
  add({"angle_rad", "Angles by which the tip is rotated.", "[0.1]"});
  add({"gravity_factor", "Gravity, as a multiple of the earth's gravity.", "[1]"});
}

void describe(io::StudyVisitor& visitor, LoadCase& load_case) {
  describe_name(visitor, load_case);
  visitor.word({"kind", "Kind of the load case.", "\"inflation\""}, load_case.kind, load_case_kind_words());
  describe_cells(visitor, load_case);
  visitor.integer({"level", "Level of the fractal.", "1"}, load_case.level, io::within(1, 10));
  visitor.word(
      {"chambers", "Cells that share one chamber: all cells of a module, or each connected region of cells of one phase.",
       "\"single\""},
      load_case.per_phase, case_chamber_words());
  visitor.number({"cell_edge_m", "Edge of a cell.", "0.01"}, load_case.cell_edge_m, io::positive());
  visitor.number({"wall_thickness_m", "Thickness of every outer wall.", "0.002"}, load_case.wall_thickness_m, io::positive());
  visitor.check(load_case.wall_thickness_m < 0.5 * load_case.cell_edge_m, "wall_thickness_m",
                "must be less than half of cell_edge_m");
  visitor.numbers({"pressures_Pa", "Gauge pressures of all chambers.", "[1000]"}, load_case.pressures_Pa, io::any_number(),
                  {.fewest = 1});
  describe_imposed(visitor, load_case);
}

std::string load_case_text(const LoadCase& load_case) { return io::described_text(load_case); }

LoadCase read_load_case(const io::TomlTable& table) {
  LoadCase load_case;
  io::StudyReader reader(table);
  describe(reader, load_case);
  return load_case;
}

void read_cells(const io::TomlTable& table, LoadCase& load_case) {
  io::StudyReader reader(table);
  describe_cells(reader, load_case);
}

}  // namespace menger::meshes
