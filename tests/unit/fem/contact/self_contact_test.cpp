#include "fem/contact/self_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <vector>

#include "tests/unit/fem/contact/contact_samples.h"

namespace menger::fem {
namespace {

constexpr double edge = 2e-3;
constexpr double stiffness = 6e7;
const BlockLoop alone(1);

Point same(const Point& X) { return X; }

/// The two blocks with the upper one moved and the bow that joins them made shorter as a whole.
std::vector<double> moved(const meshes::HexahedralMesh& mesh, const Point& way) {
  return mapped(mesh, [&](const Point& X) {
    if (X[0] > 9e-3) return sum(X, scaled(X[2] / 12e-3, way));
    return X[2] > 7e-3 ? sum(X, way) : X;
  });
}

std::vector<double> lowered(const meshes::HexahedralMesh& mesh, double by) { return moved(mesh, {0.0, 0.0, -by}); }

TEST(NearestOnFace, IsFoundInsideOnEdgesAndAtCorners) {
  const FaceCorners square{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
  const auto inside = nearest_on_face(square, {0.3, 0.6, -0.2});
  EXPECT_NEAR(inside.distance_square_m2, 0.04, 1e-15);
  EXPECT_EQ(inside.rim[0], -1);
  Point mean{};
  for (std::size_t c = 0; c < 4; ++c) mean = sum(mean, scaled(inside.weights[c], square[c]));
  EXPECT_NEAR(norm(difference(mean, {0.3, 0.6, 0.0})), 0.0, 1e-15);
  const auto beside = nearest_on_face(square, {0.25, -1.0, 1.0});
  EXPECT_NEAR(beside.distance_square_m2, 2.0, 1e-15);
  EXPECT_EQ(beside.rim, (std::array<int, 2>{0, 1}));
  EXPECT_NEAR(beside.weights[0], 0.75, 1e-15);
  const auto corner = nearest_on_face(square, {2.0, 3.0, 0.0});
  EXPECT_EQ(corner.rim, (std::array<int, 2>{2, 2}));
  EXPECT_EQ(corner.weights[2], 1.0);
}

TEST(ContactSurfaces, AreTheOutsideAndEachChamber) {
  const ContactSurfaces surfaces(hollow_cube());
  ASSERT_EQ(surfaces.surface_count(), 2U);
  double outside = 0.0;
  double inside = 0.0;
  for (std::size_t n = 0; n < surfaces.node_count(); ++n) (surfaces.surface(n) == 0 ? outside : inside) += surfaces.area_m2(n);
  EXPECT_NEAR(outside, 6.0 * 4e-4, 1e-12);
  EXPECT_NEAR(inside, 6.0 * 256e-6, 1e-12);
  EXPECT_NEAR(surfaces.shortest_edge_m(), edge, 1e-12);
}

// At rest nothing on a body of cubes is nearer than an edge, concave edges and walls of one element included.
TEST(SelfContact, NothingTouchesAtRest) {
  for (const meshes::HexahedralMesh& mesh : {u_body(), two_blocks(), hollow_cube(), meshes::box({6e-3, 6e-3, 2e-3}, {3, 3, 1})}) {
    const ContactSurfaces surfaces(mesh);
    const std::vector<Point> points = surfaces.points(mapped(mesh, same));
    EXPECT_NEAR(ContactSearch(surfaces, points).near_pairs(points, 3e-3, alone).smallest_m, edge, 1e-12);
    SelfContact contact(mesh, stiffness);
    contact.find_touches(mapped(mesh, same), alone);
    EXPECT_TRUE(contact.touches().empty());
    EXPECT_FALSE(contact.is_awake());
  }
}

// Flat blocks a depth d in each other press with k d on the area that the nodes of one side have: 64 mm^2 and half an edge along
// the rim. Both sides carry half.
TEST(SelfContact, PressureIsStiffnessTimesDepth) {
  const meshes::HexahedralMesh mesh = two_blocks();
  constexpr double depth = 1e-5;
  SelfContact contact(mesh, stiffness);
  contact.find_touches(lowered(mesh, 4e-3 + depth), alone);
  ASSERT_EQ(contact.touches().size(), 50U);
  double up = 0.0;
  double down = 0.0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    EXPECT_NEAR(contact.forces_N()[3 * n], 0.0, 1e-12);
    EXPECT_NEAR(contact.forces_N()[3 * n + 1], 0.0, 1e-12);
    (mesh.points[n][2] > 7e-3 ? up : down) += contact.forces_N()[3 * n + 2];
  }
  const double area = 64e-6 + 32e-3 * 0.5 * edge;
  EXPECT_NEAR(up, stiffness * depth * area, 1e-6 * up);
  EXPECT_NEAR(down, -up, 1e-12 * up);
  EXPECT_NEAR(contact.energy_J(), 0.5 * up * depth, 1e-6 * contact.energy_J());
}

TEST(SelfContact, BlocksThatDoNotReachEachOtherDoNotPush) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  contact.find_touches(lowered(mesh, 4e-3 - 1e-6), alone);
  EXPECT_TRUE(contact.touches().empty());
  EXPECT_TRUE(contact.forces_N().empty());
  EXPECT_TRUE(contact.is_awake());
  // Beside the lower block, and lower than its top.
  contact.forget();
  contact.find_touches(moved(mesh, {0.0, 8.1e-3, -4.5e-3}), alone);
  EXPECT_TRUE(contact.touches().empty());
}

/// The two blocks in each other, with every node moved a little.
std::vector<double> crumpled(const meshes::HexahedralMesh& mesh) {
  std::vector<double> positions = lowered(mesh, 4.2e-3);
  const std::vector<double> noise = random_numbers(positions.size(), 0.05 * edge, 5);
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] += noise[n];
  return positions;
}

