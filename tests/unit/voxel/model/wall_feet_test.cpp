#include "voxel/model/wall_feet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "meshes/design/reference_shapes.h"

namespace menger::voxel {
namespace {

using Kind = WallFoot::Kind;

struct Feet {
  explicit Feet(const meshes::Polycube& body, meshes::ChamberLayout chambers = meshes::ChamberLayout::single,
                int voxels_per_cell = 1)
      : voxels(hollow_voxels(
            body, {.cell_edge_m = 0.01, .wall_thickness_m = 0.002, .voxels_per_cell = voxels_per_cell, .chambers = chambers})),
        lattice(voxels.body) {
    for (std::size_t i = 0; i < lattice.voxel_count(); ++i) of.push_back(wall_feet(lattice, voxels, i));
  }

  [[nodiscard]] std::size_t count(std::size_t voxel, Kind kind) const {
    return static_cast<std::size_t>(std::ranges::count(of[voxel], kind, &WallFoot::kind));
  }

  HollowVoxels voxels;
  Lattice lattice;
  std::vector<std::vector<WallFoot>> of;
};

TEST(WallFeet, OfASingleCellAreItsSixMiddlesAndEightCorners) {
  const Feet feet(meshes::bar(1));
  EXPECT_EQ(feet.count(0, Kind::middle), 6U);
  EXPECT_EQ(feet.count(0, Kind::corner), 8U);
  EXPECT_EQ(feet.count(0, Kind::crown), 0U);
}

TEST(WallFeet, LieOnFreeWallsOnly) {
  // Of the middle of a row two sides are open; its corners belong to the walls beside. Inside a full cube nothing is free.
  const Feet row(meshes::bar(3));
  EXPECT_EQ(row.count(1, Kind::middle), 4U);
  EXPECT_EQ(row.count(1, Kind::corner), 8U);
  EXPECT_EQ(row.count(1, Kind::crown), 0U);
  const Feet cube(meshes::full_cube(3));
  EXPECT_TRUE(cube.of[13].empty());
  // The middle of a face of the cube has one wall, whose corners lie inside the plate and not in its rim.
  EXPECT_EQ(cube.count(4, Kind::middle), 1U);
  EXPECT_EQ(cube.count(4, Kind::corner), 0U);
  EXPECT_EQ(cube.count(4, Kind::crown), 4U);
}

TEST(WallFeet, MakeAWidePlateOneDome) {
  const Feet feet(meshes::Polycube::from_digits(3, 2, 1, "111111"));
  // Two squares of four cells below and two above; every cell at the end has a part in one of each, every one between in both.
  const std::array<std::size_t, 6> crowns{2, 4, 2, 2, 4, 2};
  std::map<std::set<std::size_t>, double> shares;
  for (std::size_t i = 0; i < crowns.size(); ++i) {
    EXPECT_EQ(feet.count(i, Kind::crown), crowns[i]) << i;
    EXPECT_EQ(feet.count(i, Kind::corner), 8U - crowns[i]) << i;
    EXPECT_EQ(feet.count(i, Kind::slope), 2U) << "below and above";
    for (const WallFoot& foot : feet.of[i]) {
      if (foot.kind == Kind::crown && foot.signs[2] < 0.0) shares[{foot.bulging.begin(), foot.bulging.end()}] += foot.share;
    }
  }
  EXPECT_EQ(shares, (std::map<std::set<std::size_t>, double>{{{0, 1, 3, 4}, 1.0}, {{1, 2, 4, 5}, 1.0}}));
}

TEST(WallFeet, OfFourVoxelsOfACellHaveTheirCrownInItsMiddle) {
  const Feet feet(meshes::bar(1), meshes::ChamberLayout::single, 2);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(feet.count(i, Kind::crown), 3U) << "on three free sides";
    // Its own corner of the cell, three in the middles of the cell's edges.
    EXPECT_EQ(feet.count(i, Kind::corner), 4U);
    for (const WallFoot& foot : feet.of[i]) {
      if (foot.kind != Kind::crown) continue;
      // Towards the inside of the cell but for the side that it lies on.
      for (std::size_t k = 0; k < 3; ++k) {
        const bool upper = (i >> k & 1U) != 0;
        EXPECT_EQ(foot.signs[k] > 0.0, upper == (k == foot.axis));
      }
    }
  }
}

TEST(WallFeet, DoNotMakeOneDomeOfTwoChambers) {
  const meshes::Polycube plate = meshes::Polycube::from_digits(2, 2, 1, "1122");
  EXPECT_EQ(Feet(plate).count(0, Kind::crown), 2U);
  EXPECT_EQ(Feet(plate, meshes::ChamberLayout::per_phase).count(0, Kind::crown), 0U);
}

TEST(WallFeet, StandOutByThePeakOfTheirDome) {
  // Bulges by voxel: mean 1 mm of the first, 2 mm of the second ..., peaks three times as much.
  const auto bulge_of = [](std::size_t voxel, std::size_t) {
    const double mean = 1e-3 * static_cast<double>(voxel + 1);
    return WallBulge{mean, 3.0 * mean};
  };
  const auto out_of = [&](const Feet& feet, std::size_t voxel, Kind kind) {
    const auto foot = std::ranges::find(feet.of[voxel], kind, &WallFoot::kind);
    return stands_out_m(*foot, bulge_of);
  };
  const Feet row(meshes::bar(3));
  EXPECT_EQ(out_of(row, 1, Kind::corner), 0.0);
  EXPECT_DOUBLE_EQ(out_of(row, 1, Kind::middle), 6e-3);
  const Feet plate(meshes::Polycube::from_digits(2, 2, 1, "1111"));
  EXPECT_DOUBLE_EQ(out_of(plate, 1, Kind::crown), 3.0 * 2.5e-3) << "the mean of four";
  EXPECT_DOUBLE_EQ(out_of(plate, 1, Kind::slope), 2e-3) << "below the crown";
  // Where three walls of a square are free and one is not there is no crown, and a corner of the plate keeps its peak.
  const Feet footed(meshes::Polycube::from_digits(2, 2, 2, "10001111"));
  EXPECT_EQ(footed.count(2, Kind::crown), 1U) << "above alone";
  const auto below =
      std::ranges::find_if(footed.of[2], [](const WallFoot& foot) { return foot.axis == 2 && foot.signs[2] < 0.0; });
  EXPECT_EQ(below->kind, Kind::middle);
}

TEST(WallFeet, LieAtHalfLengthsFromTheCentre) {
  const std::array<double, 3> half{1.0, 2.0, 3.0};
  WallFoot foot;
  foot.signs = {1.0, -1.0, -1.0};
  const Vector3<double> corner = place_of(foot, half, 0.5);
  EXPECT_EQ((std::array{corner.x, corner.y, corner.z}), (std::array{1.0, -2.0, -3.0}));
  foot.kind = Kind::middle;
  foot.axis = 2;
  foot.signs = {0.0, 0.0, -1.0};
  const Vector3<double> middle = place_of(foot, half, 0.5);
  EXPECT_EQ((std::array{middle.x, middle.y, middle.z}), (std::array{0.0, 0.0, -3.5}));
}

}  // namespace
}  // namespace menger::voxel
