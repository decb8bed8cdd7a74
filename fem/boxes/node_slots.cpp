#include "fem/boxes/node_slots.h"

namespace menger::fem {

NodeSlots sorted_by_node(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> first_component,
                         std::size_t node_count, std::size_t stride) {
  NodeSlots sorted;
  sorted.stride = stride;
  sorted.offsets.assign(node_count + 1, 0);
  for (const std::uint32_t node : nodes) ++sorted.offsets[node + 1];
  for (std::size_t n = 0; n < node_count; ++n) sorted.offsets[n + 1] += sorted.offsets[n];
  sorted.slots.assign(nodes.size() + NodeSlots::padding, 0);
  std::vector<std::uint32_t> next(sorted.offsets.begin(), sorted.offsets.end() - 1);
  for (std::size_t s = 0; s < nodes.size(); ++s) sorted.slots[next[nodes[s]]++] = first_component[s];
  return sorted;
}

FourfoldSlots::FourfoldSlots(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> slots, std::size_t node_count,
                             std::uint32_t empty_slot) {
  std::vector<std::uint32_t> counts(node_count, 0);
  for (const std::uint32_t node : nodes) ++counts[node];
  offsets_.push_back(0);
  for (const std::uint32_t count : counts) offsets_.push_back(offsets_.back() + (count + group - 1U) / group * group);
  slots_.assign(offsets_.back(), empty_slot);
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t s = 0; s < nodes.size(); ++s) slots_[next[nodes[s]]++] = slots[s];
}

}  // namespace menger::fem
