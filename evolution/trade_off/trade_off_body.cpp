#include "evolution/trade_off/trade_off_body.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::evolution {
namespace {

std::uint64_t edge_count(const meshes::HexahedralMesh& mesh) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  edges.reserve(12 * mesh.elements.size());
  for (const meshes::ElementCorners& corners : mesh.elements) {
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
      for (const std::size_t step : {1U, 2U, 4U}) {
        if ((corner & step) == 0) edges.push_back(std::minmax({corners.at(corner), corners.at(corner + step)}));
      }
    }
  }
  std::ranges::sort(edges);
  return static_cast<std::uint64_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
}

}  // namespace

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
  ElementCount count{.elements = mesh.elements.size(), .unknowns = 3 * mesh.points.size()};
  if (fidelity.degree == 2) {
    const std::uint64_t faces = (6 * mesh.elements.size() + mesh.faces.size()) / 2;  // inner ones belong to two elements
    count.unknowns += 3 * (edge_count(mesh) + faces + mesh.elements.size());
  }
  return count;
}

}  // namespace menger::evolution
