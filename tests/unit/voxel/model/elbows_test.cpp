#include "voxel/model/elbows.h"

#include <gtest/gtest.h>

#include <string>

#include "meshes/design/reference_shapes.h"

namespace menger::voxel {
namespace {

using Turns = std::array<std::vector<AcrossBeam<double>>, 3>;

Turns turns_of(const meshes::Polycube& body, int voxels_per_cell = 1, int level = 1) {
  const HollowVoxels voxels =
      hollow_voxels(body, {.cell_edge_m = 0.01, .wall_thickness_m = 0.002, .voxels_per_cell = voxels_per_cell, .level = level});
  return elbow_turns(Lattice(voxels.body), voxels, voxels_per_cell);
}

Turns turns_of(int x, int y, int z, const std::string& digits) {
  return turns_of(meshes::Polycube::from_digits(x, y, z, digits));
}

constexpr std::size_t along_x = 0;
constexpr std::size_t along_y = 1;
constexpr AcrossBeam<double> straight{0.0, 0.0};

TEST(Elbows, OpenTheArmsOfAnL) {
  // The corner at the origin, arms along +x and +y. The arm along x turns towards -y, so about -z, and the other one towards -x.
  const Turns turns = turns_of(2, 2, 1, "1110");
  ASSERT_EQ(turns[along_x].size(), 1U);
  EXPECT_EQ(turns[along_x][0], (AcrossBeam<double>{0.0, -1.0})) << "about y and z";
  ASSERT_EQ(turns[along_y].size(), 1U);
  EXPECT_EQ(turns[along_y][0], (AcrossBeam<double>{1.0, 0.0})) << "about z and x";
  // The same with the corner at the upper end of both beams: seen from its arms, it turns as they do there.
  const Turns turned = turns_of(2, 2, 1, "0111");
  EXPECT_EQ(turned[along_x][0], (AcrossBeam<double>{0.0, 1.0}));
  EXPECT_EQ(turned[along_y][0], (AcrossBeam<double>{-1.0, 0.0}));
}

TEST(Elbows, BendBothArmsOfATAwayFromItsStem) {
  const Turns turns = turns_of(3, 2, 1, "111010");
  ASSERT_EQ(turns[along_x].size(), 2U);
  EXPECT_EQ(turns[along_x][0], (AcrossBeam<double>{0.0, -1.0})) << "seen from its lower end, which is the arm";
  EXPECT_EQ(turns[along_x][1], (AcrossBeam<double>{0.0, -1.0}));
  ASSERT_EQ(turns[along_y].size(), 1U);
  EXPECT_EQ(turns[along_y][0], straight) << "an arm on either side";
}

TEST(Elbows, CancelAtCrossings) { EXPECT_FALSE(has_elbows(turns_of(3, 3, 1, "010111010"))); }

TEST(Elbows, BendAnOffsetBarTwice) {
  // A step: two corners that turn one beam against each other cancel in its angle, those of the other two do not.
  const Turns turns = turns_of(3, 2, 1, "110011");
  ASSERT_EQ(turns[along_y].size(), 1U);
  EXPECT_EQ(turns[along_y][0], straight);
  EXPECT_EQ(turns[along_x][0], (AcrossBeam<double>{0.0, -1.0}));
  EXPECT_EQ(turns[along_x][1], (AcrossBeam<double>{0.0, 1.0}));
}

TEST(Elbows, AreNotInStraightOrFullBodies) {
  EXPECT_FALSE(has_elbows(turns_of(meshes::bar(3))));
  EXPECT_FALSE(has_elbows(turns_of(2, 2, 1, "1111")));
  EXPECT_FALSE(has_elbows(turns_of(meshes::full_cube(3))));
}

TEST(Elbows, LeaveLimbsOfPlatesToTheirPlates) { EXPECT_FALSE(has_elbows(turns_of(3, 3, 2, "000101000111111111"))); }

TEST(Elbows, LieBetweenModulesToo) {
  // Three L: the two arms of the corner module, the two beams between modules, and the arms that go on from there. The other arm
  // of the outer modules has an edge on either side.
  const HollowVoxels voxels = hollow_voxels(meshes::Polycube::from_digits(2, 2, 1, "1110"),
                                            {.cell_edge_m = 0.01, .wall_thickness_m = 0.002, .voxels_per_cell = 1, .level = 2});
  const Lattice lattice(voxels.body);
  const Turns turns = elbow_turns(lattice, voxels, 1);
  int bent = 0;
  int between_modules = 0;
  for (const std::size_t axis : {along_x, along_y}) {
    for (std::size_t beam = 0; beam < turns[axis].size(); ++beam) {
      const auto lower = static_cast<std::size_t>(lattice.beams[axis].lower[beam]);
      if (turns[axis][beam] == straight) continue;
      ++bent;
      if (!voxels.walled[lower][2 * axis + 1]) continue;
      ++between_modules;
      EXPECT_EQ(turns[axis][beam], (axis == along_x ? AcrossBeam<double>{0.0, -1.0} : AcrossBeam<double>{1.0, 0.0}))
          << "as the arms of the corner";
    }
  }
  EXPECT_EQ(bent, 6);
  EXPECT_EQ(between_modules, 2);
}

TEST(Elbows, OfFinerVoxelsAreLeftToTheirBeams) {
  EXPECT_FALSE(has_elbows(turns_of(meshes::Polycube::from_digits(2, 2, 1, "1110"), 2)));
}

}  // namespace
}  // namespace menger::voxel
