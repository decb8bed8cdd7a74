#include "fem/implicit_locomotion/implicit_ranks.h"

#include <cstddef>
#include <type_traits>

#include "fem/space/rank_gather.h"

namespace menger::fem {
namespace {

constexpr std::size_t numbers_per_ground_node = 6;

std::vector<double> numbers_of(const std::vector<GroundNode>& nodes) {
  std::vector<double> numbers;
  numbers.reserve(numbers_per_ground_node * nodes.size());
  for (const auto& [touches, slides, anchor, friction] : nodes)
    numbers.insert(numbers.end(), {touches ? 1.0 : 0.0, slides ? 1.0 : 0.0, anchor[0], anchor[1], friction[0], friction[1]});
  return numbers;
}

std::vector<GroundNode> ground_nodes_of(const std::vector<double>& numbers) {
  std::vector<GroundNode> nodes;
  nodes.reserve(numbers.size() / numbers_per_ground_node);
  for (std::size_t n = 0; n < numbers.size(); n += numbers_per_ground_node)
    nodes.push_back(
        {numbers[n] != 0.0, numbers[n + 1] != 0.0, {numbers[n + 2], numbers[n + 3]}, {numbers[n + 4], numbers[n + 5]}});
  return nodes;
}

/// What all ranks have in common.
struct Common {
  double time_s;
  double next_step_s;
  std::size_t steps;
  std::size_t rejected_steps;
  std::size_t iterations;
  MotionWork work;
  double at_start_J;
  bool has_start;
  bool has_accelerations;
  bool has_ground_nodes;
};
static_assert(std::is_trivially_copyable_v<Common>);

Common common_of(const ImplicitState& state) {
  // All members by name, so that one that is added does not compile until it goes along.
  const auto& [time_s, displacements_m, velocities_m_per_s, accelerations_m_per_s2, ground_nodes, next_step_s, steps,
               rejected_steps, iterations, work, at_start_J] = state;
  static_cast<void>(displacements_m);  // fields are shared out on their own
  static_cast<void>(velocities_m_per_s);
  return {.time_s = time_s,
          .next_step_s = next_step_s,
          .steps = steps,
          .rejected_steps = rejected_steps,
          .iterations = iterations,
          .work = work,
          .at_start_J = at_start_J.value_or(0.0),
          .has_start = at_start_J.has_value(),
          .has_accelerations = !accelerations_m_per_s2.empty(),
          .has_ground_nodes = !ground_nodes.empty()};
}

std::vector<double> own_field(const Space& space, const NodeExchange& exchange, const std::vector<double>& all) {
  std::vector<double> own(3 * static_cast<std::size_t>(space.owned_count));
  scatter_from_first(space.communicator, all, own);
  own.resize(3 * space.positions.size());
  exchange.update_ghosts(own);
  return own;
}

}  // namespace

std::vector<double> field_of_all_ranks(const Space& space, std::span<const double> field) {
  const auto owned = field.first(3 * static_cast<std::size_t>(space.owned_count));
  return gather_on_first(space.communicator, std::vector<double>(owned.begin(), owned.end()));
}

ImplicitState state_of_all_ranks(const Space& space, const ImplicitState& own) {
  ImplicitState all = own;
  all.displacements_m = field_of_all_ranks(space, own.displacements_m);
  all.velocities_m_per_s = field_of_all_ranks(space, own.velocities_m_per_s);
  all.accelerations_m_per_s2 = field_of_all_ranks(space, own.accelerations_m_per_s2);
  all.ground_nodes = ground_nodes_of(gather_on_first(space.communicator, numbers_of(own.ground_nodes)));
  return all;
}

ImplicitState state_of_this_rank(const Space& space, const NodeExchange& exchange, const ImplicitState& all,
                                 std::size_t ground_node_count) {
  Common common = common_of(all);
  MPI_Bcast(&common, static_cast<int>(sizeof common), MPI_BYTE, 0, space.communicator);
  ImplicitState own;
  own.time_s = common.time_s;
  own.next_step_s = common.next_step_s;
  own.steps = common.steps;
  own.rejected_steps = common.rejected_steps;
  own.iterations = common.iterations;
  own.work = common.work;
  if (common.has_start) own.at_start_J = common.at_start_J;
  own.displacements_m = own_field(space, exchange, all.displacements_m);
  own.velocities_m_per_s = own_field(space, exchange, all.velocities_m_per_s);
  if (common.has_accelerations) own.accelerations_m_per_s2 = own_field(space, exchange, all.accelerations_m_per_s2);
  if (common.has_ground_nodes) {
    std::vector<double> numbers(numbers_per_ground_node * ground_node_count);
    scatter_from_first(space.communicator, numbers_of(all.ground_nodes), numbers);
    own.ground_nodes = ground_nodes_of(numbers);
  }
  return own;
}

}  // namespace menger::fem
