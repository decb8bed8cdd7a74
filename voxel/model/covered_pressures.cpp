#include "voxel/model/covered_pressures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meshes/design/modular_body.h"
#include "voxel/model/hollow_voxels.h"

namespace menger::voxel {
namespace {

std::string class_text(std::size_t wall_class, std::size_t gap) {
  constexpr ByGap<std::string_view> cells{"one cell", "two cells", "three cells or more"};
  return "walls " + std::string(cells.at(gap)) + " apart of " + wall_class_text(wall_class);
}

bool has_class(const ByGap<ByWallClass<bool>>& walls, std::size_t wall_class) {
  return std::ranges::any_of(walls, [wall_class](const auto& of_gap) { return of_gap[wall_class]; });
}

/// Calls `found(cell, axis, gap)` for every cell and axis, with the gap between walls that the cell lies in along that axis.
template <class Found>
void visit_gaps(const HollowVoxels& cells, const Found& found) {
  const meshes::Polycube& body = cells.body;
  const std::vector<meshes::CellIndex> occupied = body.occupied();
  const auto place = [&body](const meshes::CellIndex& cell) {
    const int position = cell.x + body.nx() * (cell.y + body.ny() * cell.z);
    return static_cast<std::size_t>(position);
  };
  std::vector<std::size_t> at(body.digits().size());
  for (std::size_t cell = 0; cell < occupied.size(); ++cell) at[place(occupied[cell])] = cell;
  for (const meshes::Side low : {meshes::Side::x_min, meshes::Side::y_min, meshes::Side::z_min}) {
    const std::size_t axis = meshes::axis_of(low);
    const auto high = static_cast<meshes::Side>(2 * axis + 1);
    for (std::size_t first = 0; first < occupied.size(); ++first) {
      if (!cells.walled[first][2 * axis]) continue;
      std::vector<std::size_t> run{first};
      while (!cells.walled[run.back()][2 * axis + 1]) run.push_back(at[place(meshes::neighbour(occupied[run.back()], high))]);
      for (const std::size_t cell : run) found(cell, axis, std::min(run.size(), gap_count) - 1);
    }
  }
}

}  // namespace

BodyWalls body_walls(const meshes::Polycube& basal_body, int level, meshes::ChamberLayout chambers) {
  // Which sides have a wall does not depend on how thick it is.
  const HollowVoxels cells =
      hollow_voxels(basal_body, {.cell_edge_m = 1.0, .wall_thickness_m = 0.25, .voxels_per_cell = 1, .chambers = chambers});
  BodyWalls walls;
  walls.has_joints = level > 1 || cells.chamber_count > 1;
  visit_gaps(cells, [&](std::size_t cell, std::size_t axis, std::size_t gap) {
    const std::size_t wall_class = cells.wall_class[cell][axis];
    walls.facing[gap][wall_class] = true;
    if (wall_class_of(cells.bulge_class[cell][axis]) == wall_class) walls.as_wide[gap][wall_class] = true;
  });
  return walls;
}

BodyWalls body_walls(const meshes::LoadCase& load_case) {
  const auto& [nx, ny, nz] = load_case.cells;
  return body_walls(meshes::Polycube::from_digits(nx, ny, nz, load_case.digits), load_case.level,
                    load_case.per_phase ? meshes::ChamberLayout::per_phase : meshes::ChamberLayout::single);
}

BodyWalls all_walls(bool has_joints) {
  BodyWalls walls;
  for (auto* const of_gaps : {&walls.facing, &walls.as_wide}) {
    for (auto& of_gap : *of_gaps) of_gap.fill(true);
  }
  walls.has_joints = has_joints;
  return walls;
}

bool CoveredPressures::contains(double pressure_Pa) const {
  constexpr double rounding = 1e-9;
  const double slack = rounding * (std::abs(lowest_Pa) + std::abs(highest_Pa));
  return pressure_Pa >= lowest_Pa - slack && pressure_Pa <= highest_Pa + slack;
}

CoveredPressures covered_pressures(const ValidityRange& validity, const BodyWalls& walls) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  CoveredPressures covered{.lowest_Pa = -unlimited, .highest_Pa = unlimited, .lowest_by = {}, .highest_by = {}};
  const auto end_below = [&covered](double lowest_Pa, const std::string& by) {
    if (lowest_Pa <= covered.lowest_Pa) return;
    covered.lowest_Pa = lowest_Pa;
    covered.lowest_by = by;
  };
  const auto end_above = [&covered](double highest_Pa, const std::string& by) {
    if (highest_Pa >= covered.highest_Pa) return;
    covered.highest_Pa = highest_Pa;
    covered.highest_by = by;
  };
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    for (std::size_t gap = 0; gap < gap_count; ++gap) {
      if (walls.facing[gap][c]) end_below(validity.lowest_pressure_Pa[gap][c], class_text(c, gap));
    }
    if (has_class(walls.facing, c)) end_above(validity.highest_pressure_Pa[c], wall_class_text(c));
  }
  if (walls.has_joints) {
    end_below(validity.lowest_joint_pressure_Pa, "joints");
    end_above(validity.highest_joint_pressure_Pa, "joints");
  }
  return covered;
}

void cover(ValidityRange& validity, const BodyWalls& walls, double lowest_Pa, double highest_Pa) {
  const auto lower = [lowest_Pa](double& end) { end = std::min(end, lowest_Pa); };
  const auto raise = [highest_Pa](double& end) { end = std::max(end, highest_Pa); };
  for (std::size_t c = 0; c < wall_class_count; ++c) {
    for (std::size_t gap = 0; gap < gap_count; ++gap) {
      if (!walls.as_wide[gap][c]) continue;
      for (std::size_t as_wide = gap; as_wide < gap_count; ++as_wide) lower(validity.lowest_pressure_Pa[as_wide][c]);
    }
    if (has_class(walls.as_wide, c)) raise(validity.highest_pressure_Pa[c]);
  }
  if (!walls.has_joints) return;
  lower(validity.lowest_joint_pressure_Pa);
  raise(validity.highest_joint_pressure_Pa);
}

}  // namespace menger::voxel
