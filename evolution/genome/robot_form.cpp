#include "evolution/genome/robot_form.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace menger::evolution {
namespace {

using meshes::CellIndex;
using meshes::Polycube;

/// Returns a cell of a square grid after a reflection in x, if asked for, and then `quarters` quarter turns about the vertical.
CellIndex turned(CellIndex cell, int side, int quarters, bool is_mirrored) {
  if (is_mirrored) cell.x = side - 1 - cell.x;
  for (int quarter = 0; quarter < quarters; ++quarter) cell = {side - 1 - cell.y, cell.x, cell.z};
  return cell;
}

/// Returns the digits of the body, moved to the corner of its grid.
std::string digits_at_corner(const Polycube& body, const std::vector<CellIndex>& cells, bool with_materials,
                             const std::vector<meshes::Material>& materials) {
  CellIndex low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  for (const CellIndex& cell : cells) low = {std::min(low.x, cell.x), std::min(low.y, cell.y), std::min(low.z, cell.z)};
  Polycube moved(body.nx(), body.ny(), body.nz());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const CellIndex& cell = cells[n];
    moved.set({cell.x - low.x, cell.y - low.y, cell.z - low.z}, with_materials ? materials[n] : meshes::Material{1});
  }
  return moved.digits();
}

}  // namespace

Polycube standing(const Polycube& body) {
  const std::vector<CellIndex> cells = body.occupied();
  if (cells.empty()) return body;
  const int lowest = std::ranges::min(cells, {}, &CellIndex::z).z;
  Polycube moved(body.nx(), body.ny(), body.nz());
  for (const CellIndex& cell : cells) moved.set({cell.x, cell.y, cell.z - lowest}, body.at(cell));
  return moved;
}

Phenotype standing(const Phenotype& phenotype) {
  // A cell of an aggregate is 9 a + 3 b + c, with a, b, c cells of the three arrays. If each array is moved down, so is the
  // aggregate.
  return {standing(phenotype.body), standing(phenotype.arrangement), standing(phenotype.arrangement_of_arrangements)};
}

std::vector<std::string> robot_poses(const Polycube& body, const Distinction& distinction) {
  assert(body.nx() == body.ny());
  const std::vector<CellIndex> cells = body.occupied();
  std::vector<meshes::Material> materials;
  materials.reserve(cells.size());
  for (const CellIndex& cell : cells) materials.push_back(body.at(cell));
  if (distinction.place) return {standing(body).digits()};
  std::vector<std::string> poses;
  for (const bool is_mirrored : {false, true}) {
    for (int quarters = 0; quarters < 4; ++quarters) {
      std::vector<CellIndex> now;
      now.reserve(cells.size());
      for (const CellIndex& cell : cells) now.push_back(turned(cell, body.nx(), quarters, is_mirrored));
      poses.push_back(digits_at_corner(body, now, distinction.materials, materials));
    }
  }
  return poses;
}

std::string robot_form(const Polycube& body, const Distinction& distinction) {
  return std::ranges::min(robot_poses(body, distinction));
}

}  // namespace menger::evolution
