#include "evolution/trade_off/trade_off_body.h"

#include "meshes/hexahedra/hollow_polycube.h"
#include "meshes/hexahedra/mesh_counts.h"

namespace menger::evolution {

meshes::ChamberLayout chamber_layout(const TradeStudy& study) {
  return study.chambers == "single" ? meshes::ChamberLayout::single : meshes::ChamberLayout::per_phase;
}

meshes::HollowBodyOptions hollow_options(const TradeStudy& study, const ElementFidelity& fidelity) {
  meshes::HollowBodyOptions options;
  options.wall_thickness_m = study.wall_thickness_m;
  options.elements_through_wall = fidelity.elements_through_wall;
  options.chambers = chamber_layout(study);
  options.level = study.level;
  if (fidelity.thin_walls) fem::set_elements({.fidelity = *fidelity.thin_walls}, options);
  return options;
}

ElementCount count_elements(const TradeStudy& study, const ElementFidelity& fidelity) {
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(study.design, hollow_options(study, fidelity)).mesh;
  const meshes::MeshCounts counts = meshes::mesh_counts(mesh);
  return {.elements = counts.elements, .unknowns = 3 * counts.nodes(fidelity.degree)};
}

}  // namespace menger::evolution
