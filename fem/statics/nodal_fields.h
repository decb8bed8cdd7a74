#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/elements/element_state.h"
#include "fem/statics/assembly.h"

namespace menger::fem {

/// The fields of a state at the nodes of a rank, ghosts included, and its elements.
///
/// Deformation gradient and Cauchy stress are given at the nodes: in each element, polynomials through the values at the
/// quadrature points are evaluated at the nodes, and a node takes the mean over its elements, across ranks and regions. The
/// values are unreliable near re-entrant edges, where the exact fields are not bounded, and between regions, where stresses jump.
struct NodalFields {
  std::vector<std::array<double, 9>> deformation_gradient;  ///< F, row by row
  std::vector<std::array<double, 6>> cauchy_stress;         ///< Pa: xx, yy, zz, xy, yz, xz
  std::vector<ElementState> elements;                       ///< of the rank's elements; these need no extrapolation
};

/// Computes the fields of a state. Collective. @param displacements 3 per local node, ghosts up to date
/// @param plenum_pressures_Pa gauge; read for thin walls only, whose stress has the mean of the pressures on both sides
NodalFields nodal_fields(Assembly& assembly, std::span<const double> displacements, std::span<const double> plenum_pressures_Pa);

}  // namespace menger::fem
