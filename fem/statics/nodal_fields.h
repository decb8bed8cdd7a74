#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/statics/assembly.h"

namespace menger::fem {

/// Fields of a state at the nodes of a rank, ghosts included.
///
/// In each element the values at the quadrature points are interpolated by the polynomials through them and evaluated at the
/// nodes; a node takes the mean of its elements, across ranks and across regions. Deformation gradient, Cauchy stress and volume
/// ratio are treated so; the rest is computed of these means. Near re-entrant edges, where the exact fields are not bounded, and
/// between regions, where stresses jump, the values say little.
struct NodalFields {
  std::vector<std::array<double, 9>> deformation_gradient;  ///< F, row by row
  std::vector<std::array<double, 6>> cauchy_stress;         ///< Pa: xx, yy, zz, xy, yz, xz
  std::vector<double> volume_ratio;                         ///< J
};

/// Collective. @param displacements 3 per local node, ghosts up to date
NodalFields nodal_fields(Assembly& assembly, std::span<const double> displacements);

/// Principal stretches, the largest first: the roots of the eigenvalues of F^T F.
std::array<double, 3> principal_stretches(const std::array<double, 9>& deformation_gradient);

/// sqrt(3/2 s : s) of the deviator s, Pa.
double von_mises_stress(const std::array<double, 6>& cauchy_stress);

/// -tr(sigma)/3, Pa.
double hydrostatic_pressure(const std::array<double, 6>& cauchy_stress);

}  // namespace menger::fem
