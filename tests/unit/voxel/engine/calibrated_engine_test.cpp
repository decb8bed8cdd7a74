// What the engine makes of a calibrated body beyond its motion: cells named, sizes drawn, scales refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "voxel/engine/pressure_drive.h"
#include "voxel/engine/scale_check.h"
#include "voxel/engine/time_step.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

/// A body held at a pressure, floating.
Physics held_at(double pressure_Pa) {
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = tests::surrogate_example(), .pressure_Pa = {0.0, pressure_Pa}};
  physics.actuation.mode = ActuationMode::hold;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  return physics;
}

TEST(Divergence, NamesTheCellOfARefinedVoxel) {
  Physics physics = held_at(0.0);
  physics.surrogate->parameters.voxels_per_cell = 2;
  const meshes::Polycube body = meshes::bar(3);
  VoxelLoads loads;
  loads.force_N.assign(8 * body.count(), {0.0, 0.0, 0.0});
  // Voxels in grid order: the last of the first row of six is in the third cell.
  loads.force_N[5][0] = std::numeric_limits<double>::quiet_NaN();
  Simulation simulation(body, 0.01, physics, loads);
  ASSERT_EQ(simulation.advance(10), io::RunStatus::diverged);
  EXPECT_EQ(simulation.divergence()->voxel, 5U);
  EXPECT_EQ(simulation.divergence()->cell, (meshes::CellIndex{2, 0, 0}));
}

TEST(Frame, ShowsAHollowCellAsLongAsPressureDrivesIt) {
  constexpr double pressure_Pa = 1000.0;
  const Physics physics = held_at(pressure_Pa);
  const SurrogateParameters& p = physics.surrogate->parameters;
  const Frame frame = Simulation(meshes::bar(2), 0.01, physics).frame();
  ASSERT_EQ(frame.reach_m.size(), 2U);
  // Along the bar four walls stand beside a cell; across it three, the fourth side being open to the other cell.
  const double along = 0.005 * (1.0 + p.extension[walls::closed].value(pressure_Pa));
  const double across =
      0.005 * (1.0 + p.extension[walls::three].value(pressure_Pa)) + 0.01 * p.bulge[walls::three].value(pressure_Pa);
  const double end = along + 0.01 * p.bulge[walls::closed].value(pressure_Pa);
  const std::array<double, 6> expected{end, along, across, across, across, across};
  for (std::size_t side = 0; side < 6; ++side) EXPECT_NEAR(frame.reach_m[0][side], expected[side], 1e-12) << side;
  EXPECT_NEAR(frame.size_m[0], 2.0 * (across - 0.01 * p.bulge[walls::three].value(pressure_Pa)), 1e-12);
}

TEST(Frame, ShowsTheWallOfATeeAsNarrowAsItsArms) {
  constexpr double pressure_Pa = 1000.0;
  const Physics physics = held_at(pressure_Pa);
  const SurrogateParameters& p = physics.surrogate->parameters;
  const Frame frame = Simulation(meshes::Polycube::from_digits(3, 2, 1, "111010"), 0.01, physics).frame();
  // Three open sides make the length of the cell in the middle, but none of them lets its wall span more than an arm.
  const double length = 0.01 * (1.0 + p.extension[walls::one].value(pressure_Pa));
  EXPECT_NEAR(frame.size_m[1], length, 1e-12);
  EXPECT_NEAR(frame.reach_m[1][4], 0.5 * length + 0.01 * p.bulge[walls::bend].value(pressure_Pa), 1e-12);
}

TEST(Frame, ShowsAPlateThatRisesAndDrawsItsEdgesIn) {
  constexpr double pressure_Pa = 1000.0;
  Physics physics = held_at(pressure_Pa);
  SurrogateParameters& p = physics.surrogate->parameters;
  p.plate_stretch_ratio = 3.0;
  p.plate_draw_in = 0.2;
  p.plate_rise = 0.08;
  p.plate_draw_in_per_Pa = 1.0 / pressure_Pa;
  p.plate_edge_share = 0.25;
  Simulation simulation(meshes::plane(3), 0.01, physics);
  const Frame frame = simulation.frame();
  // Half of the draw-in and of the rise at this pressure; at the edge a quarter of it, and of what the slope is steeper by.
  const double inside = 3.0 * p.extension[walls::limb].value(pressure_Pa) - 0.1;
  const double edge = 1.5 * p.extension[walls::three].value(pressure_Pa) - 0.025;
  EXPECT_NEAR(frame.reach_m[4][0], 0.005 * (1.0 + inside), 1e-12);
  EXPECT_NEAR(frame.reach_m[0][1], 0.005 * (1.0 + edge), 1e-12);
  const auto top = [&](std::size_t wall_class, double rise) {
    return 0.005 * (1.0 + p.extension[wall_class].value(pressure_Pa)) + 0.01 * (p.bulge[wall_class].value(pressure_Pa) + rise);
  };
  EXPECT_NEAR(frame.reach_m[4][5], top(walls::none, 0.04), 1e-12);
  EXPECT_NEAR(frame.reach_m[1][5], top(walls::one, 0.04 * 0.5), 1e-12);
  EXPECT_NEAR(frame.reach_m[0][5], top(walls::corner, 0.04 * 0.25), 1e-12);
}

