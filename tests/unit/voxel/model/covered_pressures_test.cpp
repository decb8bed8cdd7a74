#include "voxel/model/covered_pressures.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "meshes/design/reference_shapes.h"

namespace menger::voxel {
namespace {

using meshes::ChamberLayout;
using meshes::Polycube;

/// A body and the pressures that it was taken to: from walls that meet or buckle to 0.8 of the limit, for cells of 1 cm of Dragon
/// Skin 10 with 2 mm walls, rounded.
struct Taken {
  Polycube body;
  int level;
  double lowest_Pa;
  double highest_Pa;
};

std::vector<Taken> bodies_of_a_fit() {
  return {{meshes::bar(1), 1, -31.0e3, 34.8e3},
          {meshes::bar(3), 1, -5.1e3, 23.7e3},
          {Polycube::from_digits(2, 2, 1, "1111"), 1, -2.9e3, 18.4e3},
          {Polycube::from_digits(3, 2, 1, "111111"), 1, -1.5e3, 15.6e3},
          {meshes::full_cube(3), 1, -2.0e3, 9.0e3},
          {Polycube::from_digits(2, 1, 1, "11"), 2, -8.1e3, 26.0e3},
          {Polycube::from_digits(2, 2, 1, "1110"), 1, -6.6e3, 23.0e3},
          {Polycube::from_digits(2, 2, 2, "11101000"), 1, -6.0e3, 21.0e3}};
}

ValidityRange validity_of_fit() {
  ValidityRange validity;
  for (const Taken& taken : bodies_of_a_fit())
    cover(validity, body_walls(taken.body, taken.level, ChamberLayout::single), taken.lowest_Pa, taken.highest_Pa);
  return validity;
}

CoveredPressures covered(const Polycube& body, int level = 1) {
  return covered_pressures(validity_of_fit(), body_walls(body, level, ChamberLayout::single));
}

const Polycube plane = Polycube::from_digits(3, 3, 1, "111111111");

TEST(CoveredPressures, OfTheBodiesOfTheFitAreTheirOwnUnlessOthersWentFurtherWithTheirWalls) {
  for (const Taken& taken : bodies_of_a_fit()) {
    const CoveredPressures range = covered(taken.body, taken.level);
    const bool is_tripod = taken.body.nz() == 2;  // all its classes are those of the elbow, and of gaps at least as wide
    EXPECT_EQ(range.lowest_Pa, is_tripod ? -6.6e3 : taken.lowest_Pa) << taken.body.digits();
    EXPECT_EQ(range.highest_Pa, is_tripod ? 23.0e3 : taken.highest_Pa) << taken.body.digits();
  }
  EXPECT_EQ(covered(meshes::bar(1), 2).lowest_Pa, -8.1e3) << "bonded cells are not taken further than the joint was";
  EXPECT_EQ(covered(meshes::bar(1), 2).highest_Pa, 26.0e3);
}

TEST(CoveredPressures, OfWideWallsAreNotThoseOfNarrowOnesThatAnArmLeaves) {
  // Where an arm leaves a square, one wall is beside the cell, as at the side of a slab, and the wall is hardly wider than the
  // square.
  ValidityRange validity = validity_of_fit();
  cover(validity, body_walls(Polycube::from_digits(3, 2, 1, "111110"), 1, ChamberLayout::single), -3.2e3, 19.0e3);
  EXPECT_EQ(validity.lowest_pressure_Pa[gaps::one_cell][walls::one], -1.5e3);
  EXPECT_EQ(validity.highest_pressure_Pa[walls::one], 15.6e3);
  EXPECT_EQ(validity.lowest_pressure_Pa[gaps::one_cell][walls::corner], -3.2e3) << "of the other cells of the square";
  EXPECT_EQ(validity.highest_pressure_Pa[walls::corner], 19.0e3);
}

TEST(CoveredPressures, OfAPlaneEndWhereItsMiddleWasNotFitted) {
  // The middle of a plane is wall on one side of a cell and wall on the other, none beside: no body of the fit has that, and
  // walls of 3 x 3 cells with 6 mm between them meet at -0.64 kPa. Under pressure they move apart, as those of the full cube.
  const CoveredPressures range = covered(plane);
  EXPECT_EQ(range.lowest_Pa, 0.0);
  EXPECT_EQ(range.lowest_by, "walls one cell apart of voxels with no wall beside them (wall class 0)");
  EXPECT_EQ(range.highest_Pa, 9.0e3);
  EXPECT_EQ(range.highest_by, "voxels with no wall beside them (wall class 0)");
  EXPECT_FALSE(range.contains(-0.65e3));
  EXPECT_FALSE(range.contains(15.8e3));
  EXPECT_TRUE(range.contains(9.0e3 * (1.0 + 1e-12)));
}

TEST(CoveredPressures, OfVacuumReachOnlyToGapsAtLeastAsWide) {
  // Walls of 3 x 3 cells two cells apart lie between the plane and the full cube, whose walls have three cells between them.
  const CoveredPressures slab = covered(Polycube::from_digits(3, 3, 2, std::string(18, '1')));
  EXPECT_EQ(slab.lowest_Pa, 0.0);
  EXPECT_EQ(slab.lowest_by, "walls two cells apart of voxels with no wall beside them (wall class 0)");
  ValidityRange validity = validity_of_fit();
  cover(validity, body_walls(plane, 1, ChamberLayout::single), -0.6e3, 15.0e3);
  const BodyWalls of_slab = body_walls(Polycube::from_digits(3, 3, 2, std::string(18, '1')), 1, ChamberLayout::single);
  EXPECT_EQ(covered_pressures(validity, of_slab).lowest_Pa, -0.6e3) << "what one cell of air suffices for, two do";
  EXPECT_EQ(covered_pressures(validity, body_walls(meshes::full_cube(3), 1, ChamberLayout::single)).lowest_Pa, -2.0e3);
}

TEST(CoveredPressures, AreNoneWhereNothingWasFitted) {
  ValidityRange validity;
  cover(validity, body_walls(meshes::bar(1), 1, ChamberLayout::single), -1e3, 2e3);
  EXPECT_TRUE(covered_pressures(validity, body_walls(plane, 1, ChamberLayout::single)).contains(0.0));
  EXPECT_FALSE(covered_pressures(validity, body_walls(plane, 1, ChamberLayout::single)).contains(1.0));
  const CoveredPressures joint = covered_pressures(validity, body_walls(meshes::bar(1), 2, ChamberLayout::single));
  EXPECT_EQ(joint.highest_Pa, 0.0);
  EXPECT_EQ(joint.highest_by, "joints");
}

TEST(BodyWalls, OfChambersPerPhaseAreThoseOfTheChambers) {
  const Polycube two_phases = Polycube::from_digits(2, 1, 1, "12");
  const BodyWalls apart = body_walls(two_phases, 1, ChamberLayout::per_phase);
  EXPECT_TRUE(apart.has_joints);
  EXPECT_TRUE(apart.facing[gaps::one_cell][walls::closed]);
  EXPECT_FALSE(apart.facing[gaps::two_cells][walls::closed]) << "two closed cells";
  const BodyWalls together = body_walls(two_phases, 1, ChamberLayout::single);
  EXPECT_FALSE(together.has_joints);
  EXPECT_TRUE(together.facing[gaps::two_cells][walls::closed]);
  EXPECT_TRUE(together.facing[gaps::one_cell][walls::three]) << "across the bar";
}

TEST(BodyWalls, CountTheCellsBetweenFacingWalls) {
  // A bar of four cells, bent at one end: along x rows of four and one cell, along y two where it is bent, else one.
  const BodyWalls bent = body_walls(Polycube::from_digits(4, 2, 1, "11111000"), 1, ChamberLayout::single);
  ByGap<ByWallClass<bool>> expected{};
  expected[gaps::three_or_more_cells][walls::closed] = true;  // along the bar
  expected[gaps::three_or_more_cells][walls::three] = true;   // at its bent end
  expected[gaps::two_cells][walls::three] = true;             // across it there
  expected[gaps::two_cells][walls::closed] = true;            // into the bend
  expected[gaps::one_cell][walls::three] = true;              // across its end
  expected[gaps::one_cell][walls::limb] = true;               // and its middle
  expected[gaps::one_cell][walls::bend] = true;
  EXPECT_EQ(bent.facing, expected);
}

TEST(CoveredPressures, OfAnyBodyAreThoseOfItsWorstWall) {
  const CoveredPressures any = covered_pressures(validity_of_fit(), all_walls(false));
  EXPECT_EQ(any.lowest_Pa, 0.0);
  EXPECT_EQ(any.highest_Pa, 9.0e3);
}

}  // namespace
}  // namespace menger::voxel
