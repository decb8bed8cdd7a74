#include "voxel/laws/lattice.h"

#include <gtest/gtest.h>

#include "meshes/design/fractal.h"
#include "meshes/design/reference_shapes.h"

namespace menger::voxel {
namespace {

TEST(Lattice, HasTheBeamsOfTheMengerSponge) {
  EXPECT_EQ(Lattice(meshes::menger_sponge()).beam_count(), 24U);
  EXPECT_EQ(Lattice(meshes::fractal(meshes::menger_sponge(), 2)).beam_count(), 672U);
}

TEST(Lattice, SortsBeamsByAxisAndLowerVoxel) {
  const Lattice lattice(meshes::full_cube(3));
  for (const AxisBeams& beams : lattice.beams) {
    ASSERT_EQ(beams.lower.size(), 18U);
    for (std::size_t i = 1; i < beams.lower.size(); ++i) EXPECT_LT(beams.lower[i - 1], beams.lower[i]);
  }
  EXPECT_EQ(lattice.beams[0].upper[0], 1);
  EXPECT_EQ(lattice.beams[1].upper[0], 3);
  EXPECT_EQ(lattice.beams[2].upper[0], 9);
}

TEST(Lattice, NeighboursMirrorEachOther) {
  const Lattice lattice(meshes::menger_sponge());
  for (std::size_t i = 0; i < lattice.voxel_count(); ++i) {
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int32_t other = lattice.neighbours[i][side];
      if (other >= 0) {
        EXPECT_EQ(lattice.neighbours[static_cast<std::size_t>(other)][side ^ 1U], static_cast<std::int32_t>(i));
      }
    }
  }
}

TEST(Lattice, OnlyTheCoreOfACubeIsNotSurface) { EXPECT_EQ(Lattice(meshes::full_cube(3)).surface().size(), 26U); }

}  // namespace
}  // namespace menger::voxel