TEST(CollisionSize, OfAPlateMayBeLargestBeforeItIsDrawnIn) {
  // An upright plate. Only its middle follows pressure, along z: it stretches by 0.3 and is drawn in by 0.45 at the highest.
  CalibratedBody calibrated{.parameters = tests::surrogate_example(), .pressure_Pa = {0.0, 1e4}};
  SurrogateParameters& p = calibrated.parameters;
  p.extension = {};
  p.extension[walls::limb].slope_per_Pa = 3e-5;
  p.plate_draw_in = 0.9;
  p.plate_draw_in_per_Pa = 1e-4;
  const HollowVoxels voxels = calibrated_voxels(meshes::Polycube::from_digits(3, 1, 3, "111111111"), calibrated);
  ASSERT_EQ(voxels.size_class[4][2], inside_plate);
  double largest = 0.0;
  const PressureLaw inside = p.extension_of(inside_plate);
  for (int pressure_Pa = 0; pressure_Pa <= 10000; ++pressure_Pa)
    largest = std::max(largest, p.voxel_edge_m() * (1.0 + inside.value(pressure_Pa)));
  EXPECT_GT(largest, 1.02 * p.voxel_edge_m());
  EXPECT_NEAR(largest_collision_size_m(voxels, calibrated), largest, 1e-8 * largest);
  EXPECT_GE(largest_collision_size_m(voxels, calibrated), largest * (1.0 - 1e-15));
  // A drive that is ramped to a pressure passes all pressures below it.
  calibrated.pressure_Pa = {9e3, 1e4};
  EXPECT_NEAR(largest_collision_size_m(voxels, calibrated), largest, 1e-8 * largest);
  calibrated.pressure_Pa = {0.0, 1e3};
  EXPECT_DOUBLE_EQ(largest_collision_size_m(voxels, calibrated), p.voxel_edge_m() * (1.0 + inside.value(1e3)))
      << "of the end, where the plate still grows";
}

TEST(Frame, OfSolidVoxelsHasCubes) { EXPECT_TRUE(Simulation(meshes::bar(2), 0.01, Physics{}).frame().reach_m.empty()); }

TEST(ScaleCheck, RefusesAnyStiffnessThatCannotBeSteppedWith) {
  const auto problem = [](auto change, double duration_s = 1.0) {
    Physics physics = held_at(1000.0);
    change(physics.surrogate->parameters);
    return unusable_scales(physics, 0.01, duration_s);
  };
  EXPECT_EQ(problem([](SurrogateParameters&) {}), "");
  // Each alone, with the key that is to blame.
  EXPECT_NE(problem([](SurrogateParameters& p) { p.axial_Pa[2] = 1e200; }).find("axial_Pa = 1e+200"), std::string::npos);
  EXPECT_NE(problem([](SurrogateParameters& p) { p.bending_Pa[2] = 1e200; }).find("bending_Pa = 1e+200"), std::string::npos);
  EXPECT_NE(problem([](SurrogateParameters& p) { p.torsion_Pa[2] = 1e200; }).find("torsion_Pa = 1e+200"), std::string::npos);
  EXPECT_NE(problem([](SurrogateParameters& p) { p.shear_compliance_per_Pa[2] = 1e300; }), "");
  EXPECT_NE(problem([](SurrogateParameters& p) { p.joint.bending = 1e200; }), "");
  EXPECT_NE(problem([](SurrogateParameters& p) { p.ground_stiffness_N_per_m = 1e200; }).find("ground"), std::string::npos);
  EXPECT_NE(problem([](SurrogateParameters& p) { p.density_kg_m3 = 1e-200; }).find("density_kg_m3"), std::string::npos);
  // Within the range of numbers, but with steps that nobody could count.
  for (const auto stiffen :
       {+[](SurrogateParameters& p) { p.axial_Pa[2] = 1e60; }, +[](SurrogateParameters& p) { p.bending_Pa[2] = 1e60; },
        +[](SurrogateParameters& p) { p.torsion_Pa[2] = 1e60; },
        +[](SurrogateParameters& p) { p.ground_stiffness_N_per_m = 1e60; },
        +[](SurrogateParameters& p) { p.bond_damping_ratio = 1e30; }}) {
    EXPECT_NE(problem(stiffen).find("too many steps to count"), std::string::npos);
    EXPECT_EQ(problem(stiffen, 0.0), "") << "without a duration there is nothing to count";
  }
}

TEST(ScaleCheck, BlamesDampingOnlyWhereStiffnessAloneWouldLeaveAStep) {
  Physics physics = held_at(1000.0);
  SurrogateParameters& p = physics.surrogate->parameters;
  p.axial_Pa[walls::limb] = 1e60;
  p.bond_damping_ratio = 3.0;
  EXPECT_EQ(unusable_scales(physics, 0.01, 1.0).find("parameters.stiffness.axial_Pa = 1e+60"), 0U);
  p.axial_Pa[walls::limb] = 1e4;
  EXPECT_EQ(unusable_scales(physics, 0.01, 1.0), "");
  p.bond_damping_ratio = 1e30;
  EXPECT_EQ(unusable_scales(physics, 0.01, 1.0).find("parameters.damping.bond_ratio = 1e+30"), 0U);
}

