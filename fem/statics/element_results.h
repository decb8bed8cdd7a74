#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "fem/space/space.h"

namespace menger::fem {

/// The results to compute for every element.
struct ElementWanted {
  bool residual = false;
  bool stiffness = false;
};

/// Energy of all elements of this rank and the smallest volume ratio at their quadrature points.
struct ElementSums {
  double energy_J = 0.0;
  double smallest_ratio = 1e300;  ///< not positive or NaN: the state is invalid
};

/// The result of one element.
struct ElementResult {
  std::span<const Index> nodes;       ///< local
  std::span<const double> residual;   ///< 3 nodes
  std::span<const double> stiffness;  ///< (3 nodes)^2, row by row, both triangles
};
using ElementReceiver = std::function<void(const ElementResult&)>;

/// Fields at the quadrature points of an element: deformation gradients (9 per point, row by row), Cauchy stresses (9 per
/// point), volume ratios, pressures. The spans are valid only during the call.
struct PointResult {
  std::size_t element;  ///< local
  std::span<const double> deformation_gradient;
  std::span<const double> cauchy_stress;
  std::span<const double> volume_ratio;
  std::span<const double> pressure;
};
using PointReceiver = std::function<void(const PointResult&)>;

}  // namespace menger::fem
