#include "voxel/model/wall_openings.h"

#include <gtest/gtest.h>

#include <numeric>

#include "meshes/design/reference_shapes.h"
#include "tests/support/surrogate_example.h"
#include "voxel/lanes/simulation.h"

namespace menger::voxel {
namespace {

constexpr double cell_edge = 0.01;
constexpr std::size_t below = 4;
constexpr std::size_t above = 5;

using Openings = std::vector<std::array<WallOpening, 6>>;

Openings openings_of(const meshes::Polycube& body, meshes::ChamberLayout chambers = meshes::ChamberLayout::single,
                     int voxels_per_cell = 1) {
  const HollowVoxels voxels = hollow_voxels(
      body, {.cell_edge_m = cell_edge, .wall_thickness_m = 0.002, .voxels_per_cell = voxels_per_cell, .chambers = chambers});
  return wall_openings(Lattice(voxels.body), voxels, voxels_per_cell);
}

double total(const ByLawClass<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The share of the four corners of an opening that lie in a plate.
double share(const WallOpening& opening) { return total(opening.lift); }

double total(const Openings& openings) {
  double sum = 0.0;
  for (const auto& of_voxel : openings) {
    for (const WallOpening& opening : of_voxel) sum += share(opening);
  }
  return sum;
}

/// A plate of 3 x 3 cells, a neck and another plate.
const meshes::Polycube spool = meshes::Polycube::from_digits(3, 3, 3, "111111111000010000111111111");

TEST(WallOpenings, LieWhereALimbLeavesAPlate) {
  const auto of_spool = openings_of(spool);
  EXPECT_DOUBLE_EQ(share(of_spool[4][above]), 1.0);
  EXPECT_DOUBLE_EQ(share(of_spool[14][below]), 1.0);
  EXPECT_DOUBLE_EQ(total(of_spool), 2.0) << "and nowhere else: not at the neck's own ends";
  const auto at_edge = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111000100000"));
  EXPECT_DOUBLE_EQ(share(at_edge[3][above]), 0.5);
  const auto at_corner = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111100000000"));
  EXPECT_DOUBLE_EQ(share(at_corner[0][above]), 0.25);
}

TEST(WallOpenings, LieInNoBodyWithoutPlates) {
  for (const meshes::Polycube& body :
       {meshes::bar(3), meshes::full_cube(3), meshes::menger_sponge(), meshes::Polycube::from_digits(3, 2, 1, "111010")})
    EXPECT_EQ(total(openings_of(body)), 0.0);
}

TEST(WallOpenings, NeedAPlateOfTheirChamber) {
  const meshes::Polycube two = meshes::Polycube::from_digits(2, 2, 2, "11221000");
  EXPECT_EQ(share(openings_of(two)[0][above]), 0.25);
  EXPECT_EQ(total(openings_of(two, meshes::ChamberLayout::per_phase)), 0.0);
}

TEST(WallOpenings, TiltWhereALimbLeavesAPlateOffItsMiddle) {
  constexpr std::size_t about_x = 0;  // u and v of a side across z are x and y
  constexpr std::size_t about_y = 1;
  const auto of_spool = openings_of(spool);
  EXPECT_FALSE(has_tilted_limbs(of_spool)) << "in the middle of both plates";
  // At the edge of the plate with the least x, its height falls towards -x, so a limb above leans to -x: turned about -y.
  const WallOpening at_edge = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111000100000"))[3][above];
  EXPECT_DOUBLE_EQ(total(at_edge.turn[about_y]), -1.0);
  EXPECT_DOUBLE_EQ(total(at_edge.turn[about_x]), 0.0);
  // Of the voxels around both crowns, one side each is of the corner, the edge itself, another edge, and the middle.
  EXPECT_DOUBLE_EQ(at_edge.turn[about_y][middle_of_plate], -0.25);
  EXPECT_DOUBLE_EQ(at_edge.turn[about_y][side_of_plate], -0.25);
  EXPECT_DOUBLE_EQ(at_edge.turn[about_y][walls::one], -0.25);
  EXPECT_DOUBLE_EQ(at_edge.turn[about_y][walls::corner], -0.25);
  const WallOpening at_corner = openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111100000000"))[0][above];
  EXPECT_DOUBLE_EQ(total(at_corner.turn[about_x]), 0.5);
  EXPECT_DOUBLE_EQ(total(at_corner.turn[about_y]), -0.5);
  // The same plate with the limb below. The plate, at the upper end of the beam, is turned against the limb.
  const WallOpening below_edge = openings_of(meshes::Polycube::from_digits(3, 3, 2, "000100000111111111"))[4][below];
  EXPECT_DOUBLE_EQ(total(below_edge.turn[about_y]), -1.0);
  EXPECT_FALSE(has_tilted_limbs(
      openings_of(meshes::Polycube::from_digits(3, 3, 2, "111111111000100000"), meshes::ChamberLayout::single, 2)))
      << "beams side by side tilt a limb by their lengths";
}

TEST(WallOpenings, LiftWhatRidesOnTheDomesOfASpool) {
  constexpr double pressure_Pa = 1500.0;
  Physics physics;
  physics.surrogate = CalibratedBody{.parameters = tests::surrogate_example()};
  SurrogateParameters& p = physics.surrogate->parameters;
  p.lateral_coupling = 0.0;
  p.bulge[walls::none].slope_per_Pa = 5e-5;
  p.neck_ratio = 1.4;
  physics.surrogate->pressure_Pa = {pressure_Pa, pressure_Pa};
  physics.actuation.mode = ActuationMode::hold;
  physics.actuation.ramp_s = 0.2;
  physics.floor = false;
  physics.gravity_m_s2 = 0.0;
  physics.damping_ratios.global = 0.02;
  physics.collisions.exclusion_depth.reset();
  Simulation simulation(spool, cell_edge, physics);
  ASSERT_EQ(simulation.advance_to(2.0), io::RunStatus::completed);
  // Two beams that nothing strains: half a cell without walls beside it, half a neck, and the dome.
  const double half_plate = 0.5 * cell_edge * (1.0 + p.extension[walls::none].value(pressure_Pa));
  const double half_neck = 0.5 * cell_edge * (1.0 + p.extension[walls::closed].value(pressure_Pa));
  const auto peak = [&](std::size_t c) { return cell_edge * p.bulge_peak_ratio[c] * p.bulge[c].value(pressure_Pa); };
  const double dome = p.neck_ratio * (peak(walls::none) + 2.0 * peak(walls::one) + peak(walls::corner)) / 4.0;
  EXPECT_GT(dome, 0.05 * cell_edge);
  EXPECT_NEAR(simulation.position_m(14)[2] - simulation.position_m(4)[2], 2.0 * (half_plate + half_neck + dome),
              1e-7 * cell_edge);
}

}  // namespace
}  // namespace menger::voxel
