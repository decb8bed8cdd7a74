#include "meshes/hexahedra/mesh_counts.h"

#include <gtest/gtest.h>

#include "meshes/hexahedra/verification_shapes.h"

namespace menger::meshes {
namespace {

std::size_t product(std::size_t a, std::size_t b, std::size_t c) { return a * b * c; }

TEST(MeshCounts, AreThoseOfABlock) {
  // A block of 2 x 3 x 4 elements; its points, edges and faces can be counted by direction.
  const MeshCounts counts = mesh_counts(box({2.0, 3.0, 4.0}, {2, 3, 4}));
  EXPECT_EQ(counts.points, product(3, 4, 5));
  EXPECT_EQ(counts.edges, product(2, 4, 5) + product(3, 3, 5) + product(3, 4, 4));
  EXPECT_EQ(counts.faces, product(3, 3, 4) + product(2, 4, 4) + product(2, 3, 5));
  EXPECT_EQ(counts.elements, product(2, 3, 4));
  EXPECT_EQ(counts.nodes(1), product(3, 4, 5));
  EXPECT_EQ(counts.nodes(2), product(5, 7, 9)) << "every half step of the grid has a node";
}

TEST(MeshCounts, AreRefinedAsTheMeshIs) {
  const MeshCounts coarse = refined(mesh_counts(box({2.0, 3.0, 4.0}, {2, 3, 4})));
  const MeshCounts fine = mesh_counts(box({2.0, 3.0, 4.0}, {4, 6, 8}));
  EXPECT_EQ(coarse.points, fine.points);
  EXPECT_EQ(coarse.edges, fine.edges);
  EXPECT_EQ(coarse.faces, fine.faces);
  EXPECT_EQ(coarse.elements, fine.elements);
}

}  // namespace
}  // namespace menger::meshes
