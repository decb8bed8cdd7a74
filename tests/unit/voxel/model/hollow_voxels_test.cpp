#include "voxel/model/hollow_voxels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "meshes/design/reference_shapes.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::voxel {
namespace {

using meshes::ChamberLayout;
using meshes::Polycube;

constexpr double voxel_edge = 0.01;
constexpr double wall = 0.002;

HollowOptions options(int voxels_per_cell = 1, int level = 1, ChamberLayout chambers = ChamberLayout::single) {
  return {voxel_edge, wall, voxels_per_cell, level, chambers};
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Three legs of different length under a plate: no symmetry.
Polycube quadruped() { return Polycube::from_digits(3, 3, 2, "101000102111121211"); }

void expect_wall_volume_of_the_cast_body(const Polycube& body, const HollowOptions& o) {
  meshes::HollowBodyOptions cast;
  cast.wall_thickness_m = o.wall_thickness_m;
  cast.chambers = o.chambers;
  cast.level = o.level;
  const meshes::HollowBody reference = meshes::hollow_polycube({"body", body, o.cell_edge_m}, cast);
  const HollowVoxels voxels = hollow_voxels(body, o);
  EXPECT_NEAR(sum(voxels.wall_volume_m3), reference.wall_volume_m3, 1e-12 * reference.wall_volume_m3);
  EXPECT_EQ(voxels.chamber_count, reference.chambers.size());
}

TEST(HollowVoxels, HaveTheWallOfTheCastBody) {
  for (const int parts : {1, 2, 3}) {
    SCOPED_TRACE(parts);
    for (const Polycube& body : {meshes::bar(1), meshes::full_cube(3), meshes::menger_sponge(), quadruped()}) {
      expect_wall_volume_of_the_cast_body(body, options(parts));
      expect_wall_volume_of_the_cast_body(body, options(parts, 1, ChamberLayout::per_phase));
    }
    expect_wall_volume_of_the_cast_body(Polycube::from_digits(4, 1, 1, "1122"), options(parts, 1, ChamberLayout::per_phase));
  }
}

TEST(HollowVoxels, HaveTheWallOfTheCastAggregate) {
  for (const int parts : {1, 2}) {
    expect_wall_volume_of_the_cast_body(meshes::plane(2), options(parts, 2));
    expect_wall_volume_of_the_cast_body(Polycube::from_digits(2, 2, 1, "1210"), options(parts, 2, ChamberLayout::per_phase));
  }
}

TEST(HollowVoxels, CountLateralWallsOfEveryVoxel) {
  const auto classes = [](const Polycube& body, std::size_t voxel) { return hollow_voxels(body, options()).wall_class[voxel]; };
  using Names = std::array<std::string_view, 3>;
  const auto names = [&](const Polycube& body, std::size_t voxel) {
    const auto c = classes(body, voxel);
    return Names{wall_class_names.at(c[0]), wall_class_names.at(c[1]), wall_class_names.at(c[2])};
  };
  EXPECT_EQ(names(meshes::bar(1), 0), (Names{"4", "4", "4"}));
  EXPECT_EQ(names(meshes::bar(3), 0), (Names{"4", "3", "3"}));
  EXPECT_EQ(names(meshes::bar(3), 1), (Names{"4", "2o", "2o"}));
  EXPECT_EQ(names(meshes::plane(2), 0), (Names{"3", "3", "2a"}));
  EXPECT_EQ(names(meshes::plane(3), 4), (Names{"2o", "2o", "0"}));
  const Polycube elbow = Polycube::from_digits(2, 2, 1, "1110");
  EXPECT_EQ(names(elbow, 0), (Names{"3", "3", "2b"}));
  EXPECT_EQ(names(elbow, 1), (Names{"4", "3", "3"}));
  EXPECT_EQ(names(meshes::menger_sponge(), 0), (Names{"2b", "2b", "2b"}));
  EXPECT_EQ(names(Polycube::from_digits(2, 2, 1, "1112"), 0), (Names{"3", "3", "2a"}));  // one chamber, whatever the phase
  EXPECT_EQ(names(meshes::full_cube(3), 0), (Names{"2a", "2a", "2a"}));                  // corner
  EXPECT_EQ(names(meshes::full_cube(3), 1), (Names{"2a", "1", "1"}));                    // on an edge along x
  EXPECT_EQ(names(meshes::full_cube(3), 4), (Names{"1", "1", "0"}));                     // in the middle of the bottom
  EXPECT_EQ(names(meshes::full_cube(3), 13), (Names{"0", "0", "0"}));                    // centre
}

/// The bulge classes without what plates change.
std::vector<std::array<std::uint8_t, 3>> walls_of_faces(const HollowVoxels& voxels) {
  std::vector<std::array<std::uint8_t, 3>> classes = voxels.bulge_class;
  for (auto& of_voxel : classes)
    for (std::uint8_t& of_face : of_voxel) of_face = static_cast<std::uint8_t>(wall_class_of(of_face));
  return classes;
}

TEST(HollowVoxels, BulgeAsThePlateThatTheyArePartOf) {
  struct Plate {
    const char* digits;  // of 3 x 3 cells
    std::size_t voxel;   // in the middle
    const char* wall_class;
    const char* bulge_class;
  };
  constexpr std::array plates{Plate{"111010000", 1, "1", "2b"},  // three arms
                              Plate{"010111010", 2, "0", "2b"},  // four
                              Plate{"111110000", 1, "1", "2a"},  // an arm beside a square of four cells
                              Plate{"011111010", 3, "0", "2a"},  // two
                              Plate{"011111011", 3, "0", "1"},   // an arm beside two squares
                              Plate{"110111011", 3, "0", "1"},   // two squares that meet in the middle
                              Plate{"011111111", 3, "0", "0"}};  // three squares
  for (const Plate& plate : plates) {
    SCOPED_TRACE(plate.digits);
    const HollowVoxels voxels = hollow_voxels(Polycube::from_digits(3, 3, 1, plate.digits), options());
    EXPECT_EQ(wall_class_names.at(voxels.wall_class[plate.voxel][2]), plate.wall_class);
    EXPECT_EQ(wall_class_names.at(walls_of_faces(voxels)[plate.voxel][2]), plate.bulge_class);
  }
}

TEST(HollowVoxels, FollowTheLawsOfThePlateThatTheyArePartOf) {
  struct Case {
    const char* why;
    const char* digits;  // of 3 x 3 x 2 cells
    std::size_t voxel;
    std::array<std::size_t, 3> beams;
    std::size_t face;  // across z
  };
  constexpr std::size_t one = walls::one;
  constexpr std::size_t corner = walls::corner;
  constexpr std::size_t limb = walls::limb;
  const std::array cases{Case{"corner of a plate", "111111111", 0, {plate_edge, plate_edge, corner}, corner_of_plate},
                         Case{"middle of an edge", "111111111", 1, {plate_edge, inside_plate, one}, side_of_plate},
                         Case{"middle of a plate", "111111111", 4, {inside_plate, inside_plate, walls::none}, middle_of_plate},
                         Case{"corner of a square", "110110000", 0, {plate_edge, plate_edge, corner}, corner_of_plate},
                         Case{"middle of a bar", "111000000", 1, {walls::closed, limb, limb}, limb},
                         Case{"where a tee branches", "111010000", 1, {walls::three, limb, one}, walls::bend},
                         Case{"middle of a cross", "010111010", 2, {limb, limb, walls::none}, walls::bend},
                         Case{"where an arm leaves a square", "110111000", 3, {walls::three, beside_arm, one}, corner_with_arm},
                         Case{"where two arms leave it", "010111011", 2, {limb, limb, walls::none}, corner_with_two_arms},
                         Case{"where an arm leaves a slab", "011111011", 3, {limb, beside_arm, walls::none}, side_with_arm},
                         Case{"where two squares meet", "110111011", 3, {beside_arm, beside_arm, walls::none}, side_of_plate},
                         // Upper layers: the limbs of the lower one leave the plate.
                         Case{"between two legs", "101000000111111111", 3, {plate_edge, limb, one}, one},
                         Case{"beside one leg", "100000000111111111", 2, {plate_edge, inside_plate, one}, side_of_plate},
                         Case{"corner above no leg", "100000000111111111", 3, {plate_edge, plate_edge, corner}, corner_of_plate},
                         Case{"middle, with legs in the corners",
                              "101000101111111111",
                              8,
                              {inside_plate, inside_plate, walls::none},
                              middle_of_plate}};
  for (const Case& one_case : cases) {
    SCOPED_TRACE(one_case.why);
    const bool is_flat = std::string_view(one_case.digits).size() == 9;
    const HollowVoxels voxels = hollow_voxels(Polycube::from_digits(3, 3, is_flat ? 1 : 2, one_case.digits), options());
    const auto& found = voxels.size_class[one_case.voxel];
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(law_class_text(found[axis]), law_class_text(one_case.beams[axis])) << axis;
    EXPECT_EQ(law_class_text(voxels.bulge_class[one_case.voxel][2]), law_class_text(one_case.face));
  }
  const HollowVoxels refined = hollow_voxels(meshes::plane(3), options(2));
  EXPECT_EQ(refined.size_class, refined.wall_class) << "no voxel of half a cell has both walls of a plate";
  const HollowVoxels modules = hollow_voxels(meshes::plane(2), options(1, 2));
  for (const auto& classes : modules.size_class) EXPECT_EQ(classes[0], plate_edge) << "each module is a plate of its own";
}

TEST(HollowVoxels, AreOfPlatesThatGoOnRoundAnEdge) {
  // Two plates of 2 x 2 cells at a right angle: the lower layer is one, the row y = 0 the other.
  const HollowVoxels gutter = hollow_voxels(Polycube::from_digits(2, 2, 2, "11111100"), options());
  const auto half_along_x = [&](std::size_t voxel) { return law_class_text(gutter.half_class[voxel][0]); };
  EXPECT_EQ(half_along_x(0), law_class_text(inner_edge));
  EXPECT_EQ(half_along_x(2), law_class_text(plate_edge)) << "of the lower plate, which the other one does not hold";
  EXPECT_EQ(half_along_x(4), law_class_text(plate_edge)) << "of the upright one";
  EXPECT_EQ(law_class_text(gutter.bulge_class[0][2]), law_class_text(corner_of_plate)) << "below the edge";
  EXPECT_EQ(law_class_text(gutter.bulge_class[2][2]), law_class_text(corner_of_plate));
  // A block of 2 x 2 x 2 cells has no plate, and neither has a tube with an elbow.
  for (const char* const digits : {"11111111", "11101000"}) {
    const HollowVoxels others = hollow_voxels(Polycube::from_digits(2, 2, 2, digits), options());
    for (const auto& of_voxel : others.half_class)
      for (const std::uint8_t c : of_voxel) EXPECT_LT(c, wall_class_count) << digits;
    for (const auto& of_voxel : others.bulge_class)
      for (const std::uint8_t c : of_voxel) EXPECT_LT(c, wall_class_count) << digits;
  }
}

TEST(HollowVoxels, HaveTheSameClassesInMirrorImagesAndTurned) {
  // A step with an arm and a notch: all kinds of halves and faces.
  const std::array<int, 3> size{3, 3, 2};
  const Polycube body = Polycube::from_digits(3, 3, 2, "111111011111000000");
  const HollowVoxels found = hollow_voxels(body, options());
  const std::vector<meshes::CellIndex> cells = found.body.occupied();
  constexpr std::array<std::array<std::size_t, 3>, 3> orders{{{0, 1, 2}, {1, 2, 0}, {1, 0, 2}}};
  for (const auto& order : orders) {
    for (const bool mirrored : {false, true}) {
      // Axis a of the image is axis order[a] of the body, and its first axis may run backwards.
      const auto image_of = [&](const meshes::CellIndex& cell) {
        const std::array<int, 3> place{cell.x, cell.y, cell.z};
        std::array<int, 3> image{place[order[0]], place[order[1]], place[order[2]]};
        if (mirrored) image[0] = size[order[0]] - 1 - image[0];
        return meshes::CellIndex{image[0], image[1], image[2]};
      };
      Polycube other(size[order[0]], size[order[1]], size[order[2]]);
      for (const meshes::CellIndex& cell : cells) other.set(image_of(cell), body.at(cell));
      const HollowVoxels image = hollow_voxels(other, options());
      const std::vector<meshes::CellIndex> images = image.body.occupied();
      for (std::size_t v = 0; v < cells.size(); ++v) {
        const auto w = static_cast<std::size_t>(std::ranges::find(images, image_of(cells[v])) - images.begin());
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(image.size_class[w][axis], found.size_class[v][order[axis]]);
          EXPECT_EQ(image.bulge_class[w][axis], found.bulge_class[v][order[axis]]);
          for (std::size_t end = 0; end < 2; ++end) {
            const std::size_t of_body = mirrored && axis == 0 ? 1 - end : end;
            EXPECT_EQ(image.half_class[w][2 * axis + end], found.half_class[v][2 * order[axis] + of_body]);
          }
        }
      }
    }
  }
}

TEST(HollowVoxels, HaveHalvesOfTheirChamberAndOfTheirModule) {
  // A slab of two chambers of 1 x 2 and 2 x 2 cells: the plate ends at the wall between them.
  const HollowVoxels chambers = hollow_voxels(
      Polycube::from_digits(3, 2, 1, "211211"),
      {.cell_edge_m = 0.01, .wall_thickness_m = 0.002, .voxels_per_cell = 1, .chambers = meshes::ChamberLayout::per_phase});
  EXPECT_EQ(law_class_text(chambers.half_class[0][3]), law_class_text(walls::closed)) << "a bar of two cells";
  EXPECT_EQ(law_class_text(chambers.half_class[1][3]), law_class_text(plate_edge));
  const HollowVoxels modules = hollow_voxels(meshes::plane(2), options(1, 2));
  for (const auto& of_voxel : modules.half_class) EXPECT_EQ(of_voxel[0], plate_edge);
}

TEST(HollowVoxels, HaveTheSizeOfTheHalfThatIsDrawnInLess) {
  const HollowVoxels notched = hollow_voxels(Polycube::from_digits(3, 3, 1, "111111110"), options());
  const std::size_t middle = 4;
  EXPECT_EQ(law_class_text(notched.half_class[middle][0]), law_class_text(inside_plate));
  EXPECT_EQ(law_class_text(notched.half_class[middle][1]), law_class_text(beside_arm));
  EXPECT_EQ(law_class_text(notched.size_class[middle][0]), law_class_text(beside_arm));
}

TEST(HollowVoxels, HaveHalvesThatFollowTheLawsOfThePlateOnTheirSide) {
  constexpr std::size_t limb = walls::limb;
  constexpr std::size_t three = walls::three;
  struct Case {
    const char* why;
    const char* digits;  // of 3 x 3 x 1 cells
    std::size_t voxel;
    std::array<std::size_t, 4> halves;  // -x, +x, -y, +y
  };
  for (const Case& one_case :
       {Case{"an arm leaves a slab towards -x", "011111011", 3, {limb, inside_plate, beside_arm, beside_arm}},
        Case{"an arm leaves a square towards +x", "110111000", 3, {plate_edge, three, beside_arm, beside_arm}},
        Case{"up to a wall as on the other side", "111111000", 1, {plate_edge, plate_edge, inside_plate, inside_plate}},
        Case{"two squares meet", "110111011", 3, {beside_arm, beside_arm, beside_arm, beside_arm}}}) {
    SCOPED_TRACE(one_case.why);
    const HollowVoxels voxels = hollow_voxels(Polycube::from_digits(3, 3, 1, one_case.digits), options());
    for (std::size_t side = 0; side < one_case.halves.size(); ++side)
      EXPECT_EQ(law_class_text(voxels.half_class[one_case.voxel][side]), law_class_text(one_case.halves[side])) << side;
  }
}

TEST(HollowVoxels, BulgeByTheirWallsWhereNothingButSquaresAndLimbsMeet) {
  // Bodies without arms, which calibrations see: their parameters do not depend on how arms are told apart.
  const Polycube slab = Polycube::from_digits(3, 2, 1, "111111");
  const Polycube elbow = Polycube::from_digits(2, 2, 1, "1110");
  const Polycube tripod = Polycube::from_digits(2, 2, 2, "11101000");
  for (const Polycube& body : {meshes::bar(1), meshes::bar(3), meshes::plane(2), slab, elbow, tripod, meshes::full_cube(3)}) {
    for (const int parts : {1, 2}) {
      const HollowVoxels voxels = hollow_voxels(body, options(parts));
      EXPECT_EQ(walls_of_faces(voxels), voxels.wall_class) << body.digits() << ", " << parts;
    }
  }
  const HollowVoxels modules = hollow_voxels(meshes::bar(2), options(1, 2));
  EXPECT_EQ(modules.bulge_class, modules.wall_class);
  // Of cells of several voxels no arm is as narrow as a voxel.
  const HollowVoxels refined = hollow_voxels(Polycube::from_digits(3, 3, 1, "010111010"), options(2));
  EXPECT_EQ(refined.bulge_class, refined.wall_class);
}

TEST(HollowVoxels, SeeWallsBetweenChambersAndModules) {
  const Polycube two_phases = Polycube::from_digits(2, 1, 1, "12");
  const HollowVoxels single = hollow_voxels(two_phases, options());
  const HollowVoxels apart = hollow_voxels(two_phases, options(1, 1, ChamberLayout::per_phase));
  EXPECT_EQ(single.chamber, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(apart.chamber, (std::vector<std::size_t>{0, 1}));
  EXPECT_FALSE(single.walled[0][1]);
  EXPECT_TRUE(apart.walled[0][1]);
  EXPECT_TRUE(apart.walled[1][0]);
  // Level 2 of a bar of two cells is four cells in two modules with a joint in the middle.
  const HollowVoxels modules = hollow_voxels(meshes::bar(2), options(1, 2));
  EXPECT_EQ(modules.chamber, (std::vector<std::size_t>{0, 0, 1, 1}));
  EXPECT_EQ(modules.walled[1], (std::array<bool, 6>{false, true, true, true, true, true}));
}

TEST(HollowVoxels, OfARefinedCellSeeWallsOnTheirOwnSidesOnly) {
  const HollowVoxels voxels = hollow_voxels(meshes::bar(1), options(3));
  ASSERT_EQ(voxels.body.count(), 27U);
  EXPECT_EQ(voxels.walled[0], (std::array<bool, 6>{true, false, true, false, true, false}));
  EXPECT_EQ(voxels.walled[13], (std::array<bool, 6>{}));
  EXPECT_DOUBLE_EQ(voxels.wall_volume_m3[13], 0.0);
  EXPECT_DOUBLE_EQ(voxels.inertia_factor[13], 1.0);
}

TEST(HollowVoxels, HaveTheInertiaOfAHollowCube) {
  const double inside = voxel_edge - 2.0 * wall;
  const double hollow = (std::pow(voxel_edge, 5) - std::pow(inside, 5)) / (std::pow(voxel_edge, 3) - std::pow(inside, 3));
  EXPECT_NEAR(hollow_voxels(meshes::bar(1), options()).inertia_factor[0], hollow / (voxel_edge * voxel_edge), 1e-13);
}

TEST(HollowVoxels, RefuseWallsThatLeaveNoChamber) {
  EXPECT_THROW(hollow_voxels(meshes::bar(1), {voxel_edge, 0.5 * voxel_edge, 1, 1, ChamberLayout::single}), std::invalid_argument);
  EXPECT_THROW(hollow_voxels(meshes::bar(1), {voxel_edge, 0.0, 1, 1, ChamberLayout::single}), std::invalid_argument);
  EXPECT_THROW(hollow_voxels(meshes::bar(1), {voxel_edge, wall, 0, 1, ChamberLayout::single}), std::invalid_argument);
}

TEST(VoxelMasses, KeepTheMassOfTheBodyAndLeaveNoVoxelWithout) {
  const HollowVoxels voxels = hollow_voxels(meshes::full_cube(3), options(2));
  const double density = 1070.0;
  const double total = density * sum(voxels.wall_volume_m3);
  const std::vector<double> masses = voxel_masses(voxels, density);
  EXPECT_NEAR(sum(masses), total, 1e-13 * total);
  const double smallest = 0.1 * total / static_cast<double>(masses.size());
  for (const double mass : masses) EXPECT_GE(mass, smallest * (1.0 - 1e-14));
  EXPECT_NEAR(masses[6 * 6 * 2 + 6 * 2 + 2], smallest, 1e-14 * total);  // in the middle, without a wall
}

TEST(VoxelMasses, AreThoseOfTheWallWhereNoneIsTooSmall) {
  const HollowVoxels voxels = hollow_voxels(meshes::bar(3), options());
  const std::vector<double> masses = voxel_masses(voxels, 2.0);
  for (std::size_t i = 0; i < masses.size(); ++i) EXPECT_DOUBLE_EQ(masses[i], 2.0 * voxels.wall_volume_m3[i]);
}

}  // namespace
}  // namespace menger::voxel
