#include "voxel/statics/load_case_response.h"

#include <algorithm>
#include <string>

#include "io/text/number_text.h"
#include "voxel/statics/body_shape.h"
#include "voxel/statics/load_case_body.h"
#include "voxel/statics/load_case_ordinates.h"

namespace menger::voxel {
namespace {

using meshes::LoadCase;
using meshes::LoadCaseKind;

/// Names the wall class whose law ends before a pressure.
std::string beyond_laws(const StaticBody& body, double pressure_Pa) {
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    if (!body.has_class[c]) continue;
    for (const PressureLaw& law : {body.parameters.extension[c], body.parameters.bulge[c]}) {
      if (!law.has_value(pressure_Pa)) {
        return wall_class_text(c) + " have no equilibrium at pressure_Pa = " + io::number_text(pressure_Pa);
      }
    }
  }
  return "beams of a class have no positive rest length at pressure_Pa = " + io::number_text(pressure_Pa);
}

std::string contact_text(const StaticBody& body, const BodyShape::WallContact& contact) {
  const auto& [x, y, z] = body.lattice.cells[contact.voxel];
  return std::string("chamber walls across ") + "xyz"[contact.axis] + " meet at voxel " + std::to_string(x) + ", " +
         std::to_string(y) + ", " + std::to_string(z);
}

}  // namespace

LoadCaseResponse respond(const SurrogateParameters& parameters, const LoadCase& load_case,
                         const std::vector<std::vector<double>>& states) {
  return visit_states(parameters, load_case, states, [](std::size_t, const Equilibrium&) {});
}

LoadCaseResponse visit_states(const SurrogateParameters& parameters, const LoadCase& load_case,
                              const std::vector<std::vector<double>>& states, const StateVisitor& visit) {
  const LoadCaseKind kind = load_case.kind;
  const StaticBody body = load_case_body(parameters, load_case);
  Equilibrium equilibrium(body, load_case_supports(kind));
  LoadCaseResponse response;
  response.columns = meshes::response_columns(load_case);
  response.values.resize(response.columns.size());
  for (const std::vector<double>& state : states.empty() ? load_case_states(load_case) : states) {
    response.status = equilibrium.load(load_case_loads(kind, body, state));
    if (response.status == io::RunStatus::limit_point) response.reason = beyond_laws(body, state.front());
    if (response.status != io::RunStatus::completed) return response;
    if (const auto contact = BodyShape(equilibrium).wall_contact()) {
      response.status = io::RunStatus::wall_contact;
      response.reason = contact_text(body, *contact);
      return response;
    }
    std::vector<double> row(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(meshes::abscissa_count(kind)));
    const std::vector<double> ordinates = load_case_ordinates(response.columns, kind, equilibrium);
    if (ordinates.empty()) {
      response.status = io::RunStatus::limit_point;
      response.reason = "the equilibrium is not stable";
      return response;
    }
    row.insert(row.end(), ordinates.begin(), ordinates.end());
    for (std::size_t i = 0; i < row.size(); ++i) response.values[i].push_back(row[i]);
    for (std::size_t beam = 0; beam < body.beams.size(); ++beam) {
      const double strain = equilibrium.axial_strain(beam);
      response.smallest_strain = std::min(response.smallest_strain, strain);
      response.largest_strain = std::max(response.largest_strain, strain);
    }
    visit(response.values.front().size() - 1, equilibrium);
  }
  return response;
}

}  // namespace menger::voxel
