#include "fem/load_cases/load_case_study_file.h"

#include <algorithm>
#include <string_view>

#include "io/study/study_reader.h"
#include "io/text/content_hash.h"
#include "meshes/design/design_file.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {
namespace {

namespace fs = std::filesystem;
using meshes::LoadCase;
using meshes::LoadCaseKind;

constexpr int most_states = 1000;

/// Describes the keys of a body. Lengths must be given here unless they are given for all cases.
void describe(io::StudyVisitor& visitor, CaseBody& body) {
  const auto length = [&](std::string_view name, std::string_view help, std::string_view example, double& value) {
    visitor.number({.name = name, .help = help, .example = value > 0.0 ? "" : example, .may_be_elsewhere = true}, value,
                   io::positive());
  };
  length("cell_edge_m", "Edge of a cell.", "0.01", body.cell_edge_m);
  length("wall_thickness_m", "Thickness of every outer wall.", "0.002", body.wall_thickness_m);
  const io::TomlTable* table = visitor.source();
  visitor.check(body.wall_thickness_m < 0.5 * body.cell_edge_m,
                table != nullptr && !table->has("wall_thickness_m") ? "cell_edge_m" : "wall_thickness_m",
                "the wall must be thinner than half a cell");
  visitor.integer({"level", "Level of the fractal."}, body.level, io::within(1, 10));
  visitor.word({"chambers", "Whether all cells of a module share one chamber, or those of each phase."}, body.per_phase,
               meshes::case_chamber_words());
}

/// Describes the keys of elements. @param kind_key name of the key of their kind: that of a case is the kind of its load
/// @param condition for people: what says that the elements are three-field elements
void describe(io::StudyVisitor& visitor, LoadCaseElements& elements, std::string_view kind_key, std::string_view condition) {
  describe(visitor, elements.choice, false, kind_key);
  visitor.only_if(!elements.has_thin_walls(), condition, [&] {
    visitor.integer({"degree", "Degree of the displacements: 1 is Q1/P0, 2 is Q2/P1."}, elements.degree, io::within(1, 2));
    visitor.integer({"through_wall", "Least number of elements through a wall."}, elements.through_wall, io::within(1, 100));
    visitor.optional_number(
        {"largest_element_m",
         "Edge that elements may grow to away from walls. If it is not given: with degree = 2 and through_wall = 1 the span "
         "between two walls, where that takes no fewer elements; otherwise the edge in the wall.",
         "0.005"},
        elements.largest_element_m, io::positive());
    visitor.number({"growth", "Largest ratio of neighbouring edges while they grow; 1: all are equal."}, elements.growth,
                   io::at_least(1.0));
  });
}

/// Describes a list of values in any order, without repetitions. The values are sorted.
void describe_ascending(io::StudyVisitor& visitor, const io::Key& key, std::vector<double>& values,
                        const io::Range& range = io::any_number()) {
  visitor.numbers(key, values, range, {.fewest = 1});
  std::sort(values.begin(), values.end());
  visitor.check(std::adjacent_find(values.begin(), values.end()) == values.end(), key.name, "must not hold a value twice");
}

void describe_design_file(io::StudyVisitor& visitor, CaseRequest& request) {
  fs::path file;
  visitor.path({"design", "A design file. Its cell edge is not used.", "\"design.toml\""}, file);
  if (visitor.source() == nullptr) return;
  const meshes::Polycube body = visitor.source()->reading("design", [&] { return meshes::read_design(file).body; });
  request.load_case.cells = {body.nx(), body.ny(), body.nz()};
  request.load_case.digits = body.digits();
  request.design_file = file;
}

/// Describes the body of a case.
/// @param has_body whether the case has a body already
void describe_body(io::StudyVisitor& visitor, CaseRequest& request, bool has_body) {
  LoadCase& load_case = request.load_case;
  const auto keep = [] {};
  visitor.one_of({{"digits", has_body, keep, [&] { meshes::describe_cells(visitor, load_case); }},
                  {"design", false, keep, [&] { describe_design_file(visitor, request); }}},
                 "give a body");
  CaseBody body{load_case.cell_edge_m, load_case.wall_thickness_m, load_case.level, load_case.per_phase};
  describe(visitor, body);
  load_case.cell_edge_m = body.cell_edge_m;
  load_case.wall_thickness_m = body.wall_thickness_m;
  load_case.level = body.level;
  load_case.per_phase = body.per_phase;
}

void describe_pressures(io::StudyVisitor& visitor, CaseRequest& request) {
  std::vector<double>& pressures_Pa = request.load_case.pressures_Pa;
  std::vector<double>& fractions = request.pressure_fractions;
  const bool finds_its_own = request.load_case.kind == LoadCaseKind::inflation && pressures_Pa.empty() && fractions.empty();
  std::vector<io::Alternative> alternatives{
      {"pressures_Pa", !pressures_Pa.empty(), [&] { fractions.clear(); },
       [&] {
         describe_ascending(visitor, {"pressures_Pa", "Gauge pressures of all chambers.", "[0, 1000]"}, pressures_Pa);
       }},
      {"pressure_fractions", !fractions.empty(), [&] { pressures_Pa.clear(); },
       [&] {
         describe_ascending(
             visitor,
             {"pressure_fractions",
              "Pressures as fractions. Negative: of that at which walls touch; positive: of the safe part of the limit pressure.",
              "[0, 0.5]"},
             fractions, io::within(-1.0, 1.0));
       }}};
  if (request.load_case.kind == LoadCaseKind::inflation) {
    const auto find_own = [&] {
      pressures_Pa.clear();
      fractions.clear();
    };
    alternatives.push_back({"states", finds_its_own, find_own, [&] {
                              visitor.integer(
                                  {"states", "Number of pressures. The inflation finds their values, on three-field elements."},
                                  request.state_count, io::within(3, most_states));
                            }});
  }
  visitor.one_of(alternatives, "give its pressures, because this load case is not an inflation");
  visitor.only_if(pressures_Pa.empty(), "pressures that are searched for", [&] {
    visitor.optional_number({"largest_pressure_Pa", "The limit pressure is searched for up to this pressure.", "20000"},
                            request.largest_pressure_Pa, io::positive());
  });
}

/// Checks that pressures are given where the elements do not find their range well: thin walls of 2 mm on a cell of 10 mm have a
/// limit pressure that is 1 to 12 % too high, and touch under a vacuum 11 % smaller to 24 % larger, or buckle before.
void check_range(const io::StudyVisitor& visitor, const CaseRequest& request) {
  visitor.check(!request.elements.has_thin_walls() || !request.load_case.pressures_Pa.empty(),
                request.pressure_fractions.empty() ? "states" : "pressure_fractions",
                "thin walls do not find well where walls touch or a limit point is: give pressures_Pa, or choose element_kind = "
                "\"three_field\"");
}

/// Checks that the imposed displacement leaves a body of level 1 a positive length.
void check_length(const io::StudyVisitor& visitor, const LoadCase& load_case) {
  if (load_case.imposed.empty() || load_case.level > 1) return;
  const bool is_press = load_case.kind == LoadCaseKind::press;
  if (!is_press && load_case.kind != LoadCaseKind::stretch) return;
  const meshes::CellBox box = meshes::occupied_box(load_case.cells, load_case.digits);
  const double length_m = load_case.cell_edge_m * box.size[is_press ? 2 : 0];
  const double most_m = is_press ? load_case.imposed.back() : -load_case.imposed.front();
  visitor.check(most_m < length_m, "displacement_m", "must shorten the body by less than its length");
}

void describe(io::StudyVisitor& visitor, CaseRequest& request, const LoadCaseStudy& study) {
  LoadCase& load_case = request.load_case;
  const bool is_new = load_case.cell_edge_m == 0.0;
  if (is_new) {
    const CaseBody body = study.body.value_or(CaseBody{});
    load_case.cell_edge_m = body.cell_edge_m;
    load_case.wall_thickness_m = body.wall_thickness_m;
    load_case.level = body.level;
    load_case.per_phase = body.per_phase;
    request.elements = study.elements;
  }
  meshes::describe_name(visitor, load_case);
  const auto same = [&](const CaseRequest& other) { return other.load_case.name == load_case.name; };
  visitor.check(std::count_if(study.cases.begin(), study.cases.end(), same) <= 1, "name", "is given twice");
  visitor.word({"kind", "What is done to the body.", "\"inflation\""}, load_case.kind, meshes::load_case_kind_words());
  describe_body(visitor, request, !is_new);
  describe(visitor, request.elements, "element_kind", "element_kind = \"three_field\"");
  describe_pressures(visitor, request);
  check_range(visitor, request);
  meshes::describe_imposed(visitor, load_case);
  std::sort(load_case.imposed.begin(), load_case.imposed.end());
  visitor.check(std::adjacent_find(load_case.imposed.begin(), load_case.imposed.end()) == load_case.imposed.end(),
                meshes::imposed_key(load_case.kind), "must not hold a value twice");
  check_length(visitor, load_case);
}

}  // namespace

