#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "fem/space/space.h"
#include "fem/statics/body.h"
#include "meshes/hexahedra/element_geometry.h"
#include "meshes/hexahedra/hexahedral_mesh.h"

namespace menger::fem {

/// Labels of the meshes below: the six sides of the box, and the surface of what is left out.
enum SampleLabel : std::size_t { x_min, x_max, y_min, y_max, z_min, z_max, chamber };

/// A box of cells between grid lines, without those for which `is_air` says so.
/// @param is_air of the indices of a cell in each direction
inline meshes::HexahedralMesh box_of_cells(const std::array<std::vector<double>, 3>& lines,
                                           const std::function<bool(const std::array<std::size_t, 3>&)>& is_air) {
  meshes::HexahedralMesh mesh;
  mesh.label_names = {"x min", "x max", "y min", "y max", "z min", "z max", "chamber 0"};
  mesh.region_names = {"wall"};
  mesh.plenum_names = {"plenum 0"};
  mesh.chambers.push_back({"chamber 0", {chamber}, {}, 0});
  std::map<std::array<std::size_t, 3>, std::size_t> known;
  const auto corner = [&](const std::array<std::size_t, 3>& at) {
    const auto [place, is_new] = known.try_emplace(at, mesh.points.size());
    if (is_new) mesh.points.push_back({lines[0][at[0]], lines[1][at[1]], lines[2][at[2]]});
    return place->second;
  };
  for (std::size_t k = 0; k + 1 < lines[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < lines[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < lines[0].size(); ++i) {
        const std::array<std::size_t, 3> cell{i, j, k};
        if (is_air(cell)) continue;
        meshes::ElementCorners corners{};
        for (std::size_t c = 0; c < 8; ++c) corners[c] = corner({i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)});
        mesh.elements.push_back(corners);
        mesh.regions.push_back(0);
        for (std::size_t side = 0; side < 6; ++side) {
          const std::size_t axis = side / 2;
          const bool is_last = side % 2 == 1;
          const bool is_outside = cell[axis] + (is_last ? 2 : 0) == (is_last ? lines[axis].size() : 0);
          std::array<std::size_t, 3> neighbour = cell;
          if (!is_outside) {
            neighbour[axis] = is_last ? cell[axis] + 1 : cell[axis] - 1;
            if (!is_air(neighbour)) continue;
          }
          mesh.faces.push_back({meshes::face_of_element(corners, side), is_outside ? side : static_cast<std::size_t>(chamber)});
        }
      }
    }
  }
  return mesh;
}

/// A quarter (x, y >= 0) of a hollow cube of edge 8 mm about the z axis, walls 2 mm thick, in cubes of 2 mm: 14 elements.
inline meshes::HexahedralMesh hollow_cube_quarter() {
  const std::vector<double> across{0.0, 2e-3, 4e-3};
  return box_of_cells({across, across, {0.0, 2e-3, 4e-3, 6e-3, 8e-3}},
                      [](const auto& cell) { return cell[0] == 0 && cell[1] == 0 && (cell[2] == 1 || cell[2] == 2); });
}

/// The same cube as a whole.
inline meshes::HexahedralMesh hollow_cube() {
  const std::vector<double> lines{0.0, 2e-3, 4e-3, 6e-3, 8e-3};
  return box_of_cells({lines, lines, lines}, [](const auto& cell) {
    return std::all_of(cell.begin(), cell.end(), [](std::size_t at) { return at == 1 || at == 2; });
  });
}

/// A quarter of a flat box of 20 x 20 x 5 mm with walls of 1 mm: its upper and lower wall meet under vacuum.
inline meshes::HexahedralMesh flat_box_quarter() {
  const std::vector<double> across{0.0, 4.5e-3, 9e-3, 10e-3};
  return box_of_cells({across, across, {0.0, 1e-3, 4e-3, 5e-3}},
                      [](const auto& cell) { return cell[0] < 2 && cell[1] < 2 && cell[2] == 1; });
}

/// A body of one nearly incompressible material with one chamber, a quarter whose planes x = 0 and y = 0 are planes of symmetry,
/// held along z at its lower side.
inline Body quarter_body(const materials::HyperelasticLaw& law = materials::NeoHookean{50e3}) {
  Body body;
  body.regions = {{law, materials::SimoTaylorVolume{2.5e6}, 1000.0}};
  body.chambers = {{{chamber}, 0}};
  body.plenum_count = 1;
  body.supports = {{x_min, {true, false, false}}, {y_min, {false, true, false}}, {z_min, {false, false, true}}};
  return body;
}

}  // namespace menger::fem
