#include "fem/statics/dead_load.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshes/hexahedra/verification_shapes.h"
#include "tests/unit/fem/statics/body_samples.h"

namespace menger::fem {
namespace {

Point total_of(const std::vector<double>& load) {
  Point total{};
  for (std::size_t n = 0; n < load.size(); ++n) total[n % 3] += load[n];
  return total;
}

/// Moment of the loads about the origin.
Point moment_of(const Space& space, const std::vector<double>& load) {
  Point moment{};
  for (std::size_t a = 0; a < space.positions.size(); ++a)
    moment = sum(moment, cross(space.positions[a], {load[3 * a], load[3 * a + 1], load[3 * a + 2]}));
  return moment;
}

void expect_near(const Point& a, const Point& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance);
}

TEST(DeadLoad, OfGravityIsDensityTimesVolumeAtTheCentreOfMass) {
  const Point size{0.02, 0.03, 0.05};
  const Point gravity{1.0, -2.0, -9.81};
  for (const int degree : {1, 2}) {
    const Space space = make_space(meshes::box(size, {2, 3, 1}), degree, 0, MPI_COMM_SELF);
    Body body;
    body.regions = {{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1070.0}};
    body.gravity_m_per_s2 = gravity;
    const std::vector<double> load = dead_load_of(space, body);
    const Point weight = scaled(1070.0 * size[0] * size[1] * size[2], gravity);
    expect_near(total_of(load), weight, 1e-14);
    expect_near(moment_of(space, load), cross(scaled(0.5, size), weight), 1e-15);
  }
}

TEST(DeadLoad, CountsTheDensityOfEveryRegion) {
  meshes::HexahedralMesh mesh = meshes::box({2e-2, 1e-2, 1e-2}, {2, 1, 1});
  mesh.region_names = {"wall", "lid"};
  mesh.regions = {0, 1};
  Body body;
  body.regions = {{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1000.0},
                  {materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 3000.0}};
  body.gravity_m_per_s2 = {0.0, 0.0, -10.0};
  const Space space = make_space(mesh, 2, 0, MPI_COMM_SELF);
  EXPECT_NEAR(total_of(dead_load_of(space, body))[2], -10.0 * (1000.0 + 3000.0) * 1e-6, 1e-15);
}

// The octant's volume is that of quadratic elements, 1e-3 from the ball's with one element per 45 degrees.
TEST(DeadLoad, WeighsCurvedElements) {
  Body body;
  body.regions = {{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1.0}};
  body.gravity_m_per_s2 = {0.0, 0.0, -1.0};
  const double truth = -std::numbers::pi / 6.0 * (8.0 - 1.0);
  const meshes::HexahedralMesh mesh = meshes::thick_sphere_octant(1.0, 2.0, 1, 1);
  const double coarse = total_of(dead_load_of(make_space(mesh, 2, 0, MPI_COMM_SELF), body))[2] - truth;
  const double fine = total_of(dead_load_of(make_space(mesh, 2, 1, MPI_COMM_SELF), body))[2] - truth;
  EXPECT_LT(std::abs(coarse), 5e-3 * std::abs(truth));
  EXPECT_GT(coarse / fine, 8.0);  // third order at least
}

TEST(DeadLoad, OfATractionIsItTimesTheAreaOfItsFacesOnly) {
  const Point size{0.02, 0.03, 0.05};
  const Point traction{100.0, 200.0, -300.0};
  for (const int degree : {1, 2}) {
    const Space space = make_space(meshes::box(size, {2, 3, 1}), degree, 0, MPI_COMM_SELF);
    Body body;
    body.regions = {{materials::NeoHookean{50e3}, materials::SimoTaylorVolume{2.5e6}, 1070.0}};
    body.tractions = {{x_max, traction}};
    const std::vector<double> load = dead_load_of(space, body);
    const Point force = scaled(size[1] * size[2], traction);
    expect_near(total_of(load), force, 1e-14);
    expect_near(moment_of(space, load), cross({size[0], 0.5 * size[1], 0.5 * size[2]}, force), 1e-15);
    for (std::size_t a = 0; a < space.positions.size(); ++a)
      if (space.positions[a][0] < 0.99 * size[0]) {
        EXPECT_EQ(load[3 * a], 0.0);
      }
  }
}

}  // namespace
}  // namespace menger::fem
