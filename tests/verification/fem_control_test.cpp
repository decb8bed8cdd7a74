// What drives a chamber, and what its energy and volume are: the quarter of the hollow cube, and bodies with two chambers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fem_hollow_cube.h"
#include "fem_table.h"
#include "materials/laws/tensor.h"
#include "meshes/hexahedra/boundary_labels.h"
#include "meshes/hexahedra/hollow_polycube.h"

namespace menger::fem {
namespace {

constexpr double pressure_Pa = 6000.0;

meshes::HexahedralMesh quarter_mesh() { return meshes::hollow_cube_quarter(cube_edge_m, cube_wall_m, 1); }

PlenumDrive pressure_drive(double pressure) { return {.kind = DriveKind::pressure, .values = {0.0, pressure}}; }

/// The whole cube with a corner in the origin, held as its quarter is.
Model full_cube(int degree) {
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(meshes::hollow_cube_design(cube_edge_m), {}).mesh;
  Body body = material_of_cube(Formulation::three_field);
  hold(body, mesh, "ground", {false, false, true});
  constexpr double half = 0.5 * cube_edge_m;
  body.point_supports = {{{half, half, 0.0}, {true, true, false}}, {{cube_edge_m, half, 0.0}, {false, true, false}}};
  add_chambers(body, mesh);
  return {mesh, degree, body};
}

/// Two cells with a chamber each, standing on the ground; each chamber a plenum, or both one.
Model twin_cubes(std::size_t plenum_count) {
  meshes::Design design{.name = "twins", .body = meshes::Polycube::from_digits(2, 1, 1, "12"), .cell_edge_m = 0.01};
  meshes::HollowBodyOptions options;
  options.chambers = meshes::ChamberLayout::per_phase;
  const meshes::HexahedralMesh mesh = meshes::hollow_polycube(design, options).mesh;
  Body body = material_of_cube(Formulation::three_field);
  hold(body, mesh, "ground", {true, true, true});
  add_chambers(body, mesh);
  body.plenum_count = plenum_count;
  if (plenum_count == 1)
    for (ChamberSurface& chamber : body.chambers) chamber.plenum = 0;
  return {mesh, 1, body};
}

TEST(Symmetry, AQuarterMovesAsTheWhole) {
  Model quarter(quarter_mesh(), 2, quarter_of_cube());
  quarter.follow({pressure_drive(pressure_Pa)});
  Model whole = full_cube(2);
  whole.follow({pressure_drive(pressure_Pa)});
  constexpr double half = 0.5 * cube_edge_m;
  constexpr double tolerance = 1e-6;
  expect_close("cube whole/quarter, top m", whole.displacement_at({half, half, cube_edge_m})[2],
               quarter.displacement_at(cube_top)[2], tolerance);
  expect_close("cube whole/quarter, side m", whole.displacement_at({cube_edge_m, half, half})[0],
               quarter.displacement_at(cube_side)[0], tolerance);
  expect_close("cube whole/quarter, energy J", whole.strain_energy_J(), 4.0 * quarter.strain_energy_J(), tolerance);
  expect_close("cube whole/quarter, volume ratio", whole.plenum_volume_ratio(0), quarter.plenum_volume_ratio(0), tolerance);
}

/// Gauss's rule of three points integrates the determinant of biquadratic elements exactly, and so do those of the faces the
/// volume between the surfaces: they agree to rounding.
TEST(ChamberVolume, TogetherWithTheWallsIsTheOuterVolume) {
  const meshes::HexahedralMesh mesh = quarter_mesh();
  Body body = quarter_of_cube();
  body.chambers.push_back({{meshes::label_index(mesh, "outer"), meshes::label_index(mesh, "ground")}, 1});  // inside out
  body.plenum_count = 2;
  for (const int degree : {1, 2}) {
    Model model(mesh, degree, body);
    model.follow({pressure_drive(pressure_Pa), pressure_drive(0.0)});
    const double cell_m3 = std::pow(cube_wall_m, 3);
    double walls_m3 = 0.0;
    model.equilibrium.assembly().elements().evaluate_points(
        model.state.displacements_m, [&](const ElementGroups::PointResult& result) {
          const std::size_t side = degree == 1 ? 2 : 3;
          const std::array<double, 3> weights =
              degree == 1 ? std::array{0.5, 0.5, 0.0} : std::array{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
          for (std::size_t q = 0; q < result.volume_ratio.size(); ++q) {
            materials::Tensor<double> F;
            std::copy_n(result.deformation_gradient.begin() + static_cast<std::ptrdiff_t>(9 * q), 9, F.components.begin());
            walls_m3 +=
                cell_m3 * weights[q % side] * weights[q / side % side] * weights[q / side / side] * materials::determinant(F);
          }
        });
    MPI_Allreduce(MPI_IN_PLACE, &walls_m3, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    const std::vector<double>& rest = model.report.points.front().chamber_volumes_m3;
    const std::vector<double>& volumes = model.report.points.back().chamber_volumes_m3;
    const std::string name = degree == 1 ? "cube Q1/P0, " : "cube Q2/P1, ";
    expect_close(name + "chamber at rest m^3", 4.0 * rest[0], std::pow(cube_edge_m - 2.0 * cube_wall_m, 3), 1e-12);
    expect_close(name + "outer volume at rest m^3", -4.0 * rest[1], std::pow(cube_edge_m, 3), 1e-12);
    expect_close(name + "chamber and walls at 6 kPa m^3", volumes[0] + walls_m3, -volumes[1], 1e-12);
  }
}

/// Work is summed by trapezoids: the difference to the energy falls with the square of the step.
TEST(EnergyBalance, WorkOfThePressureIsTheStrainEnergy) {
  std::vector<double> work_to_energy;
  for (const int steps : {8, 16, 32}) {
    Model model(quarter_mesh(), 1, quarter_of_cube());
    model.follow({pressure_drive(pressure_Pa)}, equal_steps(steps));
    EXPECT_EQ(model.report.points.size(), static_cast<std::size_t>(steps) + 1);
    work_to_energy.push_back(model.report.points.back().work_J / model.strain_energy_J());
  }
  expect_order("cube, work / strain energy, 32 steps", work_to_energy, 1.0, 2.0, 0.1);
  expect_close("cube, work / strain energy, 32 steps", work_to_energy.back(), 1.0, 5e-4);
}

TEST(GasControl, FollowsBoyle) {
  Model model(quarter_mesh(), 1, quarter_of_cube());
  model.follow({{.kind = DriveKind::gas, .values = {1.0, 1.5}}}, equal_steps(4));
  const double rest_m3 = model.report.points.front().plenum_volumes_m3[0];
  for (const PathPoint& point : model.report.points) {
    const double amount = 1.0 + 0.5 * point.s;
    expect_close("gas of amount " + std::to_string(amount).substr(0, 5) + ", P V J",
                 (point.pressures_Pa[0] + standard_atmosphere_Pa) * point.plenum_volumes_m3[0],
                 amount * standard_atmosphere_Pa * rest_m3, 1e-8);
  }
  EXPECT_GT(model.pressure_Pa(0), 1000.0);
}

TEST(GasControl, FollowsTheAdiabat) {
  constexpr double exponent = 1.4;
  Model model(quarter_mesh(), 1, quarter_of_cube());
  model.follow({{.kind = DriveKind::gas, .values = {1.0, 1.5}, .gas_exponent = exponent}});
  const double ratio = model.plenum_volume_ratio(0);
  expect_close("gas, adiabatic, P (V / a)^1.4 Pa",
               (model.pressure_Pa(0) + standard_atmosphere_Pa) * std::pow(ratio / 1.5, exponent), standard_atmosphere_Pa, 1e-8);
}

/// The tolerances of forces and of volumes, 1e-7 and 1e-9, bound the differences.
TEST(VolumeControl, ReproducesTheStateFoundUnderPressure) {
  Model given_pressure(quarter_mesh(), 2, quarter_of_cube());
  given_pressure.follow({pressure_drive(pressure_Pa)});
  Model given_volume(quarter_mesh(), 2, quarter_of_cube());
  given_volume.follow({{.kind = DriveKind::volume, .values = {1.0, given_pressure.plenum_volume_ratio(0)}}});
  expect_close("cube under volume control, pressure Pa", given_volume.pressure_Pa(0), pressure_Pa, 1e-6);
  EXPECT_LT(given_volume.distance_to(given_pressure), 1e-6 * given_pressure.displacement_at(cube_top)[2]);

  const double amount = (1.0 + pressure_Pa / standard_atmosphere_Pa) * given_pressure.plenum_volume_ratio(0);
  Model given_gas(quarter_mesh(), 2, quarter_of_cube());
  given_gas.follow({{.kind = DriveKind::gas, .values = {1.0, amount}}});
  expect_close("cube under gas control, pressure Pa", given_gas.pressure_Pa(0), pressure_Pa, 1e-6);
  EXPECT_LT(given_gas.distance_to(given_pressure), 1e-6 * given_pressure.displacement_at(cube_top)[2]);
}

TEST(Plena, OneOfTwoChambersIsTwoDrivenEqually) {
  Model two = twin_cubes(2);
  two.follow({pressure_drive(8000.0), pressure_drive(8000.0)});
  Model one = twin_cubes(1);
  one.follow({pressure_drive(8000.0)});
  const double largest = two.displacement_at({0.005, 0.005, 0.01})[2];
  EXPECT_GT(largest, 1e-5);
  EXPECT_LT(one.distance_to(two), 1e-6 * largest);

  Model by_volume = twin_cubes(1);
  by_volume.follow({{.kind = DriveKind::volume, .values = {1.0, one.plenum_volume_ratio(0)}}});
  expect_close("plenum of two chambers under volume control, pressure Pa", by_volume.pressure_Pa(0), 8000.0, 1e-6);
  EXPECT_LT(by_volume.distance_to(two), 1e-6 * largest);
}

/// Each volume depends on both pressures through the wall between the chambers.
TEST(Plena, TwoUnderVolumeControlFindTheirPressures) {
  Model given_pressures = twin_cubes(2);
  given_pressures.follow({pressure_drive(8000.0), pressure_drive(3000.0)});
  Model given_volumes = twin_cubes(2);
  given_volumes.follow({{.kind = DriveKind::volume, .values = {1.0, given_pressures.plenum_volume_ratio(0)}},
                        {.kind = DriveKind::volume, .values = {1.0, given_pressures.plenum_volume_ratio(1)}}});
  expect_close("two plena under volume control, first pressure Pa", given_volumes.pressure_Pa(0), 8000.0, 1e-6);
  expect_close("two plena under volume control, second pressure Pa", given_volumes.pressure_Pa(1), 3000.0, 1e-6);
}

/// The ground begins where its pressure carries the weight of the undeformed body; the walls sag a little more.
TEST(Gravity, TheGroundCarriesTheWeight) {
  const meshes::HexahedralMesh mesh = quarter_mesh();
  Body body = material_of_cube(Formulation::three_field);
  hold_symmetry(body, mesh);
  add_chambers(body, mesh);
  constexpr double density_kg_per_m3 = 1070.0;
  constexpr double gravity_m_per_s2 = 9.80665;
  const double walls_m3 = 0.25 * (std::pow(cube_edge_m, 3) - std::pow(cube_edge_m - 2.0 * cube_wall_m, 3));
  const double weight_N = density_kg_per_m3 * gravity_m_per_s2 * walls_m3;
  body.regions[0].density_kg_per_m3 = density_kg_per_m3;
  body.gravity_m_per_s2 = {0.0, 0.0, -gravity_m_per_s2};
  constexpr double stiffness_Pa_per_m = 1e7;
  body.ground = GroundPlane{weight_N / (0.25 * cube_edge_m * cube_edge_m * stiffness_Pa_per_m), stiffness_Pa_per_m};
  body.ground_labels = {meshes::label_index(mesh, "ground")};
  for (const int degree : {1, 2}) {
    Model model(mesh, degree, body);
    model.follow({pressure_drive(2000.0)});
    const std::string name = degree == 1 ? "cube Q1/P0, " : "cube Q2/P1, ";
    for (const PathPoint& point : model.report.points) {
      if (point.s == 0.0) expect_close(name + "ground force without pressure N", point.ground_force_N, weight_N, 1e-6);
      if (point.s == 1.0) expect_close(name + "ground force at 2 kPa N", point.ground_force_N, weight_N, 1e-6);
    }
    EXPECT_EQ(model.report.points.back().s, 1.0);
  }
}

TEST(SolverOptions, DirectAndIterativeMethodAgree) {
  Model direct(quarter_mesh(), 1, quarter_of_cube(), {.linear = {.method = LinearMethod::direct}});
  direct.follow({pressure_drive(pressure_Pa)});
  Model iterative(quarter_mesh(), 1, quarter_of_cube(), {.linear = {.method = LinearMethod::iterative}});
  iterative.follow({pressure_drive(pressure_Pa)});
  EXPECT_LT(iterative.distance_to(direct), 1e-6 * direct.displacement_at(cube_top)[2]);
}

TEST(SolverOptions, PredictedPressuresDoNotChangeTheState) {
  PathOptions options = equal_steps(8);
  Model with(quarter_mesh(), 2, quarter_of_cube(), {.predict_pressure = true, .linear = {}});
  with.follow({pressure_drive(pressure_Pa)}, options);
  Model without(quarter_mesh(), 2, quarter_of_cube(), {.predict_pressure = false, .linear = {}});
  without.follow({pressure_drive(pressure_Pa)}, options);
  EXPECT_LT(without.distance_to(with), 1e-6 * with.displacement_at(cube_top)[2]);
}

}  // namespace
}  // namespace menger::fem