TEST(ScaleCheck, RefusesWallsThatGrowBeyondAHundredEdges) {
  constexpr double pressure_Pa = 1000.0;
  const auto problem = [](auto change, double held_Pa = 1000.0) {
    Physics physics = held_at(held_Pa);
    change(physics.surrogate->parameters);
    return unusable_scales(physics, 0.01, 1.0);
  };
  const auto absurd = [](SurrogateParameters& p) { p.bulge[walls::bend] = {.slope_per_Pa = 1e10}; };
  EXPECT_EQ(problem(absurd).find("parameters.bulge.slope_per_Pa = 1e+10"), 0U) << problem(absurd);
  EXPECT_NE(problem(absurd).find("pressure_Pa = 1000"), std::string::npos) << problem(absurd);
  EXPECT_EQ(problem(absurd, 0.0), "") << "at rest nothing grows";
  // On both sides of the bound, of both laws and whichever way.
  for (const double sign : {1.0, -1.0}) {
    const auto bulge = [sign](double edges) {
      return [=](SurrogateParameters& p) {
        p.bulge[walls::one] = {.slope_per_Pa = sign * edges / pressure_Pa};
        p.bulge_peak_ratio[walls::one] = 1.0;
      };
    };
    EXPECT_EQ(problem(bulge(99.0)), "");
    EXPECT_NE(problem(bulge(101.0)).find("bulge.slope_per_Pa"), std::string::npos);
  }
  const auto extension = [](double edges) {
    return [=](SurrogateParameters& p) { p.extension[walls::none] = {.slope_per_Pa = edges / pressure_Pa}; };
  };
  EXPECT_EQ(problem(extension(99.0)), "");
  EXPECT_NE(problem(extension(101.0)).find("extension.slope_per_Pa"), std::string::npos);
  const auto peak = [](double ratio) {
    return [=](SurrogateParameters& p) {
      p.bulge[walls::one] = {.slope_per_Pa = 10.0 / pressure_Pa};
      p.bulge_peak_ratio[walls::one] = ratio;
    };
  };
  EXPECT_EQ(problem(peak(9.9)), "");
  EXPECT_NE(problem(peak(10.1)).find("bulge.peak_ratio = 10.1"), std::string::npos);
  const auto neck = [&](double ratio) {
    return [=](SurrogateParameters& p) {
      peak(5.0)(p);
      p.neck_ratio = ratio;
    };
  };
  EXPECT_EQ(problem(neck(1.9)), "");
  EXPECT_NE(problem(neck(2.1)).find("bulge.neck_ratio = 2.1"), std::string::npos);
  const auto elbow = [](double ratio) {
    return [=](SurrogateParameters& p) {
      p.extension[walls::one] = {.slope_per_Pa = 1.0 / pressure_Pa};
      p.elbow_ratio = ratio;
    };
  };
  EXPECT_EQ(problem(elbow(3.1)), "");
  EXPECT_NE(problem(elbow(3.2)).find("extension.elbow_ratio = 3.2: at pressure_Pa = "), std::string::npos) << problem(elbow(3.2));
}

TEST(ScaleCheck, RefusesPlatesThatGrowBeyondAHundredEdges) {
  Physics physics = held_at(1000.0);
  SurrogateParameters& p = physics.surrogate->parameters;
  p.plate_stretch_ratio = 99.0 / p.extension[walls::limb].value(1000.0);
  EXPECT_EQ(unusable_scales(physics, 0.01, 1.0), "");
  p.plate_stretch_ratio *= 101.0 / 99.0;
  EXPECT_NE(unusable_scales(physics, 0.01, 1.0).find("extension.plate_stretch_ratio = "), std::string::npos);
}

TEST(ScaleCheck, LeavesLawsWithoutAValueToThoseWhoKnowTheBody) {
  Physics physics = held_at(1000.0);
  physics.surrogate->parameters.bulge[walls::none] = {.slope_per_Pa = 1.0, .pressure_softening_per_Pa = 2e-3};
  EXPECT_EQ(unusable_scales(physics, 0.01, 1.0), "");
}

TEST(ScaleCheck, StepsNoCoarserThanTheBody) {
  // What is checked before the body is there may not be far from what the body will need.
  Physics physics = held_at(1000.0);
  const double step_s = recommended_time_step_s(meshes::full_cube(3), 0.01, physics);
  const double countable_s = 1e15 * physics.integration.time_step_fraction * step_s;
  EXPECT_NE(unusable_scales(physics, 0.01, 10.0 * countable_s), "");
  EXPECT_EQ(unusable_scales(physics, 0.01, 0.01 * countable_s), "");
}

}  // namespace
}  // namespace menger::voxel
