#include "fem/surfaces/wall_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/fem/surfaces/face_samples.h"

namespace menger::fem {
namespace {

constexpr double depth = 1e-3;

template <std::size_t n>
std::optional<WallGap> gap_of(const SampleSurface<n>& surface, double largest_depth = depth) {
  return smallest_wall_gap(std::span<const std::array<std::size_t, n>>(surface.faces), std::span<const Point>(surface.nodes),
                           largest_depth);
}

/// Two plates of the size 20 mm x 20 mm: a lower one at z = 0 that looks up and an upper one at z = gap that looks down.
template <std::size_t n>
SampleSurface<n> plates(double gap, std::size_t cells) {
  SampleSurface<n> surface;
  add_rectangle(surface, {0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, cells, cells);
  add_rectangle(surface, {0.0, 0.0, gap}, {0.0, 0.02, 0.0}, {0.02, 0.0, 0.0}, cells, cells);
  return surface;
}

template <std::size_t n>
void expect_box_gap() {
  for (const double height : {0.006, 1e-4, 1e-7}) {
    const auto gap = gap_of(box_chamber<n>({0.001, 0.002, 0.003}, {0.02, 0.016, height}, 5));
    ASSERT_TRUE(gap);
    EXPECT_FALSE(gap->is_crossing);
    EXPECT_NEAR(gap->gap_m, height, 1e-16);
    EXPECT_NEAR(std::abs(gap->points[1][2] - gap->points[0][2]), height, 1e-16);
    EXPECT_NEAR(norm(difference(gap->points[1], gap->points[0])), height, 1e-16);
  }
}

TEST(WallContact, GapOfASqueezedBoxIsItsHeight) {
  expect_box_gap<4>();
  expect_box_gap<9>();
}

/// The same box turned: the response does not depend on the axes.
TEST(WallContact, GapDoesNotChangeUnderRotation) {
  auto surface = box_chamber<9>({0.0, 0.0, 0.0}, {0.02, 0.016, 0.0003}, 4);
  surface.deform([](const Point& p) -> Point {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    const Point q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    return {q[0], c * q[1] - s * q[2], s * q[1] + c * q[2]};
  });
  EXPECT_NEAR(gap_of(surface)->gap_m, 0.0003, 1e-16);
}

/// A roof that falls towards x = 20 mm to a height of 1 mm, with an angle a to the floor: nearest to the floor at that edge.
TEST(WallContact, FindsTheLowEndOfASlantedPlate) {
  auto surface = plates<9>(0.005, 4);
  surface.deform([](const Point& p) -> Point { return {p[0], p[1], p[2] > 0.0 ? 0.005 - 0.2 * p[0] : 0.0}; });
  const auto gap = gap_of(surface);
  EXPECT_NEAR(gap->gap_m, 0.001, 1e-16);
  EXPECT_NEAR(gap->points[0][0], 0.02, 1e-15);
}

/// Plates whose nodes are not above each other, so that a corner is nearest to the inside of a triangle.
TEST(WallContact, GapOfShiftedPlatesIsTheirDistance) {
  SampleSurface<4> surface;
  add_rectangle(surface, {0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, 5, 5);
  add_rectangle(surface, {0.0013, 0.0029, 0.0005}, {0.0, 0.013, 0.0}, {0.017, 0.0, 0.0}, 3, 4);
  EXPECT_NEAR(gap_of(surface)->gap_m, 0.0005, 1e-16);
}

/// A pyramid with its tip below the inside of a large triangle, far from that triangle's edges; then the same upside down.
TEST(WallContact, FindsATipOppositeTheInsideOfATriangle) {
  for (const double side : {1.0, -1.0}) {
    SampleSurface<4> surface;
    add_rectangle(surface, {0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, 2, 2);
    add_rectangle(surface, {0.003, -0.004, 0.005}, {0.0, 0.02, 0.0}, {0.02, 0.0, 0.0}, 1, 1);
    surface.deform([&](const Point& p) -> Point {
      const double z = norm(difference(p, {0.01, 0.01, 0.0})) < 1e-9 ? 0.002 : p[2];
      return {p[0], side * p[1], side * z};  // a half turn about the x axis
    });
    const auto gap = gap_of(surface);
    EXPECT_NEAR(gap->gap_m, 0.003, 1e-16) << side;
    EXPECT_FALSE(gap->is_crossing);
  }
}

/// Ridges of a gable below and of one above, at right angles: the nearest points lie within edges, not at nodes.
TEST(WallContact, FindsCrossedRidges) {
  SampleSurface<4> surface;
  add_rectangle(surface, {-0.01, -0.009, -0.003}, {0.01, 0.0, 0.003}, {0.0, 0.02, 0.0}, 1, 1);
  add_rectangle(surface, {0.0, -0.009, 0.0}, {0.01, 0.0, -0.003}, {0.0, 0.02, 0.0}, 1, 1);
  add_rectangle(surface, {-0.008, -0.01, 0.0037}, {0.0, 0.01, -0.003}, {0.02, 0.0, 0.0}, 1, 1);
  add_rectangle(surface, {-0.008, 0.0, 0.0007}, {0.0, 0.01, 0.003}, {0.02, 0.0, 0.0}, 1, 1);
  const auto gap = gap_of(surface, 0.0);
  EXPECT_NEAR(gap->gap_m, 0.0007, 1e-16);
  EXPECT_LT(std::abs(gap->points[0][0]) + std::abs(gap->points[0][1]), 1e-15);
}

/// Walls z = b (1 - r^2)(1 - s^2) and gap - b (1 - r^2)(1 - s^2), r and s from -1 to 1 across: gap - 2 b in the middle.
TEST(WallContact, FindsBulgesInTheMiddle) {
  for (const std::size_t cells : {1U, 3U, 6U}) {
    for (const double bulge : {0.001, 0.0019999, 0.002}) {
      auto surface = plates<9>(0.004, cells);
      surface.deform([&](const Point& p) -> Point {
        const double r = p[0] / 0.01 - 1.0;
        const double s = p[1] / 0.01 - 1.0;
        const double rise = bulge * (1.0 - r * r) * (1.0 - s * s);
        return {p[0], p[1], p[2] > 0.0 ? p[2] - rise : rise};
      });
      const auto gap = gap_of(surface);
      EXPECT_FALSE(gap->is_crossing);
      EXPECT_NEAR(gap->gap_m, 0.004 - 2.0 * bulge, 1e-16);
      EXPECT_NEAR(gap->points[0][0], 0.01, 1e-4);  // near contact many points are as near but for 1e-16
    }
  }
}

/// A bulge whose top lies between nodes, against a flat wall: off by the sagitta h^2 / 8R, h = 2.5 mm between nodes, 1/R = 2 b /
/// L^2.
TEST(WallContact, MissesATopBetweenNodesByNoMoreThanTheSagitta) {
  auto surface = plates<9>(0.004, 4);
  const double bulge = 0.003;
  surface.deform([&](const Point& p) -> Point {
    const double r = (p[0] - 0.01125) / 0.01;
    return {p[0], p[1], p[2] > 0.0 ? p[2] : bulge * (1.0 - r * r)};
  });
  const double sagitta = 0.0025 * 0.0025 / 8.0 * 2.0 * bulge / 1e-4;
  const double gap = gap_of(surface)->gap_m;
  EXPECT_GE(gap, 0.001 - 1e-16);
  EXPECT_LE(gap, 0.001 + 1.001 * sagitta);
}

template <std::size_t n>
void expect_crossing_plates() {
  const auto gap = gap_of(plates<n>(-0.0004, 6));
  ASSERT_TRUE(gap);
  EXPECT_TRUE(gap->is_crossing);
  EXPECT_NEAR(gap->gap_m, -0.0004, 1e-16);
}

TEST(WallContact, SeesPlatesThatWentThroughEachOther) {
  expect_crossing_plates<4>();
  expect_crossing_plates<9>();
}

TEST(WallContact, SeesBulgesThatWentThroughEachOtherInTheMiddle) {
  auto surface = box_chamber<9>({0.0, 0.0, 0.0}, {0.02, 0.02, 0.004}, 6);
  surface.deform([](const Point& p) -> Point {
    const double r = p[0] / 0.01 - 1.0;
    const double s = p[1] / 0.01 - 1.0;
    return {p[0], p[1], p[2] + (0.004 - 2.0 * p[2]) / 0.004 * 0.00215 * (1.0 - r * r) * (1.0 - s * s)};
  });
  const auto gap = gap_of(surface);
  EXPECT_TRUE(gap->is_crossing);
  // Triangles on one side of the tops lean by 2 degrees, which shortens what is measured along their normals by 1 - cos(2
  // degrees).
  EXPECT_NEAR(gap->gap_m, -0.0003, 1e-3 * 0.0003);
  EXPECT_NEAR(gap->points[0][0], 0.01, 1e-6);
}

/// A thin solid wall in a chamber has the chamber's surface on both sides, nearer to each other than opposite walls are.
TEST(WallContact, DoesNotTakeTheTwoSidesOfAWallForCrossing) {
  auto surface = box_chamber<4>({0.0, 0.0, 0.0}, {0.02, 0.02, 0.01}, 4);
  const auto inner = box_chamber<4>({0.0, 0.0, 0.011}, {0.02, 0.02, 0.006}, 4);
  for (auto face : inner.faces) {
    for (auto& node : face) node += surface.nodes.size();
    surface.faces.push_back(face);
  }
  surface.nodes.insert(surface.nodes.end(), inner.nodes.begin(), inner.nodes.end());
  const auto gap = gap_of(surface, 0.0009);  // the wall between the two is 1 mm thick
  EXPECT_FALSE(gap->is_crossing);
  EXPECT_NEAR(gap->gap_m, 0.006, 1e-16);
}

/// Perpendicular walls come arbitrarily near to each other at their common edge.
TEST(WallContact, RaisesNoFalseAlarmInCorners) {
  SampleSurface<9> corner;
  add_rectangle(corner, {0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, 40, 2);
  add_rectangle(corner, {0.0, 0.0, 0.0}, {0.0, 0.02, 0.0}, {0.0, 0.0, 0.02}, 2, 40);
  EXPECT_FALSE(gap_of(corner));
  // Faces of 0.1 mm in a chamber 16 mm wide.
  EXPECT_NEAR(gap_of(box_chamber<4>({0.0, 0.0, 0.0}, {0.016, 0.016, 0.016}, 160))->gap_m, 0.016, 1e-16);
}

/// A chamber like a wedge of 45 degrees closes at its edge: only the gap from the second row of faces on counts.
TEST(WallContact, LeavesFacesThatMeetOut) {
  SampleSurface<4> wedge;
  add_rectangle(wedge, {0.0, 0.0, 0.0}, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, 10, 1);
  add_rectangle(wedge, {0.0, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.01, 0.0, 0.01}, 1, 10);
  const auto gap = gap_of(wedge);
  ASSERT_TRUE(gap);
  EXPECT_FALSE(gap->is_crossing);
  EXPECT_GE(gap->gap_m, 0.001 * std::sqrt(0.5) - 1e-16);
  EXPECT_LE(gap->gap_m, 0.001);
}

TEST(WallContact, AnswersNothingForASingleWall) {
  SampleSurface<9> wall;
  add_rectangle(wall, {0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, 4, 4);
  EXPECT_FALSE(gap_of(wall));
  EXPECT_FALSE(gap_of(SampleSurface<9>{}));
}

TEST(WallContact, LooksNoFurtherThanAsked) {
  const auto surface = plates<9>(0.003, 4);
  const std::span<const std::array<std::size_t, 9>> faces(surface.faces);
  const std::span<const Point> nodes(surface.nodes);
  EXPECT_FALSE(smallest_wall_gap(faces, nodes, depth, 0.0029));
  EXPECT_TRUE(smallest_wall_gap(faces, nodes, depth, 0.0031));
}

/// Beyond the largest depth the same two walls are the sides of a solid one.
TEST(WallContact, CrossesNoDeeperThanAsked) {
  EXPECT_TRUE(gap_of(plates<4>(-0.0004, 6), 0.00041));
  EXPECT_FALSE(gap_of(plates<4>(-0.0004, 6), 0.00039));
}

/// Against every pair of nodes of two bent walls.
TEST(WallContact, AgreesWithPairsOfNodesOnBentWalls) {
  auto surface = plates<4>(0.003, 8);
  surface.deform([](const Point& p) -> Point {
    const double wave = 0.0008 * std::sin(400.0 * p[0] + 100.0 * p[1]);
    return {p[0], p[1], p[2] > 0.0 ? p[2] + 0.0006 * std::cos(300.0 * p[1]) : wave};
  });
  const double gap = gap_of(surface)->gap_m;
  double nearest = 1.0;
  const auto height = [](const Point& p) { return p[2]; };
  for (const Point& p : surface.nodes)
    for (const Point& q : surface.nodes)
      if (height(p) < 0.0015 && height(q) > 0.0015) nearest = std::min(nearest, norm(difference(p, q)));
  // Nodes are points of the walls: the gap is no larger; between nodes it is smaller by no more than waves rise within a cell.
  EXPECT_LE(gap, nearest);
  EXPECT_GE(gap, 0.9 * nearest);
}

}  // namespace
}  // namespace menger::fem
