#include "evolution/genome/cppn_expression.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace menger::evolution {

namespace {

void activate_all(Activation activation, const GridValues& sums, GridValues& values) {
  for (std::size_t cell = 0; cell < basal_cells; ++cell) values[cell] = activate(activation, sums[cell]);
}

/// Expresses one network once. The values of each node are computed when they are first needed.
class ExpressionRun {
 public:
  ExpressionRun(const Cppn& network, const ExpressionOptions& options)
      : network_(network),
        later_consumers_get_sums_(options.expression == Expression::first_consumer_activated),
        states_(network.nodes.size()),
        in_begin_(network.nodes.size() + 1, 0),
        in_edges_(network.edges.size()) {
    const auto inputs = input_values(options.axes);
    for (std::size_t input = 0; input < cppn_input_count; ++input) {
      states_[input].sums = states_[input].values = inputs[input];
      states_[input].asked = true;
    }
    sort_edges_by_consumer();
  }

  const GridValues& ask(std::size_t node) {
    State& state = states_[node];
    if (state.asked) return later_consumers_get_sums_ ? state.sums : state.values;
    state.asked = true;
    state.sums.fill(0.0);
    for (std::size_t in = in_begin_[node]; in < in_begin_[node + 1]; ++in) {
      const CppnEdge& edge = network_.edges[in_edges_[in]];
      const GridValues& source = ask(edge.from);
      for (std::size_t cell = 0; cell < basal_cells; ++cell) state.sums[cell] += edge.weight * source[cell];
    }
    activate_all(network_.nodes[node].activation, state.sums, state.values);
    return state.values;
  }

 private:
  struct State {
    bool asked = false;
    GridValues sums{};
    GridValues values{};
  };

  /// A counting sort: it keeps the order of insertion among the edges into one node.
  void sort_edges_by_consumer() {
    for (const CppnEdge& edge : network_.edges) ++in_begin_[edge.to + 1];
    for (std::size_t node = 0; node < network_.nodes.size(); ++node) in_begin_[node + 1] += in_begin_[node];
    std::vector<std::size_t> next(in_begin_.begin(), in_begin_.end() - 1);
    for (std::size_t edge = 0; edge < network_.edges.size(); ++edge) in_edges_[next[network_.edges[edge].to]++] = edge;
  }

  const Cppn& network_;
  bool later_consumers_get_sums_;
  std::vector<State> states_;
  std::vector<std::size_t> in_begin_;
  std::vector<std::size_t> in_edges_;
};

}  // namespace

std::string_view to_string(Expression expression) {
  return expression == Expression::every_consumer_activated ? "every-consumer" : "first-consumer";
}

std::string_view to_string(AxisMap axes) { return axes == AxisMap::xyz ? "xyz" : "zyx"; }

double activate(Activation activation, double sum) {
  switch (activation) {
    case Activation::identity:
      return sum;
    case Activation::sigmoid:
      return 2.0 / (1.0 + std::exp(-sum)) - 1.0;
    case Activation::sine:
      return std::sin(sum);
    case Activation::absolute:
      return std::abs(sum);
    case Activation::negative_absolute:
      return -std::abs(sum);
    case Activation::square:
      return sum * sum;
    case Activation::negative_square:
      return -(sum * sum);
    case Activation::root:
      return std::sqrt(std::abs(sum));
    case Activation::negative_root:
      return -std::sqrt(std::abs(sum));
    case Activation::sign:
      return std::isnan(sum) ? sum : static_cast<double>((sum > 0.0) - (sum < 0.0));
    case Activation::negative_sign:
      return std::isnan(sum) ? sum : static_cast<double>((sum < 0.0) - (sum > 0.0));
    case Activation::step:
      return sum > 0.0 ? 1.0 : 0.0;
  }
  return sum;
}

std::array<GridValues, cppn_input_count> input_values(AxisMap axes) {
  std::array<GridValues, cppn_input_count> inputs{};
  for (std::size_t cell = 0; cell < basal_cells; ++cell) {
    const std::array<std::size_t, 3> position{cell % 3, cell / 3 % 3, cell / 9};
    std::array<double, 3> robot{};
    for (std::size_t axis = 0; axis < robot.size(); ++axis) robot[axis] = static_cast<double>(position[axis]) - 1.0;
    const bool swapped = axes == AxisMap::zyx;
    const double x = swapped ? robot[2] : robot[0];
    const double y = robot[1];
    const double z = swapped ? robot[0] : robot[2];
    const double distance = 2.0 * (std::sqrt(x * x + y * y + z * z) / std::numbers::sqrt3) - 1.0;
    const std::array<double, cppn_input_count> values{x, y, z, distance, 1.0};
    for (std::size_t input = 0; input < cppn_input_count; ++input) inputs[input][cell] = values[input];
  }
  return inputs;
}

std::vector<GridValues> express(const Cppn& network, const ExpressionOptions& options) {
  ExpressionRun run(network, options);
  std::vector<GridValues> outputs;
  outputs.reserve(network.output_count);
  for (std::size_t index = 0; index < network.output_count; ++index) outputs.push_back(run.ask(network.output(index)));
  return outputs;
}

}  // namespace menger::evolution
