#include "voxel/engine/time_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/design/reference_shapes.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

TEST(RecommendedTimeStep, IsThatOfThePaper) {
  // The public engine gives 5.0329214e-5 s in single precision.
  EXPECT_NEAR(recommended_time_step_s(meshes::bar(3), 0.01, Physics{}), 5.0329214e-5, 1e-11);
  Physics physics;
  EXPECT_DOUBLE_EQ(Simulation(meshes::bar(3), 0.01, physics).time_step_s(),
                   0.9 * recommended_time_step_s(meshes::bar(3), 0.01, physics));
}

TEST(RecommendedTimeStep, TakesTheHarmonicStiffnessOverTheLighterEnd) {
  Physics physics;
  physics.materials[1].youngs_modulus_Pa = 3e4;
  physics.materials[1].density_kg_m3 = 1000.0;
  physics.collisions.exclusion_depth.reset();
  const double k_over_m = 1.5e4 * 0.01 / (10.0 * 1e-6);
  EXPECT_NEAR(recommended_time_step_s(meshes::Polycube::from_digits(2, 1, 1, "12"), 0.01, physics) *
                  (2.0 * std::numbers::pi * std::sqrt(k_over_m)),
              1.0, 1e-14);
}

/// A plate of the first material on four feet of the second one, each of one voxel.
meshes::Polycube table_on_feet() { return meshes::Polycube::from_digits(3, 3, 2, "202000202111111111"); }

Physics with_stiffer_feet(double ratio) {
  Physics physics;
  physics.materials[1].youngs_modulus_Pa *= ratio;
  return physics;
}

Physics without_contacts(Physics physics) {
  physics.floor = false;
  physics.collisions.exclusion_depth.reset();
  return physics;
}

TEST(RecommendedTimeStep, IsStableForAStiffFootOfASoftBody) {
  for (const double ratio : {10.0, 100.0, 1000.0, 1e6}) {
    const Physics physics = with_stiffer_feet(ratio);
    const double own = std::sqrt(1e7 * ratio);  // sqrt(E L / m), 1/s
    const double step_s = recommended_time_step_s(table_on_feet(), 0.01, physics);
    EXPECT_NEAR(step_s * (2.0 * std::numbers::pi * own), 1.0, 1e-14) << ratio;
    // The floor: 2 E L, and 2 zeta_c sqrt(m E L) with zeta_c = 0.8.
    const double limit_s = largest_contact_step_s(2.0 * own * own, 1.6 * own);
    EXPECT_NEAR(limit_s * own, std::sqrt(2.64) - 0.8, 1e-12);
    EXPECT_LT(step_s, 0.2 * limit_s);
    // The beam between foot and body is hardly stiffer than the body: alone it would let feet of more than 66 times its modulus
    // hop, at 0.9 of the step.
    const double of_beams_s = recommended_time_step_s(table_on_feet(), 0.01, without_contacts(physics));
    EXPECT_EQ(0.9 * of_beams_s > limit_s, ratio > 66.5) << ratio;
  }
  Physics colliding = with_stiffer_feet(100.0);
  colliding.floor = false;
  EXPECT_EQ(recommended_time_step_s(table_on_feet(), 0.01, colliding),
            recommended_time_step_s(table_on_feet(), 0.01, with_stiffer_feet(100.0)))
      << "voxels collide with that stiffness, too";
}

TEST(RecommendedTimeStep, OfOneModulusIsThatOfTheBeams) {
  // To the last digit: the mean of a modulus with itself may be rounded.
  for (const double modulus_Pa : {1e4, 12345.678, 0.1, 3e4 / 7.0, 1.1e5 / 3.0}) {
    Physics physics;
    for (VoxelMaterial& material : physics.materials) {
      material.youngs_modulus_Pa = modulus_Pa;
      material.density_kg_m3 = 1070.0 / 3.0;
    }
    physics.integration.damping = DampingMode::velocity;
    physics.materials[1].static_friction = 0.1;
    const VoxelMaterial& material = physics.materials[0];
    const double largest = beam_modulus_Pa(material, material) * 0.01 / voxel_mass_kg(material, 0.01);
    const double of_beams_s = 1.0 / (2.0 * std::numbers::pi * std::sqrt(largest));
    for (const double damping : {0.3, 1.0}) {
      physics.damping_ratios.bond = physics.damping_ratios.collision = damping;
      EXPECT_EQ(recommended_time_step_s(table_on_feet(), 0.01, physics), of_beams_s) << modulus_Pa;
      EXPECT_EQ(recommended_time_step_s(table_on_feet(), 0.01, without_contacts(physics)), of_beams_s) << modulus_Pa;
    }
    physics.damping_ratios.bond = 3.0;
    EXPECT_DOUBLE_EQ(recommended_time_step_s(table_on_feet(), 0.01, without_contacts(physics)), of_beams_s / 3.0);
  }
}

