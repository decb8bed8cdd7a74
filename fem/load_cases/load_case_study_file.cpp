#include "fem/load_cases/load_case_study_file.h"

#include <algorithm>
#include <functional>
#include <string_view>

#include "fem/inflation/inflation_study_file.h"
#include "io/text/content_hash.h"
#include "meshes/design/design_file.h"
#include "meshes/design/hollow_body_file.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCase;
using meshes::LoadCaseKind;

constexpr int most_states = 1000;

/// The part of a case that a table [body] may give for all; 0: not given.
struct BodyDefaults {
  double cell_edge_m = 0.0;
  double wall_thickness_m = 0.0;
  int level = 1;
  meshes::ChamberLayout chambers = meshes::ChamberLayout::single;
};

BodyDefaults read_body(const io::TomlTable& table, BodyDefaults body) {
  const auto length = [&](std::string_view key, double fallback) {
    return fallback > 0.0 ? table.number_or(key, fallback, io::positive()) : table.number(key, io::positive());
  };
  body.cell_edge_m = length("cell_edge_m", body.cell_edge_m);
  body.wall_thickness_m = length("wall_thickness_m", body.wall_thickness_m);
  if (!(body.wall_thickness_m < 0.5 * body.cell_edge_m))
    throw table.error(table.has("wall_thickness_m") ? "wall_thickness_m" : "cell_edge_m",
                      "the wall must be thinner than half a cell");
  body.level = table.integer_or("level", body.level, io::within(1, 10));
  body.chambers = table.word_or("chambers", body.chambers, meshes::chamber_layout_words());
  return body;
}

LoadCaseElements read_elements(const io::TomlTable& table, LoadCaseElements elements) {
  elements.degree = table.integer_or("degree", elements.degree, io::within(1, 2));
  elements.through_wall = table.integer_or("through_wall", elements.through_wall, io::within(1, 100));
  if (const auto largest_m = table.optional_number("largest_element_m", io::positive())) elements.largest_element_m = largest_m;
  elements.growth = table.number_or("growth", elements.growth, io::at_least(1.0));
  return elements;
}

std::vector<double> ascending(const io::TomlTable& table, std::string_view key, const io::Range& range = io::any_number()) {
  std::vector<double> values = table.numbers(key, range);
  if (values.empty()) throw table.error(key, "must hold at least one value");
  std::sort(values.begin(), values.end());
  if (std::adjacent_find(values.begin(), values.end()) != values.end()) throw table.error(key, "must not hold a value twice");
  return values;
}

void read_pressures(const io::TomlTable& table, CaseRequest& request) {
  const bool given = table.has("pressures_Pa");
  const bool fractions = table.has("pressure_fractions");
  if (given && fractions) throw table.error("pressure_fractions", "pressures_Pa beside them give others: keep one of them");
  if (given) request.load_case.pressures_Pa = ascending(table, "pressures_Pa");
  if (fractions) request.pressure_fractions = ascending(table, "pressure_fractions", io::within(-1.0, 1.0));
  if (!given && !fractions && request.load_case.kind != LoadCaseKind::inflation)
    throw table.error("kind", "needs pressures_Pa or pressure_fractions");
  if (!given && !fractions) request.state_count = table.integer_or("states", request.state_count, io::within(3, most_states));
  if (!given) request.largest_pressure_Pa = table.optional_number("largest_pressure_Pa", io::positive());
}

void read_imposed(const io::TomlTable& table, LoadCase& load_case) {
  const std::string key = meshes::imposed_key(load_case.kind);
  if (key.empty()) return;
  load_case.imposed = ascending(table, key);
  const double length_m = load_case.cell_edge_m * load_case.cells[load_case.kind == LoadCaseKind::press ? 2 : 0];
  const bool shortens = load_case.kind == LoadCaseKind::press || load_case.kind == LoadCaseKind::stretch;
  const double most = load_case.kind == LoadCaseKind::press ? load_case.imposed.back() : -load_case.imposed.front();
  if (shortens && load_case.level == 1 && !(most < length_m)) throw table.error(key, "leaves nothing of the length of the body");
}

using ReadInput = std::function<void(const fs::path&)>;

CaseRequest read_case(const io::TomlTable& table, const BodyDefaults& defaults, const LoadCaseElements& elements,
                      const ReadInput& read_input) {
  CaseRequest request;
  LoadCase& load_case = request.load_case;
  load_case.name = meshes::read_case_name(table);
  load_case.kind = table.word("kind", meshes::load_case_kind_words());
  if (const auto design_file = table.optional_path("design")) {
    for (const char* key : {"cells", "digits"})
      if (table.has(key)) throw table.error(key, "the design gives another body: keep one of them");
    read_input(*design_file);
    const meshes::Polycube body = meshes::read_design(*design_file).body;
    load_case.cells = {body.nx(), body.ny(), body.nz()};
    load_case.digits = body.digits();
  } else {
    meshes::read_cells(table, load_case);
  }
  const BodyDefaults body = read_body(table, defaults);
  load_case.cell_edge_m = body.cell_edge_m;
  load_case.wall_thickness_m = body.wall_thickness_m;
  load_case.level = body.level;
  load_case.per_phase = body.chambers == meshes::ChamberLayout::per_phase;
  request.elements = read_elements(table, elements);
  read_pressures(table, request);
  read_imposed(table, load_case);
  return request;
}

}  // namespace

LoadCaseStudy read_load_case_study(const fs::path& file) {
  const io::TomlTable top = io::read_toml(file);
  LoadCaseStudy study;
  study.file = file;
  const ReadInput read_input = [&](const fs::path& input) { study.inputs[input.string()] = io::file_hash(input); };
  read_input(file);
  study.relative_uncertainty = top.number_or("relative_uncertainty", study.relative_uncertainty, io::positive());
  const io::TomlTable material = top.table("material");
  study.material = read_study_material(material, read_input, study.notes);
  if (!study.material.density_kg_per_m3) throw material.error("law", "needs density_kg_per_m3 beside it");
  BodyDefaults body;
  if (const auto table = top.optional_table("body")) body = read_body(*table, body);
  LoadCaseElements elements;
  if (const auto table = top.optional_table("elements")) elements = read_elements(*table, elements);
  for (const io::TomlTable& table : top.tables("case")) {
    study.cases.push_back(read_case(table, body, elements, read_input));
    const std::string& name = study.cases.back().load_case.name;
    const auto same = [&](const CaseRequest& other) { return other.load_case.name == name; };
    if (std::count_if(study.cases.begin(), study.cases.end(), same) > 1) throw table.error("name", "is given twice");
  }
  top.finish();
  return study;
}

}  // namespace menger::fem
