#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "evolution/genome/cppn.h"

namespace menger::evolution {

/// Number of cells of the basal grid, 3 x 3 x 3.
inline constexpr std::size_t basal_cells = 27;

/// One number per cell of the basal grid. Cell (x, y, z) of the robot is at index x + 3 y + 9 z; z points up.
using GridValues = std::array<double, basal_cells>;

/// The value that a node with several consumers passes on. A consumer is a node at the end of an edge that leaves the node; s is
/// the node's sum, f its activation.
enum class Expression {
  every_consumer_activated,  ///< every consumer gets f(s)
  /// The first consumer that asks gets f(s), every later one the plain sum s: a side effect of how the released code stores
  /// values.
  first_consumer_activated
};
std::string_view to_string(Expression expression);  ///< "every-consumer" or "first-consumer"

/// How the axes of the network lie in the robot.
enum class AxisMap {
  xyz,  ///< network x, y, z → robot x, y, z
  zyx   ///< network x → robot z (up), y → y, z → x
};
std::string_view to_string(AxisMap axes);  ///< "xyz" or "zyx"

/// How a network is turned into values at cells.
struct ExpressionOptions {
  Expression expression = Expression::every_consumer_activated;
  AxisMap axes = AxisMap::xyz;

  bool operator==(const ExpressionOptions&) const = default;
};

/// Returns the value f(s) of an activation f at a sum s.
double activate(Activation activation, double sum);

/// Returns the inputs x, y, z, d, b at every cell: coordinates −1, 0, 1 along each axis; d = 2 √(x² + y² + z²) / √3 − 1, which is
/// −1 in the centre and 1 in the corners; b = 1.
std::array<GridValues, cppn_input_count> input_values(AxisMap axes);

/// Computes the value of every output at every cell: value(n) = f_n(Σ over edges (u, n, w) of w · value(u)), summed in the order
/// of the edges. Outputs are evaluated in their order and nodes depth first, which matters for
/// Expression::first_consumer_activated only. Values may be infinite or not a number.
std::vector<GridValues> express(const Cppn& network, const ExpressionOptions& options);

}  // namespace menger::evolution
