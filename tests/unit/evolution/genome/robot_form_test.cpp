#include "evolution/genome/robot_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace menger::evolution {
namespace {

using meshes::Polycube;

/// Returns a body from its layers, the lowest first.
Polycube layers(const std::string& first, const std::string& second = "000000000", const std::string& third = "000000000") {
  return Polycube::from_digits(3, 3, 3, first + second + third);
}

TEST(RobotForm, BodiesAreLetDownToTheGround) {
  EXPECT_EQ(standing(layers("000000000", "120000000", "010000000")), layers("120000000", "010000000"));
  EXPECT_EQ(standing(layers("100000000")), layers("100000000"));
}

TEST(RobotForm, ARobotIsTheSameTurnedMirroredAndElsewhere) {
  // an L of four cells with a second storey, a chiral body
  const Polycube body = layers("111100000", "001000000");
  const Polycube quarter = layers("110010010", "000000010");
  const Polycube mirrored = layers("111001000", "100000000");
  const Polycube elsewhere = layers("000111100", "000001000");
  const Polycube lifted = layers("000000000", "111100000", "001000000");
  for (const bool materials : {true, false}) {
    const Distinction distinction{.materials = materials, .place = false};
    const std::string form = robot_form(body, distinction);
    for (const Polycube& same : {quarter, mirrored, elsewhere, lifted}) EXPECT_EQ(robot_form(same, distinction), form);
    EXPECT_NE(robot_form(layers("111100000", "010000000"), distinction), form);
    EXPECT_NE(robot_form(layers("111010000", "001000000"), distinction), form);
  }
}

TEST(RobotForm, MaterialsAndPlaceCountWhereTheDriveKnowsThem) {
  const Polycube one = layers("112000000");
  const Polycube other = layers("121000000");
  EXPECT_NE(robot_form(one, {.materials = true}), robot_form(other, {.materials = true}));
  EXPECT_EQ(robot_form(one, {.materials = false}), robot_form(other, {.materials = false}));
  EXPECT_EQ(robot_form(one, {.materials = true}), robot_form(layers("211000000"), {.materials = true}));
  EXPECT_NE(robot_form(one, {.place = true}), robot_form(layers("211000000"), {.place = true}));
  EXPECT_EQ(robot_form(one, {.place = true}), robot_form(layers("000000000", "112000000"), {.place = true}));
}

/// Returns the cells of a body as offsets from its lowest corner, to compare bodies in different places.
std::set<std::string> cells_of(const Polycube& body, int lowest_z) {
  std::set<std::string> cells;
  for (const meshes::CellIndex& cell : body.occupied())
    cells.insert(std::to_string(cell.x) + " " + std::to_string(cell.y) + " " + std::to_string(cell.z - lowest_z));
  return cells;
}

TEST(RobotForm, AggregatesOfAStandingPhenotypeAreThoseOfThePhenotypeMovedDown) {
  const Polycube lifted = layers("000000000", "110010000", "010000000");
  const Polycube high = layers("000000000", "000000000", "111000000");
  for (const Phenotype& phenotype : {Phenotype{lifted, {}, {}}, Phenotype{lifted, high, lifted}}) {
    for (const int level : {1, 2, 3}) {
      const Polycube as_grown = aggregate(phenotype, level);
      const Polycube stands = aggregate(standing(phenotype), level);
      EXPECT_EQ(stands, standing(as_grown)) << "level " << level;
      const int lowest = std::ranges::min(as_grown.occupied(), {}, &meshes::CellIndex::z).z;
      EXPECT_GT(lowest, 0);
      EXPECT_EQ(cells_of(stands, 0), cells_of(as_grown, lowest));
    }
  }
}

TEST(RobotForm, TheFormIsOneOfEightPoses) {
  const Polycube chiral = layers("111100000", "001000000");
  const std::vector<std::string> poses = robot_poses(chiral, {.materials = false});
  EXPECT_EQ(std::set<std::string>(poses.begin(), poses.end()).size(), 8U);
  EXPECT_NE(std::ranges::find(poses, robot_form(chiral, {.materials = false})), poses.end());
  EXPECT_EQ(robot_poses(chiral, {.place = true}).size(), 1U);
}

}  // namespace
}  // namespace menger::evolution