// Nodes and faces that are heavy enough keep the springs of their areas, others get those that their masses bear.
TEST(SelfContact, SpringsAreLimitedByTheMassesThatTheyJoin) {
  const meshes::HexahedralMesh mesh = two_blocks();
  const ExplicitBody body(mesh, silicone_options(mesh));
  const double limit = touch_limit_per_s2(stiffness, 1070.0, edge);
  const std::vector<double> x = crumpled(mesh);
  SelfContact unlimited(mesh, stiffness);
  SelfContact limited(mesh, stiffness, true, {}, {body.masses_kg(), limit});
  unlimited.find_touches(x, alone);
  limited.find_touches(x, alone);
  ASSERT_EQ(limited.touches().size(), unlimited.touches().size());
  std::size_t reduced = 0;
  double largest = 0.0;
  for (std::size_t t = 0; t < limited.touches().size(); ++t) {
    const SelfTouch& touch = limited.touches()[t];
    double lightness = 1.0 / body.masses_kg()[touch.node];
    for (std::size_t c = 0; c < 4; ++c) lightness += touch.weights[c] * touch.weights[c] / body.masses_kg()[touch.face_nodes[c]];
    const double of_area = unlimited.touches()[t].spring_N_per_m;
    largest = std::max(largest, of_area * lightness);
    EXPECT_LE(touch.spring_N_per_m * lightness, limit * (1.0 + 1e-12));
    if (touch.spring_N_per_m < of_area * (1.0 - 1e-12)) {
      ++reduced;
      EXPECT_NEAR(touch.spring_N_per_m * lightness, limit, 1e-12 * limit);
    }
  }
  EXPECT_GT(largest, 2.0 * limit);
  EXPECT_GT(reduced, 8U);
  EXPECT_LT(reduced, limited.touches().size() - 8U);
}

// Two slabs with walls as thin as the thinnest, away from their edges.
TEST(SelfContact, LimitLeavesFlatWallsAlone) {
  constexpr double k = 3e7;
  const double mass = 0.5 * 1070.0 * edge * edge * edge;
  EXPECT_NEAR(0.5 * k * edge * edge * (2.0 / mass), touch_limit_per_s2(k, 1070.0, edge),
              1e-12 * touch_limit_per_s2(k, 1070.0, edge));
}

