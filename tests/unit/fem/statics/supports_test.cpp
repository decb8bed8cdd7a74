#include "fem/statics/supports.h"

#include <gtest/gtest.h>

#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

TEST(Supports, HoldTheNodesOfTheirFacesAndNoOthers) {
  const Space space = make_space(meshes::box({1.0, 1.0, 1.0}, {2, 2, 2}), 2, 0, MPI_COMM_SELF);
  Body body;
  body.supports = {{x_min, {true, true, false}}, {z_max, {false, false, true}}};
  const auto held = held_components(space, body, NodeExchange(space));
  ASSERT_EQ(held.size(), 3 * space.positions.size());
  for (std::size_t a = 0; a < space.positions.size(); ++a) {
    const bool is_left = space.positions[a][0] < 1e-12;
    const bool is_top = space.positions[a][2] > 1.0 - 1e-12;
    EXPECT_EQ(held[3 * a] != 0, is_left);
    EXPECT_EQ(held[3 * a + 1] != 0, is_left);
    EXPECT_EQ(held[3 * a + 2] != 0, is_top);
  }
}

TEST(Supports, HoldTheNodeNearestToAPoint) {
  const Space space = make_space(meshes::box({1.0, 1.0, 1.0}, {2, 2, 2}), 2, 0, MPI_COMM_SELF);
  Body body;
  body.point_supports = {{{0.55, 0.26, 0.98}, {false, true, false}}};
  const auto held = held_components(space, body, NodeExchange(space));
  int count = 0;
  for (std::size_t n = 0; n < held.size(); ++n) {
    if (held[n] == 0) continue;
    ++count;
    EXPECT_EQ(n % 3, 1U);
    EXPECT_LT(norm(difference(space.positions[n / 3], {0.5, 0.25, 1.0})), 1e-14);
  }
  EXPECT_EQ(count, 1);
}

bool is_held_by(const std::vector<Support>& supports, const std::vector<PointSupport>& points) {
  const Space space = make_space(meshes::box({1e-2, 2e-2, 1e-2}, {1, 2, 1}), 2, 0, MPI_COMM_SELF);
  Body body;
  body.supports = supports;
  body.point_supports = points;
  return is_held(space, body, held_components(space, body, NodeExchange(space)));
}

TEST(Supports, HoldABodyIfTheyLeaveNoRigidMotion) {
  const Support clamp{z_min, {true, true, true}};
  const Support on_table{z_min, {false, false, true}};
  const PointSupport pin{{0.0, 0.0, 0.0}, {true, true, false}};
  const PointSupport guide{{1e-2, 0.0, 0.0}, {false, true, false}};
  EXPECT_TRUE(is_held_by({clamp}, {}));
  EXPECT_TRUE(is_held_by({on_table}, {pin, guide}));
  EXPECT_TRUE(is_held_by({{x_min, {true, false, false}}, {y_min, {false, true, false}}, on_table}, {}));
  EXPECT_FALSE(is_held_by({}, {}));
  EXPECT_FALSE(is_held_by({on_table}, {}));
  EXPECT_FALSE(is_held_by({on_table}, {pin}));  // may spin about the pin
  EXPECT_FALSE(is_held_by({on_table}, {pin, {{0.0, 0.0, 1e-2}, {true, true, false}}}));
  EXPECT_FALSE(is_held_by({}, {{{0.0, 0.0, 0.0}, {true, true, true}}}));
}

TEST(Supports, OfTheGroundHoldABodyUpright) {
  const Space space = make_space(meshes::box({1e-2, 1e-2, 1e-2}, {1, 1, 1}), 1, 0, MPI_COMM_SELF);
  Body body;
  body.ground = GroundPlane{};
  body.ground_labels = {z_min};
  EXPECT_FALSE(is_held(space, body, held_components(space, body, NodeExchange(space))));
  body.point_supports = {{{0.0, 0.0, 0.0}, {true, true, false}}, {{1e-2, 0.0, 0.0}, {false, true, false}}};
  EXPECT_TRUE(is_held(space, body, held_components(space, body, NodeExchange(space))));
}

TEST(NearestNode, IsFoundWithItsPosition) {
  const Space space = make_space(meshes::box({1.0, 1.0, 1.0}, {2, 2, 2}), 1, 0, MPI_COMM_SELF);
  const NearestNode node = nearest_node(space, {0.9, 2.0, 0.3});
  EXPECT_EQ(node.rank, 0);
  EXPECT_LT(norm(difference(node.position, {1.0, 1.0, 0.5})), 1e-14);
  EXPECT_EQ(space.positions[static_cast<std::size_t>(node.local)], node.position);
}

TEST(NearestNode, OfSeveralEquallyNearIsTheOneWithTheLeastCoordinates) {
  // 0.3 / 3 is no short binary number: the eight corners around the middle are equally near but for rounding
  const Space space = make_space(meshes::box({0.3, 0.3, 0.3}, {3, 3, 3}), 1, 0, MPI_COMM_SELF);
  EXPECT_LT(norm(difference(nearest_node(space, {0.15, 0.15, 0.15}).position, {0.1, 0.1, 0.1})), 1e-15);
  EXPECT_LT(norm(difference(nearest_node(space, {0.15, 0.15, 0.3}).position, {0.1, 0.1, 0.3})), 1e-15);
  EXPECT_LT(norm(difference(nearest_node(space, {0.2, 0.15, 0.0}).position, {0.2, 0.1, 0.0})), 1e-15);
  // one that is nearer by more than rounding is taken whatever its coordinates
  EXPECT_LT(norm(difference(nearest_node(space, {0.15, 0.15, 0.15 + 1e-6}).position, {0.1, 0.1, 0.2})), 1e-15);
}

}  // namespace
}  // namespace menger::fem