void describe(io::StudyVisitor& visitor, LoadCaseStudy& study) {
  visitor.number(
      {"relative_uncertainty", "Uncertainty of every ordinate divided by its largest magnitude, where nothing better is known."},
      study.relative_uncertainty, io::positive());
  const io::TomlTable* table = visitor.source();
  visitor.check(table == nullptr || !table->has("material"), "material",
                "its keys are now at the top of the file, without a table: silicone = ...");
  describe(visitor, study.material);
  visitor.check(study.material.density_kg_per_m3.has_value(), "law", "also needs density_kg_per_m3");
  visitor.optional_table({"body", "The body of cases that give none of their own."}, study.body,
                         [&](CaseBody& body) { describe(visitor, body); });
  visitor.table({"elements", "The finite elements of cases that give none of their own."},
                [&] { describe(visitor, study.elements, "kind", "elements.kind = \"three_field\""); });
  visitor.tables({"case", "The load cases."}, study.cases, [&](CaseRequest& request) { describe(visitor, request, study); },
                 {.fewest = 1});
}

LoadCaseStudy read_load_case_study(const fs::path& file) {
  LoadCaseStudy study;
  study.file = file;
  const io::TomlTable top = io::read_toml(file);
  io::read_described(top, study);
  io::note_input(study.inputs, file);
  if (study.material.file) io::note_input(study.inputs, *study.material.file);
  for (const CaseRequest& request : study.cases) {
    if (request.design_file) io::note_input(study.inputs, *request.design_file);
  }
  for (CaseRequest& request : study.cases) request.elements = meant_elements(request);
  study.notes = study.material.notes;
  return study;
}

}  // namespace menger::fem