TEST(SelfContact, ForcesKeepMomentumAndAngularMomentum) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  const std::vector<double> x = crumpled(mesh);
  contact.find_touches(x, alone);
  ASSERT_GT(contact.touches().size(), 30U);
  Point force{};
  Point moment{};
  double size = 0.0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point f{contact.forces_N()[3 * n], contact.forces_N()[3 * n + 1], contact.forces_N()[3 * n + 2]};
    force = sum(force, f);
    moment = sum(moment, cross({x[3 * n], x[3 * n + 1], x[3 * n + 2]}, f));
    size += norm(f);
  }
  EXPECT_LT(norm(force), 1e-13 * size);
  EXPECT_LT(norm(moment), 1e-13 * size * 0.02);
}

// Central differences of the energy along random directions; the energy is not quadratic, and steps of 1e-9 m see 1e-5 of that.
TEST(SelfContact, ForceIsTheGradientOfTheEnergy) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  const std::vector<double> x = crumpled(mesh);
  const auto energy_at = [&](const std::vector<double>& direction, double step) {
    std::vector<double> moved = x;
    for (std::size_t n = 0; n < x.size(); ++n) moved[n] += step * direction[n];
    contact.forget();
    contact.find_touches(moved, alone);
    return contact.energy_J();
  };
  for (const unsigned seed : {1U, 2U, 3U}) {
    const std::vector<double> direction = random_numbers(x.size(), 1.0, seed);
    const double slope = (energy_at(direction, 1e-9) - energy_at(direction, -1e-9)) / 2e-9;
    contact.forget();
    contact.find_touches(x, alone);
    double power = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n) power += contact.forces_N()[n] * direction[n];
    EXPECT_NEAR(-power, slope, 1e-5 * std::abs(slope)) << seed;
  }
}

// An L folds about its concave edge. Nothing pushes until the arms lie on each other, and then all of their nodes do.
TEST(SelfContact, FoldIsHeldWhenItHasShut) {
  const meshes::HexahedralMesh mesh =
      body_of_cubes({5, 2, 5}, edge, [](std::size_t i, std::size_t, std::size_t k) { return i == 0 || k == 0; });
  const auto folded = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    SelfContact contact(mesh, stiffness);
    contact.find_touches(mapped(mesh,
                                [&](const Point& X) {
                                  if (X[2] < 1.5 * edge) return X;
                                  const double x = X[0] - edge;  // from the concave edge, which runs along y
                                  const double z = X[2] - edge;
                                  return Point{edge + x * std::cos(angle) + z * std::sin(angle), X[1],
                                               edge - x * std::sin(angle) + z * std::cos(angle)};
                                }),
                         alone);
    return contact.touches().size();
  };
  for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.9}) EXPECT_EQ(folded(degrees), 0U) << degrees;
  EXPECT_EQ(folded(90.5), 24U);  // 3 in y and 4 along each arm
}

// Cells that meet only along an edge have points of their own there: no distance at rest, and contact when they are pushed into
// each other.
TEST(SelfContact, CellsThatMeetAlongAnEdgeTouchWhenPushed) {
  const meshes::HexahedralMesh mesh =
      body_of_cubes({2, 3, 2}, edge, [](std::size_t i, std::size_t j, std::size_t k) { return i == k || j == 2; });
  const ContactSurfaces surfaces(mesh);
  std::vector<bool> is_upper(mesh.points.size(), false);  // of the cells at (1, j, 1), but for where they are joined
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const std::size_t node : mesh.elements[e])
      if (mesh.points[mesh.elements[e][0]][0] > 1e-3 && mesh.points[mesh.elements[e][0]][2] > 1e-3 && mesh.points[node][1] < 3e-3)
        is_upper[node] = true;
  const auto touches = [&](double apart) {
    std::vector<double> positions = mapped(mesh, same);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
      for (const std::size_t i : {0U, 2U}) positions[3 * n + i] += is_upper[n] ? apart : 0.0;
    SelfContact contact(mesh, stiffness);
    contact.find_touches(positions, alone);
    // Where the cells are joined nothing moves, so that sides turn a little: second order in the way.
    for (const SelfTouch& touch : contact.touches()) EXPECT_NEAR(norm(touch.behind_m), -apart, 1e-4 * -apart);
    return contact.touches().size();
  };
  const std::vector<Point> points = surfaces.points(mapped(mesh, same));
  EXPECT_EQ(ContactSearch(surfaces, points).near_pairs(points, 1e-3, alone).smallest_m, 0.0);
  EXPECT_EQ(touches(0.0), 0U);
  EXPECT_EQ(touches(1e-5), 0U);
  EXPECT_EQ(touches(-1e-5), 4U);
}

