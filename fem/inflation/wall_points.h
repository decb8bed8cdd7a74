#pragma once

#include <array>
#include <vector>

#include "fem/inflation/observables.h"
#include "fem/statics/equilibrium.h"
#include "fem/thin_walls/thin_wall_stiffness.h"

namespace menger::fem {

/// Adds to the displacements of points of a body of thin walls by how far the walls stand out there from their corners (see
/// wall_rise_m). The middle of a cell's face lies on a node with an even number of elements between the walls, else not: without
/// this it would seem to move less by a tenth. Collective.
void add_wall_rises(const Assembly& assembly, const std::vector<LocatedPoint>& points, const BodyState& state,
                    std::vector<PointObservation>& observations);

/// How the rise of a point (see add_wall_rises) follows small changes about a state. All zero where the point lies in no wall
/// beside a chamber of this rank.
struct WallRiseSlopes {
  std::array<BoxNumbers, 3> by_displacement{};  ///< per direction: by each component of each corner of the point's element
  Point by_pressure_m_per_Pa{};                 ///< by 1 Pa more in all plena, at the same displacements
};

WallRiseSlopes wall_rise_slopes(const Assembly& assembly, const LocatedPoint& point, const BodyState& state);

}  // namespace menger::fem
