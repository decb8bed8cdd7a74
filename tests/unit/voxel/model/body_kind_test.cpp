#include "voxel/model/body_kind.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "meshes/design/design_file.h"

namespace menger::voxel {
namespace {

using meshes::Polycube;

BodyKind kind(int nx, int ny, int nz, const std::string& digits) { return kind_of(Polycube::from_digits(nx, ny, nz, digits), 1); }

BodyKind kind_of_design(const std::string& name) {
  return kind_of(meshes::read_design(std::string(MENGER_SOURCE_DIR "/meshes/designs/") + name + ".toml").body, 1);
}

TEST(BodyKind, IsLimbsWithoutASquareOfCells) {
  EXPECT_EQ(kind(1, 1, 1, "1"), BodyKind::limbs);
  EXPECT_EQ(kind(3, 1, 1, "121"), BodyKind::limbs);
  EXPECT_EQ(kind(2, 2, 2, "11101000"), BodyKind::limbs) << "a tripod";
  EXPECT_EQ(kind(3, 3, 1, "111101111"), BodyKind::limbs) << "a ring";
  for (const char* name : {"l", "u", "s", "menger"}) EXPECT_EQ(kind_of_design(name), BodyKind::limbs) << name;
}

TEST(BodyKind, IsAFlatPlateInOneLayerAcrossAnyAxis) {
  EXPECT_EQ(kind_of_design("plane"), BodyKind::flat_plate);
  EXPECT_EQ(kind(2, 2, 1, "1111"), BodyKind::flat_plate);
  EXPECT_EQ(kind(1, 2, 2, "1121"), BodyKind::flat_plate);
  EXPECT_EQ(kind(3, 1, 3, "111110010"), BodyKind::flat_plate) << "upright, with a limb in its plane";
}

TEST(BodyKind, StandsOnLegsIfItsLowestLayerIsInNoSquare) {
  for (const char* name : {"quadruped", "uneven_quadruped"}) EXPECT_EQ(kind_of_design(name), BodyKind::plate_on_legs) << name;
  EXPECT_EQ(kind(3, 3, 3, "000101000000101000111111111"), BodyKind::plate_on_legs) << "legs of two cells";
  EXPECT_EQ(kind(3, 3, 3, "000000000000101000111111111"), BodyKind::plate_on_legs) << "an empty layer below";
}

TEST(BodyKind, IsSteppedWithAnInnerEdgeOfTwoCells) {
  EXPECT_EQ(kind(3, 3, 2, "111111111111000000"), BodyKind::stepped) << "a row on a plate";
  EXPECT_EQ(kind(3, 3, 2, "110110110111111111"), BodyKind::stepped) << "a plate that hangs over";
  EXPECT_EQ(kind(3, 3, 2, "111111111100100000"), BodyKind::stepped) << "a row of two along the other axis";
  EXPECT_EQ(kind(2, 2, 2, "11111010"), BodyKind::stepped) << "a gutter";
  EXPECT_EQ(kind(2, 2, 2, "11101110"), BodyKind::stepped) << "an upright one";
  EXPECT_EQ(kind(3, 2, 2, "110000111111"), BodyKind::stepped) << "legs side by side";
  EXPECT_EQ(kind(3, 3, 2, "111101111111101111"), BodyKind::stepped) << "a frame of two layers";
  EXPECT_NE(kind(3, 2, 2, "100000111111"), BodyKind::stepped) << "one leg";
  EXPECT_NE(kind(3, 3, 1, "111111110"), BodyKind::stepped) << "one layer";
}

TEST(BodyKind, TellsAPlateWithLimbsFromABlock) {
  EXPECT_EQ(kind(3, 3, 2, "111111111000010000"), BodyKind::plate_with_limbs);
  EXPECT_EQ(kind(3, 3, 3, "111111111000010000111111111"), BodyKind::plate_with_limbs);
  EXPECT_EQ(kind(3, 3, 3, "000000000111111111000010000"), BodyKind::plate_with_limbs) << "an empty layer below";
  EXPECT_EQ(kind_of_design("block"), BodyKind::block);
  EXPECT_EQ(kind(2, 2, 2, "11111111"), BodyKind::block);
}

TEST(BodyKind, IsAnAggregateAboveLevelOne) {
  EXPECT_EQ(kind_of(Polycube::from_digits(2, 2, 1, "1111"), 2), BodyKind::aggregate_of_plates);
  EXPECT_EQ(kind_of(Polycube::from_digits(2, 2, 1, "1110"), 2), BodyKind::aggregate_of_limbs);
  EXPECT_EQ(kind_of(Polycube::from_digits(1, 1, 1, "1"), 2), BodyKind::aggregate_of_limbs);
  EXPECT_EQ(kind_of(Polycube::from_digits(2, 2, 2, "11111010"), 2), BodyKind::aggregate_of_stepped_bodies);
}

TEST(BodyKind, IsFoundByItsName) {
  std::set<std::string_view> names;
  for (const BodyKind kind : body_kinds) {
    EXPECT_EQ(body_kind(to_string(kind)), kind);
    names.insert(to_string(kind));
    names.insert(name_of(kind));
    names.insert(plural_name(kind));
  }
  EXPECT_EQ(names.size(), 3 * body_kind_count);
  EXPECT_FALSE(body_kind("table"));
}

}  // namespace
}  // namespace menger::voxel
