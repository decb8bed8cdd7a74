#pragma once

#include <array>
#include <span>
#include <vector>

#include "fem/statics/assembly.h"

namespace menger::fem {

/// The fields of a state at the nodes of a rank, ghosts included.
///
/// In each element, polynomials through the values at the quadrature points are evaluated at the nodes. A node takes the mean
/// over its elements, across ranks and regions. This holds for deformation gradient, Cauchy stress and volume ratio; other fields
/// are computed from these means. The values are unreliable near re-entrant edges, where the exact fields are not bounded, and
/// between regions, where stresses jump.
struct NodalFields {
  std::vector<std::array<double, 9>> deformation_gradient;  ///< F, row by row
  std::vector<std::array<double, 6>> cauchy_stress;         ///< Pa: xx, yy, zz, xy, yz, xz
  std::vector<double> volume_ratio;                         ///< J
};

/// Computes the fields at the nodes. Collective. @param displacements 3 per local node, ghosts up to date
/// @param plenum_pressures_Pa read for thin walls only
NodalFields nodal_fields(Assembly& assembly, std::span<const double> displacements,
                         std::span<const double> plenum_pressures_Pa = {});

/// Returns the principal stretches, the largest first: the square roots of the eigenvalues of F^T F.
std::array<double, 3> principal_stretches(const std::array<double, 9>& deformation_gradient);

/// Returns the von Mises stress sqrt(3/2 s : s) of the deviator s, Pa.
double von_mises_stress(const std::array<double, 6>& cauchy_stress);

/// Returns the hydrostatic pressure -tr(sigma)/3, Pa.
double hydrostatic_pressure(const std::array<double, 6>& cauchy_stress);

}  // namespace menger::fem