TEST(RecommendedTimeStep, IsStableForCollisionsOfLightSoftWithHeavyStiffVoxels) {
  Physics physics = with_stiffer_feet(100.0);
  physics.materials[1].density_kg_m3 *= 100.0;
  // As masses m and 100 m on a spring of 2 E L with the mean damping 0.8 sqrt(m E L) (1 + 100); E of the spring is 200/101 of
  // the soft one.
  const double per_mass = 1.01;
  const double k = 2.0 * (200.0 / 101.0) * per_mass * 1e7;
  const double c = 0.8 * 101.0 * per_mass * std::sqrt(1e7);
  const double limit_s = largest_collision_step_s(physics.materials[0], physics.materials[1], 0.01, physics);
  EXPECT_NEAR((k * limit_s + 2.0 * c) * limit_s, 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(recommended_time_step_s(table_on_feet(), 0.01, physics), 0.5 * limit_s);
  physics.collisions.exclusion_depth.reset();
  EXPECT_GT(0.9 * recommended_time_step_s(table_on_feet(), 0.01, physics), limit_s)
      << "the beams alone allow more than is stable";
}

TEST(RecommendedTimeStep, IsShorterWithStrongDampingOfContacts) {
  Physics physics;
  physics.damping_ratios.collision = 10.0;
  const double own = std::sqrt(1e7);
  const double limit_s = largest_contact_step_s(2.0 * own * own, 20.0 * own);
  EXPECT_LT(limit_s * own, 1.0 / (2.0 * std::numbers::pi)) << "of the beams";
  // Two voxels that collide move as half the mass against one.
  EXPECT_DOUBLE_EQ(recommended_time_step_s(meshes::bar(2), 0.01, physics),
                   0.5 * largest_contact_step_s(4.0 * own * own, 40.0 * own));
  physics.collisions.exclusion_depth.reset();
  EXPECT_DOUBLE_EQ(recommended_time_step_s(meshes::bar(2), 0.01, physics), 0.5 * limit_s);
  EXPECT_GT(recommended_time_step_s(meshes::bar(2), 0.01, without_contacts(physics)), limit_s);
}

TEST(RecommendedTimeStep, IsShorterWhereHeavyVoxelsDampLightOnes) {
  Physics physics = without_contacts({});
  physics.materials[1].density_kg_m3 *= 100.0;
  const auto step_s = [&] { return recommended_time_step_s(table_on_feet(), 0.01, physics); };
  const double own_s = step_s();
  physics.integration.damping = DampingMode::velocity;
  EXPECT_DOUBLE_EQ(own_s / step_s(), 0.25 * 11.0 * 1.01);
  physics.damping_ratios.bond = 0.6;
  EXPECT_DOUBLE_EQ(own_s / step_s(), 0.6 * 0.25 * 11.0 * 1.01);
  physics.damping_ratios.bond = 0.1;
  EXPECT_EQ(own_s, step_s());
  physics.damping_ratios.bond = 1.0;
  physics.integration.bond_damping = BondDamping::semi_implicit;
  EXPECT_EQ(own_s, step_s()) << "it is the ratio that is smaller then";
  physics.integration.bond_damping = BondDamping::explicit_step;
  EXPECT_LT(step_s(), own_s);
  EXPECT_EQ(recommended_time_step_s(meshes::bar(3), 0.01, physics), own_s) << "a body of the light material alone";
}

TEST(RecommendedTimeStep, OfASingleVoxelIsItsOwn) {
  EXPECT_NEAR(recommended_time_step_s(meshes::bar(1), 0.01, Physics{}), 1.0 / (2.0 * std::numbers::pi * std::sqrt(1e7)), 1e-18);
}

}  // namespace
}  // namespace menger::voxel
