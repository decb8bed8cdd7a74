#include "voxel/model/wall_openings.h"

#include <gtest/gtest.h>

#include <numeric>

#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

constexpr double edge = 0.01;
constexpr std::size_t below = 4;
constexpr std::size_t above = 5;

std::vector<std::array<double, 6>> openings_of(const meshes::Polycube& body,
                                               meshes::ChamberLayout chambers = meshes::ChamberLayout::single) {
  const HollowVoxels voxels =
      hollow_voxels(body, {.cell_edge_m = edge, .wall_thickness_m = 0.002, .voxels_per_cell = 1, .chambers = chambers});
  return wall_openings(Lattice(voxels.body), voxels);
}

double total(const std::vector<std::array<double, 6>>& openings) {
  double sum = 0.0;
  for (const auto& of_voxel : openings) sum = std::accumulate(of_voxel.begin(), of_voxel.end(), sum);
  return sum;
}

/// A plate of 3 x 3 cells, a neck and another plate.
const meshes::Polycube spool = meshes::Polycube::from_digits(3, 3, 3, "111111111000010000111111111");

TEST(WallOpenings, LieWhereALimbLeavesAPlate) {
  const auto of_spool = openings_of(spool);
  EXPECT_DOUBLE_EQ(of_spool[4][above], 1.0);
  EXPECT_DOUBLE_EQ(of_spool[14][below], 1.0);
  EXPECT_DOUBLE_EQ(total(of_spool), 2.0) << "and nowhere else: not at the neck's own ends";
  const auto at_edge = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111000100000"));
  EXPECT_DOUBLE_EQ(at_edge[3][above], 0.5);
  const auto at_corner = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111100000000"));
  EXPECT_DOUBLE_EQ(at_corner[0][above], 0.25);
}

TEST(WallOpenings, LieInNoBodyWithoutPlates) {
  for (const meshes::Polycube& body :
       {meshes::bar(3), meshes::full_cube(3), meshes::menger_sponge(), meshes::Polycube::from_digits(3, 2, 1, "111010")})
    EXPECT_EQ(total(openings_of(body)), 0.0);
}

TEST(WallOpenings, NeedAPlateOfTheirChamber) {
  const meshes::Polycube two = meshes::Polycube::from_digits(2, 2, 2, "11221000");
  EXPECT_EQ(openings_of(two)[0][above], 0.25);
  EXPECT_EQ(total(openings_of(two, meshes::ChamberLayout::per_phase)), 0.0);
}

TEST(WallOpenings, LiftWhatRidesOnTheDomesOfASpool) {
  constexpr double pressure_Pa = 1500.0;
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = tests::surrogate_example()};
  SurrogateParameters& p = physics.surrogate->parameters;
  p.lateral_coupling = 0.0;
  p.bulge[walls::none].slope_per_Pa = 5e-5;
  physics.surrogate->pressure_Pa = {pressure_Pa, pressure_Pa};
  physics.actuation.mode = ActuationMode::hold;
  physics.actuation.ramp_s = 0.2;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.02;
  physics.collisions.exclusion_depth.reset();
  Simulation simulation(spool, edge, physics);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  // Two beams that nothing strains: half a cell without walls beside it, half a neck, and the dome.
  const double half_plate = 0.5 * edge * (1.0 + p.extension[walls::none].value(pressure_Pa));
  const double half_neck = 0.5 * edge * (1.0 + p.extension[walls::closed].value(pressure_Pa));
  const double dome = edge * p.bulge[walls::none].value(pressure_Pa);
  EXPECT_GT(dome, 0.05 * edge);
  EXPECT_NEAR(simulation.position_m(14)[2] - simulation.position_m(4)[2], 2.0 * (half_plate + half_neck + dome), 1e-7 * edge);
}

}  // namespace
}  // namespace menger::voxel
