// Bodies and states without a solution.

#include <algorithm>
#include <string>

#include "fem/statics/supports.h"
#include "io/text/input_error.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/chamber_surface.h"
#include "tests/extremes/fem_rows.h"
#include "tests/verification/fem_hollow_cube.h"

namespace menger::extremes {

namespace {

void run_open_chamber(Outcome& outcome) {
  meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(fem::cube_edge_m, fem::cube_wall_m, 1);
  const std::size_t chamber = meshes::label_index(mesh, "chamber 0");
  const auto inner = std::find_if(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) { return face.label == chamber; });
  inner->label = meshes::label_index(mesh, "outer");
  try {
    meshes::require_closed_chambers(mesh, "cube.vtu");
    outcome.expect(false, "taken for closed");
  } catch (const io::InputError& error) {
    const std::string text = error.what();
    outcome.note(text);
    outcome.expect(text.find("cube.vtu: chamber 0 is open: ") == 0, "names file and chamber");
    outcome.expect(text.find("the first at ") != std::string::npos, "says where");
  }
}

/// The middle of the top is moved through the wall, to the floor of the chamber.
void run_inverted_start(Outcome& outcome) {
  const meshes::HexahedralMesh mesh = meshes::hollow_cube_quarter(fem::cube_edge_m, fem::cube_wall_m, 1);
  fem::Model model(mesh, 2, fem::quarter_of_cube());
  const fem::NearestNode node = fem::nearest_node(model.space, fem::cube_top);
  fem::BodyState state = model.equilibrium.rest();
  state.displacements_m[3 * static_cast<std::size_t>(node.local) + 2] = -0.75 * fem::cube_edge_m;
  const std::vector<double> start = state.displacements_m;
  const std::vector<fem::PlenumControl> controls{fem::PressureControl{1e3}};
  const fem::EquilibriumReport inverted = model.equilibrium.solve(state, controls, 1.0);
  outcome.expect_status(inverted.status, io::RunStatus::inverted_element, inverted.reason);
  outcome.expect(state.displacements_m == start, "the state is left as it was");
  fem::BodyState rest = model.equilibrium.rest();
  const fem::EquilibriumReport found = model.equilibrium.solve(rest, controls, 1.0);
  outcome.expect(found.status == io::RunStatus::completed, "the same solver then finds the state from rest");
}

}  // namespace

std::vector<Row> fem_input_rows() {
  std::vector<Row> rows;
  rows.push_back({.name = "chamber that is not closed",
                  .done = "hollow cube with one inner face labelled as an outer one",
                  .expected = "InputError that names file, chamber and place, before anything is computed",
                  .run = run_open_chamber});
  rows.push_back({.name = "inverted start",
                  .done = "search for an equilibrium from a state with a node pushed through the wall",
                  .expected =
                      "inverted_element, since no energy belongs to a negative volume; nothing is changed, and the solver "
                      "stays usable",
                  .run = run_inverted_start});
  return rows;
}

}  // namespace menger::extremes
