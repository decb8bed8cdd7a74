#include "fem/memory/memory_estimate.h"

#include <gtest/gtest.h>

#include "fem/space/space.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::fem {
namespace {

meshes::HexahedralMesh hollow_pair(int elements_through_wall) {
  meshes::Design design;
  design.body = meshes::Polycube::from_digits(2, 1, 1, "11");
  design.cell_edge_m = 0.01;
  meshes::HollowBodyOptions options;
  options.elements_through_wall = elements_through_wall;
  return meshes::hollow_polycube(design, options).mesh;
}

TEST(BodySize, IsThatOfTheSpaceThatItForetells) {
  const meshes::HexahedralMesh mesh = hollow_pair(1);
  for (const int degree : {1, 2}) {
    for (const int refinements : {0, 1}) {
      const Space space = make_space(mesh, degree, refinements, MPI_COMM_SELF);
      const BodySize size = body_size(mesh, degree, refinements);
      EXPECT_EQ(size.elements, static_cast<double>(space.element_count)) << degree << refinements;
      EXPECT_EQ(size.unknowns, 3.0 * static_cast<double>(space.node_count)) << degree << refinements;
    }
  }
}

TEST(MemoryEstimate, TakesTheCheaperMethodOnlyWhereTheSolverChooses) {
  const BodySize large{.elements = 1e5, .unknowns = 2e6};
  const double direct = estimated_memory_bytes(large, 2, {.method = LinearMethod::direct});
  const double iterative = estimated_memory_bytes(large, 2, {.method = LinearMethod::iterative});
  const double chosen = estimated_memory_bytes(large, 2, {});
  EXPECT_LT(chosen, direct);
  EXPECT_GT(chosen, iterative) << "factors are analysed first";
  EXPECT_EQ(estimated_memory_bytes(large, 2, {.largest_direct_size = 3'000'000}), direct);
}

TEST(MemoryEstimate, RefusesWithBothSizesWhatDoesNotFit) {
  const BodySize size = body_size(hollow_pair(2), 2, 0);
  const double needed = estimated_memory_bytes(size, 2, {});
  EXPECT_EQ(obstacle_of_memory(size, 2, {}, needed), "");
  const std::string obstacle = obstacle_of_memory(size, 2, {}, 0.1e9);
  EXPECT_NE(obstacle.find("unknowns of"), std::string::npos) << obstacle;
  EXPECT_NE(obstacle.find("GB of memory, and there are 0.1 GB"), std::string::npos) << obstacle;
}

}  // namespace
}  // namespace menger::fem
