#include "fem/boxes/node_slots.h"

#include <gtest/gtest.h>

namespace menger::fem {
namespace {

// Node 0 has five slots, node 1 none, node 2 one: missing ones are the empty slot.
TEST(FourfoldSlots, AddUpTheSlotsOfANode) {
  const std::vector<std::uint32_t> nodes{0, 0, 2, 0, 0, 0};
  const std::vector<std::uint32_t> slots{0, 1, 2, 3, 4, 5};
  const FourfoldSlots sorted(nodes, slots, 3, 6);
  std::vector<float> forces(28, 0.0F);
  for (std::size_t s = 0; s < 6; ++s)
    for (std::size_t i = 0; i < 3; ++i) forces[4 * s + i] = static_cast<float>(s + 1) * (i == 1 ? -1.0F : 1.0F);
  EXPECT_EQ(sorted.sum(forces.data(), 0), (std::array{18.0F, -18.0F, 18.0F, 0.0F}));
  EXPECT_EQ(sorted.sum(forces.data(), 1), (std::array{0.0F, 0.0F, 0.0F, 0.0F}));
  EXPECT_EQ(sorted.sum(forces.data(), 2), (std::array{3.0F, -3.0F, 3.0F, 0.0F}));
}

}  // namespace
}  // namespace menger::fem
