#include "fem/contact/self_contact_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/contact/self_contact_friction.h"
#include "tests/unit/fem/contact/contact_samples.h"

namespace menger::fem {
namespace {

/// A unit square with a node a tenth below the point (0.3, 0.6).
PressedNode below_square() {
  const FaceCorners square{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
  const NearestOnFace nearest = nearest_on_face(square, {0.3, 0.6, -0.1});
  return {square, nearest.weights, difference({0.3, 0.6, -0.1}, nearest.point)};
}

TEST(ContactMemory, FollowsMotion) {
  ContactMemory memory = memory_after({}, 0.2, 0.25);
  EXPECT_EQ(memory.pressed_m, 0.2);
  EXPECT_DOUBLE_EQ(memory.paid_m2, 0.04);
  memory = memory_after(memory, 0.1, 0.25);
  EXPECT_EQ(memory.pressed_m, 0.1);
  EXPECT_NEAR(memory.paid_m2, 0.01, 1e-15);
  memory = memory_after(memory, 0.0, 0.25);
  EXPECT_EQ(memory.pressed_m, 0.0);
  EXPECT_NEAR(memory.paid_m2, 0.0, 1e-15);
}

TEST(ContactMemory, NodeThatSlippedInIsPressedOnlyByWhatFollows) {
  ContactMemory memory = memory_after({}, 0.2, 0.01);
  EXPECT_EQ(memory.pressed_m, 0.0);
  memory = memory_after(memory, 0.205, 0.01);
  EXPECT_NEAR(memory.pressed_m, 0.005, 1e-15);
  memory = memory_after(memory, 0.196, 0.01);  // out by more than it came in: there it begins anew
  EXPECT_EQ(memory.pressed_m, 0.0);
  memory = memory_after(memory, 0.2, 0.01);
  EXPECT_NEAR(memory.pressed_m, 0.004, 1e-15);
}

TEST(ContactMemory, NodeThatSlippedOutMayBringBackWhatItTookAlong) {
  ContactMemory memory = memory_after(memory_after({}, 0.2, 0.25), 0.0, 0.01);
  EXPECT_EQ(memory.pressed_m, 0.0);
  EXPECT_DOUBLE_EQ(memory.paid_m2, 0.04);
  EXPECT_EQ(memory_after(memory, 0.1, 0.01).pressed_m, 0.1);
  EXPECT_DOUBLE_EQ(memory_after(memory, 0.5, 0.01).pressed_m, 0.2);
}

// Depths that wander and jump at random: what a spring has given never exceeds what it took.
TEST(ContactMemory, GivesNoMoreThanItTook) {
  const std::vector<double> ways = random_numbers(20000, 0.1, 3);
  ContactMemory memory;
  double given = 0.0;
  double most = -1.0;
  for (std::size_t n = 0; n + 1 < ways.size(); n += 2) {
    const bool jumps = ways[n + 1] > 0.09;
    const double depth = jumps ? std::abs(5.0 * ways[n]) : std::max(0.0, memory.depth_m + ways[n]);
    const ContactMemory after = memory_after(memory, depth, std::abs(ways[n]));
    const double rise = depth - memory.depth_m;
    if (std::abs(rise) <= std::abs(ways[n]))
      given -= 0.5 * (after.pressed_m * after.pressed_m - memory.pressed_m * memory.pressed_m);
    memory = after;
    most = std::max(most, given);
  }
  EXPECT_LT(most, 1e-12);
}

TEST(ContactMemory, StiffeningOfItsSpringTakesNoEnergy) {
  ContactMemory memory = memory_after(with_spring({}, 10.0), 0.2, 0.25);
  memory.slip_m = {0.1, 0.0, 0.0};
  const ContactMemory stiffer = with_spring(memory, 40.0);
  EXPECT_EQ(stiffer.spring_N_per_m, 40.0);
  EXPECT_DOUBLE_EQ(stiffer.pressed_m, 0.1);
  EXPECT_DOUBLE_EQ(40.0 * stiffer.paid_m2, 10.0 * memory.paid_m2);
  EXPECT_DOUBLE_EQ(stiffer.slip_m[0], 0.05);
  const ContactMemory softer = with_spring(memory, 2.5);
  EXPECT_EQ(softer.pressed_m, 0.2);
  EXPECT_EQ(softer.slip_m[0], 0.1);
  EXPECT_EQ(with_spring(softer, 10.0).pressed_m, 0.2) << "what it lost is still paid for";
}

// Depths that wander and jump, and springs that change, at random; they are stiffer on the way out.
TEST(ContactMemory, GivesNoMoreThanItTookWhereSpringsChange) {
  const std::vector<double> ways = random_numbers(30000, 0.1, 4);
  ContactMemory memory;
  double given = 0.0;
  double most = -1.0;
  for (std::size_t n = 0; n + 2 < ways.size(); n += 3) {
    const bool jumps = ways[n + 1] > 0.09;
    const double depth = jumps ? std::abs(5.0 * ways[n]) : std::max(0.0, memory.depth_m + ways[n]);
    const double spring = (ways[n] > 0.0 ? 1.0 : 2.0) + 9.0 * std::abs(ways[n + 2]);
    const ContactMemory changed = with_spring(memory, spring);
    const ContactMemory after = memory_after(changed, depth, std::abs(ways[n]));
    if (std::abs(depth - memory.depth_m) <= std::abs(ways[n]))
      given -= 0.5 * spring * (after.pressed_m * after.pressed_m - changed.pressed_m * changed.pressed_m);
    memory = after;
    most = std::max(most, given);
  }
  EXPECT_LT(most, 1e-12);
}

TEST(ContactMemory, WayIsThatOfTheNodeAsTheFaceSeesIt) {
  const meshes::HexahedralMesh mesh = meshes::box({2e-3, 2e-3, 2e-3}, {1, 1, 1});
  const ContactSurfaces surfaces(mesh);
  std::vector<double> velocities(3 * mesh.points.size(), 0.5);
  const std::size_t node = 3;
  velocities[3 * surfaces.mesh_node(node) + 1] += 0.25;
  std::size_t without = 0;
  while (std::find(surfaces.face(without).begin(), surfaces.face(without).end(), node) != surfaces.face(without).end()) ++without;
  EXPECT_NEAR(path_past_face_m(surfaces, node, without, {{}, velocities, 1e-4}), 0.25e-4, 1e-18);
}

TEST(SelfFriction, SticksBreaksAwayAndSlides) {
  constexpr SurfaceFriction friction{0.5, 0.3};
  constexpr double spring = 10.0;
  const PressedNode pressed = below_square();
  ContactMemory memory;
  memory.pressed_m = 0.1;
  const auto force = [&](double way) { return friction_force_N(friction, pressed, {way, 0.0, 0.0}, {}, spring, memory)[0]; };
  EXPECT_NEAR(force(0.049), -0.49, 1e-12);
  EXPECT_FALSE(memory.is_sliding);
  EXPECT_NEAR(force(0.002), -0.3, 1e-12);
  EXPECT_TRUE(memory.is_sliding);
  EXPECT_NEAR(force(0.04), -0.3, 1e-12);
  EXPECT_NEAR(force(-0.01), -0.2, 1e-12);  // it goes back and sticks again
  EXPECT_FALSE(memory.is_sliding);
  EXPECT_NEAR(force(0.029), -0.49, 1e-12);
  memory.pressed_m = 0.01;  // the load goes
  EXPECT_NEAR(force(0.0), -0.03, 1e-12);
}

TEST(SelfFriction, AnswersBalanceForceAndMoment) {
  const PressedNode pressed = below_square();
  const Point force{0.7, -0.4, 0.0};
  const std::array<Point, 4> responses = face_reactions_N(pressed, force);
  Point total = force;
  Point moment = cross({0.3, 0.6, -0.1}, force);
  for (std::size_t c = 0; c < 4; ++c) {
    total = sum(total, responses[c]);
    moment = sum(moment, cross(pressed.corners[c], responses[c]));
  }
  EXPECT_LT(norm(total), 1e-15);
  EXPECT_LT(norm(moment), 1e-15);
}

// A node that moves with its face as a rigid body, turns included, slips by nothing; the spring turns with the face.
TEST(SelfFriction, RigidMotionSlipsByNothing) {
  const PressedNode pressed = below_square();
  const Point turn{0.02, -0.03, 0.05};
  const auto displacement_of = [&](const Point& x) { return sum({0.1, 0.2, 0.3}, cross(turn, x)); };
  const std::array<Point, 4> ways{displacement_of(pressed.corners[0]), displacement_of(pressed.corners[1]),
                                  displacement_of(pressed.corners[2]), displacement_of(pressed.corners[3])};
  EXPECT_LT(norm(difference(face_turn_rad(pressed.corners, ways), turn)), 1e-15);
  EXPECT_LT(norm(path_along_face_m(pressed, displacement_of({0.3, 0.6, -0.1}), ways)), 1e-15);
  EXPECT_NEAR(path_along_face_m(pressed, sum(displacement_of({0.3, 0.6, -0.1}), {0.01, 0.0, 0.5}), ways)[0], 0.01, 1e-15);
  ContactMemory memory;
  memory.pressed_m = 0.1;
  memory.slip_m = {0.02, 0.0, 0.0};
  const Point force = friction_force_N({0.5, 0.3}, pressed, {}, {0.0, 0.0, 0.1}, 10.0, memory);
  EXPECT_NEAR(norm(force), 0.2, 1e-12);
  EXPECT_NEAR(std::atan2(-force[1], -force[0]), std::atan(0.1), 1e-12);
}

TEST(SelfFriction, FaceOnALineTurnsNothing) {
  PressedNode pressed = below_square();
  for (Point& corner : pressed.corners) corner[1] = 0.0;
  for (const Point& response : face_reactions_N(pressed, {1.0, 0.0, 0.0})) EXPECT_TRUE(std::isfinite(norm(response)));
}

}  // namespace
}  // namespace menger::fem
