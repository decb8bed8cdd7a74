#include "meshes/design/fractal.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "meshes/design/reference_shapes.h"

namespace menger::meshes {
namespace {

Polycube random_basal_body(unsigned seed) {
  std::mt19937 generator(seed);
  Polycube body(3, 3, 3);
  for (int z = 0; z < 3; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) body.set({x, y, z}, static_cast<Material>(generator() % 3));
    }
  }
  return body;
}

/// The definition by base-3 digits: occupied if the basal cell of every digit triple is; the last triple gives the material.
Material material_by_digits(const Polycube& basal, CellIndex cell, int level) {
  const Material material = basal.at({cell.x % 3, cell.y % 3, cell.z % 3});
  for (int digit = 0; digit < level; ++digit) {
    if (basal.at({cell.x % 3, cell.y % 3, cell.z % 3}) == empty) return empty;
    cell = {cell.x / 3, cell.y / 3, cell.z / 3};
  }
  return material;
}

void expect_definition(const Polycube& basal, int level) {
  const Polycube body = fractal(basal, level);
  int side = 1;
  for (int i = 0; i < level; ++i) side *= 3;
  ASSERT_EQ(body.nx(), side);
  ASSERT_EQ(body.ny(), side);
  ASSERT_EQ(body.nz(), side);
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        ASSERT_EQ(body.at({x, y, z}), material_by_digits(basal, {x, y, z}, level)) << "cell " << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(Fractal, TheBasalBodyIsFoundAgain) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Polycube body = random_basal_body(seed);
    for (int level = 1; level <= 3; ++level) EXPECT_EQ(basal_body(fractal(body, level), level), body);
  }
  const Polycube bar = Polycube::from_digits(2, 1, 1, "12");
  EXPECT_EQ(basal_body(fractal(bar, 3), 3), bar);
}

TEST(Fractal, WhatIsNoFractalHasNoBasalBody) {
  Polycube aggregate = fractal(random_basal_body(3), 2);
  const CellIndex cell = aggregate.occupied().back();
  aggregate.set(cell, aggregate.at(cell) == 1 ? Material{2} : Material{1});
  EXPECT_EQ(basal_body(aggregate, 2), std::nullopt);
  EXPECT_EQ(basal_body(Polycube(9, 9, 9), 2), std::nullopt) << "it is empty";
  EXPECT_EQ(basal_body(Polycube::from_digits(3, 1, 1, "111"), 2), std::nullopt) << "3 is no square";
}

TEST(Fractal, LevelOneIsTheBodyItself) {
  const Polycube basal = random_basal_body(1);
  EXPECT_EQ(fractal(basal, 1), basal);
}

TEST(Fractal, LevelTwoFollowsTheDigitRule) {
  for (unsigned seed = 0; seed < 20; ++seed) expect_definition(random_basal_body(seed), 2);
}

TEST(Fractal, LevelThreeFollowsTheDigitRule) {
  for (unsigned seed = 0; seed < 3; ++seed) expect_definition(random_basal_body(seed), 3);
}

TEST(Fractal, MengerSpongeHas20Then400Then8000Cells) {
  EXPECT_EQ(menger_sponge().count(), 20U);
  EXPECT_EQ(fractal(menger_sponge(), 2).count(), 400U);
  EXPECT_EQ(fractal(menger_sponge(), 3).count(), 8000U);
}

TEST(Fractal, ReplacesCellsOfAnyBodyByAnother) {
  const Polycube aggregate = Polycube::from_digits(3, 1, 1, "102");
  const Polycube body = Polycube::from_digits(1, 2, 1, "21");
  const Polycube result = replace_cells(aggregate, body);
  EXPECT_EQ(result, Polycube::from_digits(3, 2, 1, "202101"));
}

TEST(Fractal, RefusesAGridLargerThanAllowedBeforeBuildingIt) {
  EXPECT_NO_THROW(fractal(menger_sponge(), 2, 729));
  EXPECT_THROW(fractal(menger_sponge(), 2, 728), std::length_error);
  EXPECT_THROW(fractal(menger_sponge(), 1, 26), std::length_error);
  EXPECT_THROW(fractal(menger_sponge(), 7), std::length_error) << "10 GB, more than the default allows";
  EXPECT_THROW(fractal(menger_sponge(), 40), std::length_error) << "3^40 cells along an axis fit no int, (3^40)^3 no size_t";
}

TEST(Fractal, RefusesALevelBelowOne) {
  EXPECT_THROW(fractal(menger_sponge(), 0), std::invalid_argument);
  EXPECT_THROW(fractal(menger_sponge(), -1), std::invalid_argument);
}

TEST(HausdorffDimension, OfMengerSpongeIs2Point727) { EXPECT_NEAR(hausdorff_dimension(menger_sponge()), 2.727, 5e-4); }

TEST(HausdorffDimension, OfPointColumnPlaneAndCubeAreTheTopologicalOnes) {
  EXPECT_NEAR(hausdorff_dimension(Polycube::from_digits(3, 3, 3, "1" + std::string(26, '0'))), 0.0, 1e-14);
  EXPECT_NEAR(hausdorff_dimension(Polycube::from_digits(3, 3, 3, "112" + std::string(24, '0'))), 1.0, 1e-14);
  EXPECT_NEAR(hausdorff_dimension(Polycube::from_digits(3, 3, 3, std::string(9, '1') + std::string(18, '0'))), 2.0, 1e-14);
  EXPECT_NEAR(hausdorff_dimension(full_cube(3)), 3.0, 1e-14);
}

TEST(HausdorffDimension, IsTheSameAtEveryLevel) {
  EXPECT_NEAR(hausdorff_dimension(fractal(menger_sponge(), 3)), hausdorff_dimension(menger_sponge()), 1e-14);
}

TEST(HausdorffDimension, RefusesBodiesThatHaveNone) {
  EXPECT_THROW((void)hausdorff_dimension(plane(3)), std::invalid_argument);
  EXPECT_THROW((void)hausdorff_dimension(full_cube(1)), std::invalid_argument);
  EXPECT_THROW((void)hausdorff_dimension(Polycube(3, 3, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace menger::meshes
