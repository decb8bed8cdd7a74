#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fem/surfaces/point.h"

namespace menger::fem {

/// The rim of a hole that a virtual cap closes, such as the mouth of a tube. It consists of edges of elements, each with k nodes
/// in their order along it (2: straight; 3: a parabola through its middle node). Nodes are numbered within the rim, from 0.
template <std::size_t k>
struct Rim {
  /// Indices of the nodes of each segment. With a point c inside the hole, (first - c) x (last - c) points out of the air.
  std::vector<std::array<std::size_t, k>> segments;

  /// The directions normal to planes of symmetry (through the origin) that cut the cap. The segments and the volume are then
  /// those of the modelled part.
  std::array<bool, 3> mirrored{};
};

/// Returns a cap's share of the volume of a chamber's air, m^3, to be added to the shares of the chamber's faces.
///
/// The cap is the fan of straight lines from c to the rim, where c is the mean of the segments' mean points. A mirrored component
/// of c is that of the origin. With positions relative to the origin and A = 1/2 int x x dx along the rim, V = c . A / 3, which
/// is a polynomial of the node positions. Pressure on the cap acts on the rim through dV/dx, as from a membrane without
/// stiffness. Only V enters the model, not the shape of the fan.
///
/// Defined for k = 2 and k = 3. @param nodes positions of the rim's nodes, N of them
template <std::size_t k>
double cap_volume(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin = {});

/// Returns the gradient dV/dx, m^2: 3 N numbers, component i of node a at 3 a + i.
template <std::size_t k>
std::vector<double> cap_volume_gradient(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin = {});

/// Returns the Hessian d2V/dx2, m: 3 N x 3 N numbers row by row. It is symmetric, and full because c depends on every node.
template <std::size_t k>
std::vector<double> cap_volume_hessian(const Rim<k>& rim, std::span<const Point> nodes, const Point& origin = {});

extern template double cap_volume(const Rim<2>&, std::span<const Point>, const Point&);
extern template double cap_volume(const Rim<3>&, std::span<const Point>, const Point&);
extern template std::vector<double> cap_volume_gradient(const Rim<2>&, std::span<const Point>, const Point&);
extern template std::vector<double> cap_volume_gradient(const Rim<3>&, std::span<const Point>, const Point&);
extern template std::vector<double> cap_volume_hessian(const Rim<2>&, std::span<const Point>, const Point&);
extern template std::vector<double> cap_volume_hessian(const Rim<3>&, std::span<const Point>, const Point&);

}  // namespace menger::fem
