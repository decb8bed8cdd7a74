#include "fem/load_cases/load_case_study.h"

#include "fem/inflation/inflation_study_words.h"
#include "io/text/number_text.h"
#include "io/text/toml_text.h"
#include "materials/laws/law_file.h"
#include "meshes/design/fractal.h"
#include "meshes/hexahedra/grid_lines.h"
#include "meshes/load_cases/load_case_file.h"

namespace menger::fem {

std::string elements_text(const LoadCaseElements& elements) {
  if (elements.has_thin_walls()) return "finite elements, thin walls, " + std::string(to_string(elements.choice.fidelity));
  std::string text = std::string("finite elements, ") + (elements.degree == 1 ? "Q1/P0" : "Q2/P1") + ", " +
                     std::to_string(elements.through_wall) + " through the wall";
  if (elements.largest_element_m) text += ", largest " + io::number_text(*elements.largest_element_m) + " m";
  return text;
}

LoadCaseElements meant_elements(const CaseRequest& request) {
  LoadCaseElements elements = request.elements;
  if (elements.has_thin_walls() || elements.largest_element_m || elements.degree != 2 || elements.through_wall != 1)
    return elements;
  const double wall_m = request.load_case.wall_thickness_m;
  const double span_m = request.load_case.cell_edge_m - 2.0 * wall_m;
  const std::size_t graded = meshes::graded_edges(span_m, wall_m, elements.growth, span_m).size();
  if (graded >= meshes::equal_edges(span_m, wall_m).size()) elements.largest_element_m = span_m;
  return elements;
}

meshes::BodyTop top_of(const meshes::LoadCase& load_case) {
  const auto& [nx, ny, nz] = load_case.cells;
  const meshes::Polycube module = meshes::Polycube::from_digits(nx, ny, nz, load_case.digits);
  std::vector<std::array<int, 3>> cells;
  for (const auto& [x, y, z] : meshes::fractal(module, load_case.level).occupied()) cells.push_back({x, y, z});
  return meshes::top_of(cells);
}

std::string case_text(const CaseRequest& request, const StudyMaterial& material) {
  meshes::LoadCase nameless = request.load_case;
  nameless.name = "case";
  io::TomlText text;
  text.lines(meshes::load_case_text(nameless));
  for (const double fraction : request.pressure_fractions) text.add("pressure_fraction", fraction);
  if (nameless.pressures_Pa.empty()) {
    text.add("states", request.state_count);
    if (request.largest_pressure_Pa) text.add("largest_pressure_Pa", *request.largest_pressure_Pa);
  }
  if (nameless.kind == meshes::LoadCaseKind::inflation && top_of(nameless).is_open) {
    // Earlier versions measured the top of such bodies at a corner of the mesh. Their curves are computed anew.
    text.line("top beside its open middle");
  }
  const std::string more =
      request.elements.has_thin_walls() ? text_of(constants_of_equilibria) : "growth " + io::number_text(request.elements.growth);
  text.line(elements_text(request.elements) + ", " + more);
  text.line(materials::law_line(material.law));
  text.line(std::string(volumetric_word(material.volume)) + " " + io::number_text(bulk_modulus_of(material.volume)));
  text.add("density_kg_m3", material.density_kg_per_m3.value_or(0.0));
  return text.text();
}

}  // namespace menger::fem