// Where one of two cells that meet along an edge ends, the other one's node is in the air as soon as it is past that end, be it
// far less than its way from the top: 2 um in, 100 um below the top and 0.8 um past the end is no depth of 100 um. What remains
// is the other cell's node, 2 um in.
TEST(SelfContact, NodePastTheEndOfACellIsNotDeepInIt) {
  const meshes::HexahedralMesh mesh = body_of_cubes({2, 4, 2}, edge, [](std::size_t i, std::size_t j, std::size_t k) {
    return (i == 0 && k == 1) || (i == 1 && k == 0 && j >= 2) || (i == 0 && k == 0 && j == 3);
  });
  std::vector<bool> is_lower(mesh.points.size(), false);  // of the end at y = 4 mm of the cells at (1, j, 0)
  for (const meshes::ElementCorners& element : mesh.elements)
    for (const std::size_t node : element)
      if (mesh.points[element[0]][0] > 1e-3 && mesh.points[node][1] < 5e-3) is_lower[node] = true;
  const auto deepest = [&](double past_end) {
    std::vector<double> positions = mapped(mesh, same);
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      if (!is_lower[n]) continue;
      positions[3 * n] -= 2e-6;
      positions[3 * n + 1] += past_end;
      positions[3 * n + 2] += 1e-4;
    }
    SelfContact contact(mesh, stiffness);
    contact.watch();
    contact.find_touches(positions, alone);
    return contact.largest_depth_m();
  };
  EXPECT_NEAR(deepest(-0.8e-6), 2e-6, 1e-8);
  EXPECT_NEAR(deepest(0.8e-6), 2e-6, 1e-8);
}

// Ways add up until the smallest distance may have closed; only then is there another search, and pairs are followed only near.
TEST(SelfContact, LooksAgainWhenAGapMayHaveClosed) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  const std::vector<double> rest = mapped(mesh, same);
  contact.find_touches(rest, alone);
  EXPECT_EQ(contact.search_count(), 1U);
  contact.moved(0.37 * edge);  // of 0.75 edges that are searched, each side may use half
  EXPECT_FALSE(contact.is_awake());
  contact.moved(0.01 * edge);
  EXPECT_TRUE(contact.is_awake());
  std::vector<double> apart = rest;
  apart[0] += 0.5 * edge;
  contact.find_touches(apart, alone);
  EXPECT_EQ(contact.search_count(), 1U) << "less than what is searched";
  EXPECT_FALSE(contact.is_awake());
  contact.moved(0.13 * edge);
  EXPECT_TRUE(contact.is_awake());
  apart[0] -= 1.25 * edge;
  contact.find_touches(apart, alone);
  EXPECT_EQ(contact.search_count(), 2U);
  EXPECT_FALSE(contact.is_awake());
  contact.forget();
  EXPECT_TRUE(contact.is_awake());
}

// Paths bound displacements. Where bodies have swung back, or fly as a whole, displacements tell that nothing can have met.
TEST(SelfContact, DoesNotSearchWhereNodesHaveComeBack) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  contact.find_touches(mapped(mesh, same), alone);
  std::vector<double> positions = mapped(mesh, same);
  for (double& x : positions) x += 10.0 * edge;
  positions[0] += 0.1 * edge;
  contact.moved(0.5 * edge);
  EXPECT_TRUE(contact.is_awake());
  contact.find_touches(positions, alone);
  EXPECT_EQ(contact.search_count(), 1U);
  EXPECT_FALSE(contact.is_awake());
  contact.moved(0.3 * edge);
  EXPECT_FALSE(contact.is_awake()) << "0.1 of the displacement and twice 0.3 of the path since";
  contact.moved(0.03 * edge);
  EXPECT_TRUE(contact.is_awake());
}

