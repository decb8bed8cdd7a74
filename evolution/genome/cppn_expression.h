#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "evolution/genome/cppn.h"

namespace menger::evolution {

/// Cells of a basal grid of 3 x 3 x 3.
inline constexpr std::size_t basal_cells = 27;

/// A number per cell of a basal grid; cell (x, y, z) of the robot at x + 3 y + 9 z, z up.
using GridValues = std::array<double, basal_cells>;

/// What the consumers of a node with several consumers get.
enum class Expression {
  every_consumer_activated,  ///< each one f(s)
  first_consumer_activated  ///< the first that asks f(s), every later one the plain sum s (a side effect of how the released code
                            ///< remembers values)
};
std::string_view to_string(Expression expression);  ///< "every-consumer" or "first-consumer"

/// How the axes of the network lie in the robot.
enum class AxisMap {
  xyz,  ///< network x, y, z → robot x, y, z
  zyx   ///< network x → robot z (up), y → y, z → x
};
std::string_view to_string(AxisMap axes);  ///< "xyz" or "zyx"

struct ExpressionOptions {
  Expression expression = Expression::every_consumer_activated;
  AxisMap axes = AxisMap::xyz;

  bool operator==(const ExpressionOptions&) const = default;
};

/// f(s) of an activation.
double activate(Activation activation, double sum);

/// The inputs x, y, z, d, b at every cell: coordinates −1, 0, 1 along each axis; d = 2 √(x² + y² + z²) / √3 − 1, so −1 in the
/// centre and 1 in the corners; b = 1.
std::array<GridValues, cppn_input_count> input_values(AxisMap axes);

/// The value of every output at every cell: value(n) = f_n(Σ over edges (u, n, w) of w · value(u)), summed in the order of the
/// edges. Outputs are asked in their order and nodes depth first, which matters to Expression::first_consumer_activated only.
/// Values may be infinite or not a number.
std::vector<GridValues> express(const Cppn& network, const ExpressionOptions& options);

}  // namespace menger::evolution
