#include "fem/inflation/wall_points.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "fem/statics/thin_wall_groups.h"
#include "fem/thin_walls/wall_rise.h"

namespace menger::fem {
namespace {

/// The wall that has a point, by its nodes; nullptr where it is no wall beside a chamber, or not of this rank.
const PressedWall* wall_of(const Assembly& assembly, const LocatedPoint& point) {
  if (point.nodes.empty()) return nullptr;
  const std::vector<Index>& nodes = assembly.space().element_nodes;
  for (const PressedWall& wall : assembly.walls().walls())
    if (std::equal(point.nodes.begin(), point.nodes.end(), nodes.begin() + 8 * static_cast<std::ptrdiff_t>(wall.element)))
      return &wall;
  return nullptr;
}

Point rise_at(const Assembly& assembly, const PressedWall& wall, const LocatedPoint& point, const BodyState& state) {
  const Space& space = assembly.space();
  const BoxNumbers u = corner_displacements(space, wall.element, state.displacements_m);
  const Point& low = space.positions[static_cast<std::size_t>(point.nodes.front())];
  Point place{};
  for (std::size_t i = 0; i < 3; ++i) place[i] = std::clamp((point.point.position[i] - low[i]) / wall.edges_m[i], 0.0, 1.0);
  double pressure_Pa = 0.0;  // behind the wall less that in front
  for (std::size_t side = 0; side < 2; ++side)
    if (wall.plena[side] >= 0)
      pressure_Pa += PressedWalls::sign(side) * state.plenum_pressures_Pa[static_cast<std::size_t>(wall.plena[side])];
  std::array<double, 2> rises_m = wall_bending_rises_m(wall.edges_m, wall.normal, u);
  // of the bulge, in which each axis carries all of the load, the share of an axis is as the square of its edge
  const std::array<double, 2> edges_m{wall.edges_m[(wall.normal + 1) % 3], wall.edges_m[(wall.normal + 2) % 3]};
  const double squares = edges_m[0] * edges_m[0] + edges_m[1] * edges_m[1];
  for (std::size_t n = 0; n < 2; ++n)
    rises_m[n] += 0.5 * pressure_Pa * wall.shear_bulge_m3_per_Pa * edges_m[n] / (edges_m[1 - n] * squares);
  return wall_rise_m(wall.edges_m, wall.normal, u, place, rises_m);
}

}  // namespace

void add_wall_rises(const Assembly& assembly, const std::vector<LocatedPoint>& points, const BodyState& state,
                    std::vector<PointObservation>& observations) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    Point rise_m{};
    if (const PressedWall* wall = wall_of(assembly, points[p])) rise_m = rise_at(assembly, *wall, points[p], state);
    MPI_Bcast(rise_m.data(), 3, MPI_DOUBLE, points[p].rank, assembly.space().communicator);
    observations[p].displacement_m = sum(observations[p].displacement_m, rise_m);
  }
}

}  // namespace menger::fem
