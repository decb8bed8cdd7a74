#pragma once

#include <array>
#include <span>

#include "materials/laws/hyperelastic_law.h"

namespace menger::fem {

/// The deformation of an element, as means over its volume at rest.
struct MeanDeformation {
  std::array<double, 9> gradient{};  ///< F, row by row
  double volume_ratio = 1.0;         ///< det F: the element's volume over that at rest
};

/// Returns the deformation of a Lagrange hexahedron, by the Gauss rule of its degree.
/// @param degree 1 or 2
/// @param positions_m of its nodes at rest, x fastest, 3 numbers each
/// @param displacements_m of its nodes
MeanDeformation mean_deformation(int degree, std::span<const double> positions_m, std::span<const double> displacements_m);

/// What an element is shown with: one value for each, in files for ParaView.
struct ElementState {
  double volume_ratio = 1.0;         ///< see MeanDeformation
  double largest_stretch = 1.0;      ///< of the principal stretches of the mean F
  double von_mises_stress_Pa = 0.0;  ///< of the Cauchy stress of the law at the mean F; not a number where the law does not hold
};

/// Returns the state of an element. Its stress is that of the elastic law alone, without viscosity. Pressure is left out, since
/// the von Mises stress does not depend on it.
ElementState element_state(const materials::HyperelasticLaw& law, const MeanDeformation& deformation);

/// Returns the principal stretches, the largest first: the square roots of the eigenvalues of F^T F.
std::array<double, 3> principal_stretches(const std::array<double, 9>& deformation_gradient);

/// Returns the von Mises stress sqrt(3/2 s : s) of the deviator s, Pa. @param cauchy_stress xx, yy, zz, xy, yz, xz
double von_mises_stress(const std::array<double, 6>& cauchy_stress);

/// Returns the hydrostatic pressure -tr(sigma)/3, Pa. @param cauchy_stress xx, yy, zz, xy, yz, xz
double hydrostatic_pressure(const std::array<double, 6>& cauchy_stress);

}  // namespace menger::fem