// A bar of 60 mm turns: its ends move by more than what is searched, neighbours hardly against each other.
TEST(SelfContact, DoesNotSearchWhereNeighboursMoveTogether) {
  const meshes::HexahedralMesh mesh = body_of_cubes({30, 2, 1}, edge, [](std::size_t, std::size_t, std::size_t) { return true; });
  SelfContact contact(mesh, stiffness);
  contact.find_touches(mapped(mesh, same), alone);
  const auto turned = [&](double angle) {
    return mapped(mesh, [&](const Point& X) { return sum(X, {0.0, 0.0, angle * X[0]}); });
  };
  contact.moved(1.2 * edge);
  ASSERT_TRUE(contact.is_awake());
  contact.find_touches(turned(0.04), alone);
  EXPECT_EQ(contact.search_count(), 1U);
  EXPECT_FALSE(contact.is_awake());
  contact.moved(3.0 * edge);
  contact.find_touches(turned(0.2), alone);
  EXPECT_EQ(contact.search_count(), 2U);
}

// Legs 10 mm apart, further than neighbours are looked for, come together as wholes.
TEST(SelfContact, FarPartsThatComeTogetherAreFound) {
  const meshes::HexahedralMesh mesh =
      body_of_cubes({9, 2, 7}, edge, [](std::size_t i, std::size_t, std::size_t k) { return k == 0 || i < 2 || i >= 7; });
  const auto closed = [&](double way) {
    return mapped(mesh, [&](const Point& X) {
      const double share = std::min(1.0, X[2] / (2.0 * edge));
      return sum(X, {(X[0] < 9e-3 ? share : -share) * way, 0.0, 0.0});
    });
  };
  SelfContact contact(mesh, stiffness);
  contact.find_touches(closed(0.0), alone);
  double before = 0.0;
  for (const double way : {1e-3, 2.5e-3, 3.9e-3, 4.8e-3, 5.1e-3}) {
    contact.moved(way - before);
    before = way;
    if (contact.is_awake()) contact.find_touches(closed(way), alone);
    SelfContact fresh(mesh, stiffness);
    fresh.find_touches(closed(way), alone);
    EXPECT_EQ(contact.touches().size(), fresh.touches().size()) << way;
    EXPECT_EQ(contact.energy_J(), fresh.energy_J());
  }
  EXPECT_GT(contact.touches().size(), 20U);
}

// Candidates of an old search hold every pair that meets while ways add up to what it allows.
TEST(SelfContact, OldSearchesMissNothing) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact followed(mesh, stiffness);
  double depth = 4e-3 - 0.3 * edge;  // near enough to be followed
  followed.find_touches(lowered(mesh, depth), alone);
  while (depth < 4e-3 + 0.2 * edge) {
    depth += 0.04 * edge;
    followed.moved(0.02 * edge);  // against the middle of both
    followed.find_touches(lowered(mesh, depth), alone);
    SelfContact fresh(mesh, stiffness);
    fresh.find_touches(lowered(mesh, depth), alone);
    EXPECT_EQ(followed.touches().size(), fresh.touches().size());
    EXPECT_EQ(followed.energy_J(), fresh.energy_J());
  }
  EXPECT_EQ(followed.search_count(), 1U);
  EXPECT_EQ(followed.touches().size(), 50U);
}

// A node in front of its nearest face is passed over while paths are shorter than its distance, even if it jumps without a path.
TEST(SelfContact, NodesInFrontOfFacesArePassedOverUntilTheyMayHaveMet) {
  const meshes::HexahedralMesh mesh = two_blocks();
  SelfContact contact(mesh, stiffness);
  contact.find_touches(lowered(mesh, 4e-3 - 0.3 * edge), alone);
  ASSERT_TRUE(contact.is_awake());
  const std::vector<double> touching = lowered(mesh, 4e-3 + 0.1 * edge);
  contact.moved(0.14 * edge);
  contact.find_touches(touching, alone);
  EXPECT_TRUE(contact.touches().empty()) << "each side may have moved by 0.14 of the gap of 0.3 edges";
  contact.moved(0.02 * edge);
  contact.find_touches(touching, alone);
  EXPECT_EQ(contact.touches().size(), 50U);
  EXPECT_EQ(contact.search_count(), 1U);
}

