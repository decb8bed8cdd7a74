#include "fem/contact/body_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/fem/contact/contact_samples.h"

namespace menger::fem {
namespace {

constexpr double cube_edge = 2e-3;
constexpr double rounding = 1e-9;  // of an edge

/// Two blocks of 4 x 4 x 2 cubes, one above the other, 4 mm apart.
meshes::HexahedralMesh separate_blocks() {
  return body_of_cubes({4, 4, 6}, cube_edge, [](std::size_t, std::size_t, std::size_t k) { return k < 2 || k >= 4; });
}

/// Displacements that bring nodes to where a map puts them.
template <class Map>
std::vector<double> displacements(const meshes::HexahedralMesh& mesh, const Map& map) {
  return mapped(mesh, [&](const Point& X) { return difference(map(X), X); });
}

/// Turns by an angle about the axis (1, 1, 1).
Point turned(const Point& X, double angle) {
  const Point axis = scaled(1.0 / std::sqrt(3.0), {1.0, 1.0, 1.0});
  const Point along = scaled(dot(axis, X), axis);
  const Point across = difference(X, along);
  return sum(along, sum(scaled(std::cos(angle), across), scaled(std::sin(angle), cross(axis, across))));
}

TEST(BodyOverlap, IsNowhereInABodyAtRest) {
  for (const meshes::HexahedralMesh& mesh :
       {u_body(), two_blocks(), separate_blocks(), hollow_cube(), hollow_cube(2), meshes::box({6e-3, 6e-3, 2e-3}, {3, 3, 1})})
    EXPECT_FALSE(BodyOverlapSearch(mesh).find(std::vector<double>(3 * mesh.points.size(), 0.0), rounding));
}

// Cubes of two blocks stand above each other: sixteen pairs, as deep in each other as the upper block was lowered by more than
// the air between them, also where everything is turned together; no more than a whole cube, as cubes then part sideways.
TEST(BodyOverlap, BlocksAreAsDeepAsTheyWerePushed) {
  const meshes::HexahedralMesh mesh = separate_blocks();
  const BodyOverlapSearch search(mesh);
  for (const double angle : {0.0, 0.3, 2.0}) {
    const auto lowered = [&](double by) {
      return displacements(mesh, [&](const Point& X) { return turned(X[2] > 7e-3 ? sum(X, {0.0, 0.0, -by}) : X, angle); });
    };
    EXPECT_FALSE(search.find(lowered(2.0 * cube_edge - 1e-6), rounding));
    for (const double share : {0.01, 0.3, 0.7}) {
      const auto overlap = search.find(lowered((2.0 + share) * cube_edge), rounding);
      ASSERT_TRUE(overlap) << share;
      EXPECT_EQ(overlap->pairs, 16U);
      EXPECT_NEAR(overlap->depth_m, share * cube_edge, rounding * cube_edge);
      EXPECT_NEAR(overlap->share, share, rounding);
      EXPECT_FALSE(search.find(lowered((2.0 + share) * cube_edge), share + rounding));
    }
    EXPECT_NEAR(search.find(lowered(3.0 * cube_edge), rounding)->share, 1.0, rounding);
  }
}

// The lower block pressed flat to a third of its height, the upper one lowered until it is a fifth of an edge in it.
TEST(BodyOverlap, DepthIsMeasuredByTheThinnerElementAsItIs) {
  const meshes::HexahedralMesh mesh = separate_blocks();
  const double top = 2.0 / 3.0 * cube_edge;
  const auto overlap = BodyOverlapSearch(mesh).find(
      displacements(mesh,
                    [&](const Point& X) {
                      const bool is_upper = X[2] > 7e-3;
                      return Point{X[0], X[1], is_upper ? X[2] - 4.0 * cube_edge + top - 0.2 * cube_edge : X[2] / 3.0};
                    }),
      rounding);
  ASSERT_TRUE(overlap);
  EXPECT_NEAR(overlap->depth_m, 0.2 * cube_edge, rounding * cube_edge);
  EXPECT_NEAR(overlap->share, 0.6, 10.0 * rounding);
}

// Two bars cross, both of them on edge: their uppermost and lowest edges meet in their middles, half an edge from all nodes. No
// node is behind a face, so that contact does not feel them. The depth is the height by which they cross.
TEST(BodyOverlap, EdgesThatCrossBetweenNodesAreFound) {
  const meshes::HexahedralMesh mesh =
      body_of_cubes({3, 1, 3}, cube_edge, [](std::size_t, std::size_t, std::size_t k) { return k != 1; });
  const double depth = 0.1 * cube_edge;
  const auto crossed = [&](const Point& X) {
    const bool is_upper = X[2] > 1.5 * cube_edge;
    // Along the bar from its middle, and across it turned by 45 degrees.
    const double along = X[0] - 1.5 * cube_edge;
    const double y = X[1] - 0.5 * cube_edge;
    const double z = X[2] - (is_upper ? 2.5 : 0.5) * cube_edge;
    const double across = (y - z) / std::numbers::sqrt2;
    const double up = (y + z) / std::numbers::sqrt2;
    const double half_diagonal = cube_edge / std::numbers::sqrt2;
    return is_upper ? Point{across, along, up + half_diagonal - depth} : Point{along, across, up - half_diagonal};
  };
  SelfContact contact(mesh, 6e7);
  contact.find_touches(mapped(mesh, crossed), BlockLoop(1));
  EXPECT_TRUE(contact.touches().empty());
  const auto overlap = BodyOverlapSearch(mesh).find(displacements(mesh, crossed), rounding);
  ASSERT_TRUE(overlap);
  EXPECT_EQ(overlap->pairs, 1U);
  EXPECT_NEAR(overlap->depth_m, depth, rounding * cube_edge);
}

// Two plates of one element, one across the other: whichever way their elements lie, some pair is in each other by half a wall.
TEST(BodyOverlap, PlatesThatCrossAreHalfAWallDeep) {
  const meshes::HexahedralMesh mesh =
      body_of_cubes({4, 4, 3}, cube_edge, [](std::size_t, std::size_t, std::size_t k) { return k != 1; });
  const BodyOverlapSearch search(mesh);
  for (const double shift : {0.0, 0.25, 0.5, 0.75}) {
    const auto overlap = search.find(displacements(mesh, [&](const Point& X) {
      if (X[2] < 1.5 * cube_edge) return X;
      return Point{X[2] - 0.5 * cube_edge, X[1] + 0.1 * cube_edge, X[0] - (1.5 + shift) * cube_edge};
    }));
    ASSERT_TRUE(overlap) << shift;
    EXPECT_GE(overlap->share, 0.5 - rounding) << shift;
  }
}

// Pairs are found wherever they lie: clouds of cubes, against each pair by itself.
TEST(BodyOverlap, MissesNoPair) {
  const meshes::HexahedralMesh mesh = body_of_cubes(
      {9, 5, 5}, cube_edge, [](std::size_t i, std::size_t j, std::size_t k) { return i % 2 == 0 && j % 2 == 0 && k % 2 == 0; });
  const BodyOverlapSearch search(mesh);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<double> ways = random_numbers(3 * mesh.elements.size(), 1.5 * cube_edge, seed);
    std::vector<double> u(3 * mesh.points.size());
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const std::size_t node : mesh.elements[e])
        for (std::size_t i = 0; i < 3; ++i) u[3 * node + i] = ways[3 * e + i];
    std::size_t pairs = 0;
    double deepest = 0.0;
    for (std::size_t a = 0; a < mesh.elements.size(); ++a) {
      for (std::size_t b = a + 1; b < mesh.elements.size(); ++b) {
        double depth = cube_edge;  // of cubes along the axes
        for (std::size_t i = 0; i < 3; ++i)
          depth = std::min(depth, cube_edge - std::abs(mesh.points[mesh.elements[a][0]][i] + ways[3 * a + i] -
                                                       mesh.points[mesh.elements[b][0]][i] - ways[3 * b + i]));
        pairs += depth > 0.2 * cube_edge ? 1 : 0;
        deepest = std::max(deepest, depth);
      }
    }
    ASSERT_GT(pairs, 0U);
    const auto overlap = search.find(u, 0.2);
    ASSERT_TRUE(overlap);
    EXPECT_EQ(overlap->pairs, pairs);
    EXPECT_NEAR(overlap->depth_m, deepest, rounding * cube_edge);
  }
}

TEST(BodyOverlap, IsToldInWords) {
  const meshes::HexahedralMesh mesh = separate_blocks();
  const std::string text = BodyOverlapSearch(mesh).text_of({.pairs = 3, .share = 0.7, .depth_m = 1.4e-3, .elements = {0, 17}});
  EXPECT_EQ(
      text.rfind("walls went through each other: 3 pairs of elements; the largest overlap relative to the thickness is between "
                 "those that rest at (0, 0, 0) mm and (",
                 0),
      0U)
      << text;
  EXPECT_NE(text.find(": 1.4 mm or 0.7 of the thickness of the thinner one"), std::string::npos) << text;
}

}  // namespace
}  // namespace menger::fem
