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

/// The pressure behind a wall less that in front of it.
double net_pressure_Pa(const PressedWall& wall, const std::vector<double>& plenum_pressures_Pa) {
  double pressure_Pa = 0.0;
  for (std::size_t side = 0; side < 2; ++side)
    if (wall.plena[side] >= 0)
      pressure_Pa += PressedWalls::sign(side) * plenum_pressures_Pa[static_cast<std::size_t>(wall.plena[side])];
  return pressure_Pa;
}

/// @param pressure_Pa behind the wall less that in front of it
Point rise_at(const Space& space, const PressedWall& wall, const LocatedPoint& point, const BoxNumbers& u, double pressure_Pa) {
  const Point& low = space.positions[static_cast<std::size_t>(point.nodes.front())];
  Point place{};
  for (std::size_t i = 0; i < 3; ++i) place[i] = std::clamp((point.point.position[i] - low[i]) / wall.edges_m[i], 0.0, 1.0);
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
  const Space& space = assembly.space();
  for (std::size_t p = 0; p < points.size(); ++p) {
    Point rise_m{};
    if (const PressedWall* wall = wall_of(assembly, points[p])) {
      rise_m = rise_at(space, *wall, points[p], corner_displacements(space, wall->element, state.displacements_m),
                       net_pressure_Pa(*wall, state.plenum_pressures_Pa));
    }
    MPI_Bcast(rise_m.data(), 3, MPI_DOUBLE, points[p].rank, assembly.space().communicator);
    observations[p].displacement_m = sum(observations[p].displacement_m, rise_m);
  }
}

WallRiseSlopes wall_rise_slopes(const Assembly& assembly, const LocatedPoint& point, const BodyState& state) {
  WallRiseSlopes slopes;
  const PressedWall* wall = wall_of(assembly, point);
  if (wall == nullptr) return slopes;
  const Space& space = assembly.space();
  const BoxNumbers u = corner_displacements(space, wall->element, state.displacements_m);
  const double pressure_Pa = net_pressure_Pa(*wall, state.plenum_pressures_Pa);
  // Central differences: the rise is a smooth function of shapes of the size of the edges.
  const double step_m = 1e-5 * *std::min_element(wall->edges_m.begin(), wall->edges_m.end());
  for (std::size_t component = 0; component < u.size(); ++component) {
    std::array<Point, 2> rises_m{};
    for (std::size_t side = 0; side < 2; ++side) {
      BoxNumbers moved = u;
      moved[component] += side == 0 ? -step_m : step_m;
      rises_m[side] = rise_at(space, *wall, point, moved, pressure_Pa);
    }
    for (std::size_t i = 0; i < 3; ++i) slopes.by_displacement[i][component] = (rises_m[1][i] - rises_m[0][i]) / (2.0 * step_m);
  }
  const double net = net_pressure_Pa(*wall, std::vector<double>(state.plenum_pressures_Pa.size(), 1.0));
  slopes.by_pressure_m_per_Pa =
      difference(rise_at(space, *wall, point, u, pressure_Pa + net), rise_at(space, *wall, point, u, pressure_Pa));
  return slopes;
}

}  // namespace menger::fem