// The upper block comes down askew, so that its nodes meet the lower one after each other and are passed over for different
// paths, and lifts off again.
TEST(SelfContact, PassingOverMissesNoTouch) {
  const meshes::HexahedralMesh mesh = two_blocks();
  const auto askew = [&](double by) {
    return mapped(mesh, [&](const Point& X) {
      const double down = by + 0.1 * (X[0] - 4e-3) * by / 4e-3 + 0.05 * X[1] * by / 4e-3;
      if (X[0] > 9e-3) return sum(X, {0.0, 0.0, -X[2] / 12e-3 * down});
      return X[2] > 7e-3 ? sum(X, {0.0, 0.0, -down}) : X;
    });
  };
  SelfContact followed(mesh, stiffness);
  double by = 4e-3 - 0.35 * edge;
  followed.find_touches(askew(by), alone);
  std::size_t most = 0;
  std::set<std::size_t> counts;
  for (const double way : {0.03 * edge, -0.02 * edge}) {
    for (std::size_t step = 0; step < 18; ++step) {
      by += way;
      followed.moved(0.65 * std::abs(way));  // against the middle of both, where the block comes down fastest
      followed.find_touches(askew(by), alone);
      SelfContact fresh(mesh, stiffness);
      fresh.find_touches(askew(by), alone);
      EXPECT_EQ(followed.touches().size(), fresh.touches().size()) << by;
      EXPECT_EQ(followed.energy_J(), fresh.energy_J());
      most = std::max(most, followed.touches().size());
      counts.insert(followed.touches().size());
    }
  }
  EXPECT_GT(most, 20U);
  EXPECT_GT(counts.size(), 4U) << "nodes meet after each other";
}

// The upper block is as deep in the lower one, and shifted past its flush side by as much, that its nodes at the rim count as
// beside it. A small slip back brings them in: they touch at once, although they have not moved by their distance.
TEST(SelfContact, NodesBesideARimAreNotPassedOver) {
  const meshes::HexahedralMesh mesh = two_blocks();
  const double depth = 0.3 * edge;
  const auto slipped = [&](double past_side) { return moved(mesh, {0.0, past_side, -4e-3 - depth}); };
  SelfContact followed(mesh, stiffness);
  std::set<std::size_t> counts;
  double before = 0.12 * depth;
  for (double past_side = before; past_side > 0.0; past_side -= 0.01 * depth) {
    followed.moved(before - past_side);
    before = past_side;
    followed.find_touches(slipped(past_side), alone);
    SelfContact fresh(mesh, stiffness);
    fresh.find_touches(slipped(past_side), alone);
    EXPECT_EQ(followed.touches().size(), fresh.touches().size()) << past_side / depth;
    counts.insert(fresh.touches().size());
  }
  EXPECT_GT(counts.size(), 1U) << "some nodes were beside the rim and came in";
}

TEST(ContactSearch, FollowsTheBodyWithTheTreesOfItsStart) {
  const meshes::HexahedralMesh mesh = two_blocks();
  const ContactSurfaces surfaces(mesh);
  ContactSearch old(surfaces, surfaces.points(mapped(mesh, same)));
  const std::vector<Point> points = surfaces.points(crumpled(mesh));
  ContactSearch fresh(surfaces, points);
  const ContactCandidates found = old.near_pairs(points, 2e-3, alone);
  const ContactCandidates expected = fresh.near_pairs(points, 2e-3, BlockLoop(3));
  EXPECT_GT(found.faces.size(), 100U);
  EXPECT_EQ(found.nodes, expected.nodes);
  EXPECT_EQ(found.offsets, expected.offsets);
  EXPECT_EQ(found.faces, expected.faces);
  EXPECT_EQ(found.smallest_m, expected.smallest_m);
}

}  // namespace
}  // namespace menger::fem
